#pragma once

#include <cstddef>
#include <string>

namespace dmocbench {

/// One line on a terminal that says what is being solved; nothing at all if standard error is not a terminal.
class Progress {
 public:
  explicit Progress(std::size_t total);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;
  ~Progress();

  /// Shows what is under way; does not count it.
  void show(const std::string& what) const;
  /// One more is done.
  void advance() { ++done_; }

 private:
  std::size_t total_;
  std::size_t done_ = 0;
  bool is_terminal_;
};

}  // namespace dmocbench
