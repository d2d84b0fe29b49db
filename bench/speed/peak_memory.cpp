#include "bench/speed/peak_memory.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace dmocbench::speed {

namespace {

/// A line "NAME:   1234 kB" of the kernel's report on this process, in bytes.
std::optional<double> reported(const std::string& name) {
  std::ifstream report("/proc/self/status");
  for (std::string word; report >> word;) {
    double kilobytes = 0.0;
    if (word == name + ":" && report >> kilobytes) return 1024.0 * kilobytes;
  }
  return std::nullopt;
}

/// Makes the kernel's record of the peak that of now. False if it cannot be.
bool forget_peak() {
  std::ofstream references("/proc/self/clear_refs");
  references << "5" << std::flush;  // proc(5)
  return references.good();
}

}  // namespace

PeakMemory::PeakMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  if (forget_peak()) before_ = reported("VmRSS");
}

std::optional<double> PeakMemory::growth() const {
  const auto peak = reported("VmHWM");
  if (!before_ || !peak) return std::nullopt;
  return std::max(0.0, *peak - *before_);
}

}  // namespace dmocbench::speed
