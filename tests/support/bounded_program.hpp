#pragma once

#include <utility>

#include "methods/program/nonlinear_program.hpp"

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
