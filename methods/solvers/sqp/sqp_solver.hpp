#pragma once

#include <string>

#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// Sequential quadratic programming with an active-set method that starts each first quadratic program from the slack
/// basis, as the solver of the paper does: every minor iteration is counted and can be watched
/// (`SolverOptions::on_minor_iteration`). README.md in this folder says what a minor iteration is and what to expect.
///
/// Options passed on: crash=none|basis, pricing=largest|lowest|last|random, seed=<whole number>,
/// hessian=exact|limited_memory.
class SqpSolver final : public Solver {
 public:
  /// Throws `Error` on an unknown option.
  explicit SqpSolver(SolverOptions options);
  [[nodiscard]] std::string name() const override { return "sqp"; }
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] Solution solve(NonlinearProgram& program, const Eigen::VectorXd& start) const override;

 private:
  SolverOptions options_;
};

}  // namespace dmocbench
