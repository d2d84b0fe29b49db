#include "bench/run/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace dmocbench {

namespace {

void erase_line(std::FILE* terminal) { std::fputs("\r\033[K", terminal); }

}  // namespace

ProgressLine::ProgressLine() : terminal_(::isatty(STDERR_FILENO) == 1 ? stderr : nullptr, erase_line) {}

void ProgressLine::show(const std::string& activity) const {
  if (!is_shown()) return;
  erase_line(terminal_.get());
  fmt::print(terminal_.get(), "{}", activity);
  std::fflush(terminal_.get());
}

}  // namespace dmocbench
