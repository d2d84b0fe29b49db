#pragma once

#include <cstdint>
#include <string>

#include "methods/solvers/solver.hpp"
#include "methods/solvers/sqp/quadratic/quadratic_options.hpp"

namespace dmocbench {

/// What the user of `SqpSolver` may choose.
struct SequentialOptions {
  sqp::Crash crash = sqp::Crash::none;                   ///< the basis of the first quadratic program
  sqp::PricingRule pricing = sqp::PricingRule::largest;  ///< which column enters
  std::uint32_t seed = 1;                                ///< of the random pricing rule
  bool limited_memory = false;                           ///< a quasi-Newton matrix instead of the exact Hessian
};

/// Sequential quadratic programming with an active-set method that starts each first quadratic program from the slack
/// basis, as the solver of the paper does: every minor iteration is counted and can be watched
/// (`SolverOptions::on_minor_iteration`). README.md in this folder says what a minor iteration is and what to expect.
///
/// `SequentialOptions` by name: crash=none|basis, pricing=largest|lowest|last|random, seed=(a whole number),
/// hessian=exact|limited_memory.
class SqpSolver final : public Solver {
 public:
  /// Throws `Error` on an unknown option passed on, or a value that it does not take.
  explicit SqpSolver(SolverOptions options = {}, SequentialOptions choices = {});
  [[nodiscard]] std::string name() const override { return "sqp"; }
  [[nodiscard]] std::string description() const override;

 private:
  [[nodiscard]] Solution run(CountedProgram& program, const Eigen::VectorXd& start) const override;

  SequentialOptions choices_;
};

}  // namespace dmocbench
