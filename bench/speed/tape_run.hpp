#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "methods/expression/tape.hpp"

namespace dmocbench::speed {

/// A tape with memory for its outputs: one column per output, nothing assembled.
class TapeRun {
 public:
  TapeRun(const Schedule& schedule, InstructionSet set, std::size_t intervals);

  void evaluate(std::span<const Tape::Input> inputs) { tape_.evaluate(intervals_, inputs, columns_, workspace_); }

  [[nodiscard]] const Tape& tape() const noexcept { return tape_; }
  [[nodiscard]] double value(std::size_t interval, std::size_t output) const { return columns_[output][interval]; }

 private:
  std::size_t intervals_;
  Tape tape_;
  Tape::Workspace workspace_;
  std::vector<double> values_;
  std::vector<double*> columns_;
};

}  // namespace dmocbench::speed
