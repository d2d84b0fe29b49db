#pragma once

#include <cstdio>
#include <memory>
#include <string>

namespace dmocbench {

/// Standard error if it is a terminal: one line there says what is being done. The line is erased at the end.
class ProgressLine {
 public:
  ProgressLine();

  /// Whether anybody sees it.
  [[nodiscard]] bool is_shown() const noexcept { return terminal_ != nullptr; }
  /// Replaces the line.
  void show(const std::string& activity) const;

 private:
  std::unique_ptr<std::FILE, void (*)(std::FILE*)> terminal_;  ///< empty where it is no terminal
};

}  // namespace dmocbench
