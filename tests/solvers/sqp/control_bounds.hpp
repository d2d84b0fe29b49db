#pragma once

#include "methods/transcription/transcription.hpp"
#include "tests/support/bounded_program.hpp"

namespace dmocbench::sqp::tests {

/// The same program with |u| <= `bound` at all stages.
inline dmocbench::tests::BoundedProgram with_control_bound(Transcription& transcription, double bound) {
  Eigen::VectorXd lower = transcription.variable_lower();
  Eigen::VectorXd upper = transcription.variable_upper();
  const ProgramBlocks& blocks = transcription.blocks();
  const auto intervals = static_cast<Eigen::Index>(blocks.intervals());
  for (Eigen::Index stage = 0; stage < transcription.tableau().stages(); ++stage) {
    for (Eigen::Index i = 0; i < transcription.traced_problem().control_size(); ++i) {
      const auto head = blocks.unknown(Quantity::control, stage).index(i);
      lower.segment(head, intervals).setConstant(-bound);
      upper.segment(head, intervals).setConstant(bound);
    }
  }
  return {transcription, lower, upper};
}

}  // namespace dmocbench::sqp::tests
