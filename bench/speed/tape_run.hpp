#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/speed/interval_columns.hpp"
#include "methods/expression/tape.hpp"

namespace dmocbench::speed {

/// A tape with memory for its outputs: one column per output, nothing assembled.
class TapeRun {
 public:
  TapeRun(const Schedule& schedule, InstructionSet set, std::size_t intervals)
      : intervals_(intervals), tape_(schedule, set), workspace_(tape_), outputs_(tape_.output_count(), intervals) {}

  void evaluate(std::span<const Tape::Input> inputs) {
    tape_.evaluate(intervals_, inputs, outputs_.columns(), workspace_);
  }

  [[nodiscard]] const IntervalColumns& outputs() const noexcept { return outputs_; }

 private:
  std::size_t intervals_;
  Tape tape_;
  Tape::Workspace workspace_;
  IntervalColumns outputs_;
};

}  // namespace dmocbench::speed
