#pragma once

#include <utility>

#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench::tests {

/// Another program with bounds of the test's choice on its variables.
class BoundedProgram final : public ForwardingProgram {
 public:
  BoundedProgram(NonlinearProgram& program, Eigen::VectorXd lower, Eigen::VectorXd upper)
      : ForwardingProgram(program), lower_(std::move(lower)), upper_(std::move(upper)) {}

  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return upper_; }

 private:
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
};

}  // namespace dmocbench::tests

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
