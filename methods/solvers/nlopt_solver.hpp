#pragma once

#include <cstddef>

#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// SLSQP of NLopt: Kraft's sequential quadratic programming, dense, with a quasi-Newton (BFGS) matrix in place of the
/// Hessian. It takes our exact first derivatives and never needs second ones.
///
/// NLopt gets the free variables only, and a start moved into their bounds. SLSQP tests no KKT residual and gives no
/// multipliers, so we estimate them wherever it evaluates a gradient (`least_squares_multipliers`) and end the solve
/// as soon as the KKT residual meets the tolerance; the point that came nearest to it is the answer. Where SLSQP makes
/// no further progress it starts again from that point, as long as that helps. Its line search compares merits, so it
/// stalls where they differ by rounding only: at a KKT residual of about the square root of rounding times curvature,
/// which may be far above the tolerance although the objective agrees to twelve digits. Such a point ends as
/// "acceptable" or "not confirmed". SLSQP is not invariant under scaling either: its first quasi-Newton matrix is the
/// identity.
///
/// `most_iterations` limits the points that are visited: an iteration takes one, and more where its line search
/// shortens the step. SLSQP does not report its iterations. The seconds include our estimates. `stop_requested` is
/// called once per point; `verbose` shows nothing. Its options by name: ftol_rel, ftol_abs, xtol_rel, xtol_abs,
/// maxeval, maxtime. By default xtol_rel is the rounding of a double and the other tolerances are off; where one is
/// given, SLSQP does not start again.
class NloptSolver final : public SolverWithoutMemory {
 public:
  /// An iteration factorises dense matrices of this size; more free variables are rejected with status "too large".
  static constexpr std::size_t most_free_variables = 400;

  /// Throws `Error` that names the option if one is out of range or not SLSQP's.
  explicit NloptSolver(SolverOptions options, NamedOptions named = {});

 private:
  [[nodiscard]] Solution run(CountedProgram& program, const Eigen::VectorXd& start) const override;

  NamedOptions named_;
};

}  // namespace dmocbench
