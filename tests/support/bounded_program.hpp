#pragma once

#include <utility>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::tests {

/// Another program with bounds of the test's choice on its variables.
class BoundedProgram final : public NonlinearProgram {
 public:
  BoundedProgram(NonlinearProgram& program, Eigen::VectorXd lower, Eigen::VectorXd upper)
      : program_(program), lower_(std::move(lower)), upper_(std::move(upper)) {}

  [[nodiscard]] std::size_t variable_count() const override { return program_.variable_count(); }
  [[nodiscard]] std::size_t constraint_count() const override { return program_.constraint_count(); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return upper_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return program_.constraint_lower(); }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return program_.constraint_upper(); }
  [[nodiscard]] const BlockPattern& jacobian_structure() const override { return program_.jacobian_structure(); }
  [[nodiscard]] const BlockPattern& hessian_structure() const override { return program_.hessian_structure(); }
  [[nodiscard]] double objective(const VectorIn& x) override { return program_.objective(x); }
  void gradient(const VectorIn& x, VectorOut result) override { program_.gradient(x, result); }
  void constraints(const VectorIn& x, VectorOut result) override { program_.constraints(x, result); }
  void jacobian(const VectorIn& x, VectorOut values) override { program_.jacobian(x, values); }
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override {
    program_.hessian(x, objective_factor, multipliers, values);
  }
  [[nodiscard]] const RoundingFloors& rounding_floors() const override { return program_.rounding_floors(); }

 private:
  NonlinearProgram& program_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
};

}  // namespace dmocbench::tests
