#pragma once

#include <cstddef>
#include <string>

#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// SLSQP of NLopt: Kraft's sequential quadratic programming, dense, with a quasi-Newton (BFGS) matrix in place of the
/// Hessian. It takes our exact first derivatives and never asks for second ones.
///
/// NLopt sees the free variables only, and a start moved into their bounds. SLSQP tests no KKT residual and gives no
/// multipliers; so we estimate them at every point where it asks for a gradient (least_squares_multipliers.hpp), and
/// the solve ends as soon as the KKT residual by them meets the tolerance. Returned is the point that was nearest to
/// that. Where SLSQP can make no more of its digits it starts afresh from there, as long as that helps. Its line search
/// compares merits, so it stands still where they differ by rounding: at a KKT residual of about the square root of
/// rounding times curvature, which may be far above a tolerance although the objective agrees to twelve digits. Such a
/// point ends as "acceptable" or "not confirmed". Nor is SLSQP invariant under scaling: its first quasi-Newton matrix
/// is the identity, and another scale of cost or variables changes counts and where it stands still.
///
/// `most_iterations` limits the evaluations: an iteration takes one, and more where its line search shortens the step.
/// Iterations themselves are not told: empty. The seconds include our estimates. `stop_requested` is asked once per
/// evaluation. SLSQP has no output that `verbose` could show. Options passed on: ftol_rel, ftol_abs, xtol_rel,
/// xtol_abs, maxeval, maxtime. By default xtol_rel is the rounding of a double and the other tolerances are off; where
/// one is passed on, SLSQP does not start afresh.
class NloptSolver final : public Solver {
 public:
  /// An iteration factors dense matrices of this size, a tenth of a second at 400; more free variables are refused with
  /// status "too large".
  static constexpr std::size_t most_free_variables = 400;

  /// Throws `Error` that names the option if one is out of range or passed on in vain.
  explicit NloptSolver(SolverOptions options);
  [[nodiscard]] std::string name() const override { return "nlopt"; }
  [[nodiscard]] std::string description() const override;

 private:
  [[nodiscard]] Solution run(CountedProgram& program, const Eigen::VectorXd& start) const override;
};

}  // namespace dmocbench
