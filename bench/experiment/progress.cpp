#include "bench/experiment/progress.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace dmocbench {

namespace {
constexpr const char* erase_line = "\r\033[K";
}

Progress::Progress(std::size_t total) : total_(total), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (is_terminal_) std::fputs(erase_line, stderr);
}

void Progress::show(const std::string& what) const {
  if (!is_terminal_) return;
  fmt::print(stderr, "{}[{}/{}] {}", erase_line, done_ + 1, total_, what);
  std::fflush(stderr);
}

}  // namespace dmocbench
