#include "bench/speed/tape_run.hpp"

#include <memory>

namespace dmocbench::speed {

TapeRun::TapeRun(const Schedule& schedule, InstructionSet set, std::size_t intervals)
    : intervals_(intervals), tape_(schedule, set), workspace_(tape_) {
  // Columns begin with a cache line, but not a power of two apart: else they would compete for the same few lines of
  // the first-level cache. (In a program they stand as the pattern has it: see program_benchmarks.cpp for what that
  // costs.)
  constexpr std::size_t line = 64;
  const std::size_t stride = intervals + Tape::block_width;
  values_.resize(tape_.output_count() * stride + line / sizeof(double));
  void* head = values_.data();
  std::size_t space = values_.size() * sizeof(double);
  auto* first = static_cast<double*>(std::align(line, sizeof(double), head, space));
  for (std::size_t j = 0; j < tape_.output_count(); ++j) columns_.push_back(first + j * stride);
}

}  // namespace dmocbench::speed
