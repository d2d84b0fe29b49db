#pragma once

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::batch {

/// One instance of a program as a program of its own: fixed unknowns have the values of its start, equalities its
/// values. For work done one by one; the program that evaluates must outlive it.
class InstanceProgram final : public ForwardingProgram {
 public:
  /// `start`: variable_count() entries; `equality_values`: constraint_count() entries, or none for the values of the
  /// program.
  InstanceProgram(NonlinearProgram& program, const Eigen::VectorXd& start, const Eigen::VectorXd& equality_values)
      : ForwardingProgram(program),
        variable_lower_(with_values(program.variable_lower(), program.variable_upper(), start)),
        variable_upper_(with_values(program.variable_upper(), program.variable_lower(), start)),
        constraint_lower_(with_values(program.constraint_lower(), program.constraint_upper(), equality_values)),
        constraint_upper_(with_values(program.constraint_upper(), program.constraint_lower(), equality_values)) {}

  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return variable_lower_; }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return variable_upper_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return constraint_lower_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return constraint_upper_; }

 private:
  /// A bound, with other values where both sides are equal.
  static Eigen::VectorXd with_values(const Eigen::VectorXd& side, const Eigen::VectorXd& other,
                                     const Eigen::VectorXd& values) {
    if (values.size() == 0) return side;
    return (side.array() == other.array()).select(values, side);
  }

  Eigen::VectorXd variable_lower_;
  Eigen::VectorXd variable_upper_;
  Eigen::VectorXd constraint_lower_;
  Eigen::VectorXd constraint_upper_;
};

}  // namespace dmocbench::batch
