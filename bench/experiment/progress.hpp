#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

namespace dmocbench {

/// One line on a terminal that says what is being solved; nothing at all if standard error is not a terminal.
class Progress {
 public:
  explicit Progress(std::size_t total) : total_(total), is_terminal_(::isatty(STDERR_FILENO) == 1) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;
  ~Progress() {
    if (is_terminal_) std::fputs(erase_line, stderr);
  }

  /// Shows what is under way; does not count it.
  void show(const std::string& activity) const {
    if (!is_terminal_) return;
    fmt::print(stderr, "{}[{}/{}] {}", erase_line, done_ + 1, total_, activity);
    std::fflush(stderr);
  }
  /// One more is done.
  void advance() { ++done_; }

 private:
  static constexpr const char* erase_line = "\r\033[K";
  std::size_t total_;
  std::size_t done_ = 0;
  bool is_terminal_;
};

}  // namespace dmocbench
