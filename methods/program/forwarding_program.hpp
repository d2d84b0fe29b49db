#pragma once

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// Forwards every call to another program, which must outlive it. Derived classes override some of them.
class ForwardingProgram : public NonlinearProgram {
 public:
  [[nodiscard]] std::size_t variable_count() const override { return original_.variable_count(); }
  [[nodiscard]] std::size_t constraint_count() const override { return original_.constraint_count(); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return original_.variable_lower(); }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return original_.variable_upper(); }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return original_.constraint_lower(); }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return original_.constraint_upper(); }
  [[nodiscard]] const BlockPattern& jacobian_structure() const override { return original_.jacobian_structure(); }
  [[nodiscard]] const BlockPattern& hessian_structure() const override { return original_.hessian_structure(); }
  [[nodiscard]] const RoundingFloors& rounding_floors() const override { return original_.rounding_floors(); }
  [[nodiscard]] const IntervalStructure* interval_structure() const override { return original_.interval_structure(); }

  [[nodiscard]] double objective(const VectorIn& x) override { return original_.objective(x); }
  void gradient(const VectorIn& x, VectorOut result) override { original_.gradient(x, result); }
  void constraints(const VectorIn& x, VectorOut result) override { original_.constraints(x, result); }
  void jacobian(const VectorIn& x, VectorOut values) override { original_.jacobian(x, values); }
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override {
    original_.hessian(x, objective_factor, multipliers, values);
  }

 protected:
  /// It must outlive this.
  explicit ForwardingProgram(NonlinearProgram& original) : original_(original) {}
  /// The original program.
  [[nodiscard]] NonlinearProgram& original() const noexcept { return original_; }

 private:
  NonlinearProgram& original_;
};

}  // namespace dmocbench
