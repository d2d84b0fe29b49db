#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "methods/kkt/linearisation.hpp"
#include "methods/kkt/symmetric_factorisation.hpp"
#include "methods/program/counted_program.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"

namespace dmocbench {

/// Descends to where the constraints of a program are violated least,
///
///   minimise ½|r(ξ)|² - μ Σ ln d(ξ),
///
/// r the amounts by which constraints leave their bounds and d the distances of the unknowns from theirs. μ falls with
/// |r|², so the end is a stationary point of ½|r|² within the bounds, or r = 0. The steps are by Gauss and
/// Newton's method or, where these are slow, of Newton's, damped in relation to the size of each unknown: unlike steps
/// to where the linearised constraints hold, they exist where rows depend on each other or contradict each other, and
/// the barrier keeps them away from bounds.
class ViolationDescent {
 public:
  /// A descent from `start` (variable_count() entries), moved off its bounds.
  ViolationDescent(NonlinearProgram& program, const Eigen::VectorXd& start);

  /// One step; false if none lets the violation fall, as where a number is not finite. It evaluates the program in
  /// its line search and factorises two matrices or, where they need more damping, some more.
  [[nodiscard]] bool step();

  /// Strictly within its bounds, except unknowns whose bounds are equal.
  [[nodiscard]] const Eigen::VectorXd& point() const noexcept { return at_.point; }
  /// Largest |r|.
  [[nodiscard]] double violation() const { return excess_.lpNorm<Eigen::Infinity>(); }
  /// Whether the steps have become slow, and the point is one of least violation (`is_point_of_least_violation`).
  [[nodiscard]] bool is_at_least_violation() const;
  /// Whether the last thirty steps together left more than four fifths of |r|².
  [[nodiscard]] bool has_stalled() const noexcept { return slow_steps_ >= most_slow_steps; }

 private:
  static constexpr int most_slow_steps = 30;

  void lower_barrier();
  [[nodiscard]] double merit(const Linearisation& at) const;
  [[nodiscard]] bool compute_step(bool with_curvature);
  [[nodiscard]] bool search();
  [[nodiscard]] Eigen::SparseMatrix<double> matrix(const Eigen::VectorXd& diagonal, bool with_curvature);

  NonlinearProgram& program_;
  std::vector<bool> is_free_;
  Eigen::ArrayXd lower_;  // infinite where the bounds are equal
  Eigen::ArrayXd upper_;
  SymmetricFactorisation factorisation_;
  Linearisation at_;
  Eigen::VectorXd excess_;  // r
  Eigen::ArrayXd z_lower_;  // multipliers of the bounds
  Eigen::ArrayXd z_upper_;
  Eigen::VectorXd step_;
  double directional_derivative_ = 0.0;  // of the merit along the step
  double mu_ = 0.0;
  double damping_ = 1e-3;  // cost of a step of the size of each unknown, as a share of |r|²
  double left_ = 0.0;      // share of |r|² that the last step left
  double mark_ = 0.0;      // |r|² when it had last become much smaller
  int slow_steps_ = 0;     // since then
  bool is_long_ = false;   // the last step was hardly shortened
  bool uses_curvature_ = false;
};

/// A point that meets the constraints within the tolerance of the options: where descent on the violation alone ends,
/// from `start` or, if that fails, from half way between the bounds, or from the start with positive unknowns of the
/// whole horizon, such as T, multiplied by 2, 4, 1/2 and 8. Empty if none does. It counts no evaluation. Throws
/// `Stopped` where the solve must end.
[[nodiscard]] Eigen::VectorXd feasible_point(const CountedProgram& program, const SolverOptions& options,
                                             const Eigen::VectorXd& start);

/// Decides for all solvers whether a program is infeasible from where the solver started. "infeasible" if the last
/// point is one of least violation (`is_point_of_least_violation`), or if descent from it ends at one, to which
/// `solution.primal` then moves; "step failed" if the solver reports infeasible and neither holds. For a `solution`
/// that is reported infeasible, whose step failed or whose iterations ran out; the latter is judged at its last point,
/// without descent. "Infeasible" is not reported either where a `feasible_point` is found from `start`, where the solve
/// began. Its message says "infeasible" where the constraints are affine, so that a local minimum of the violation is a
/// global one, otherwise "no trajectory found". It counts no evaluation. Throws `Stopped` where the
/// solve must end.
void judge_infeasibility(const CountedProgram& program, const SolverOptions& options, const Eigen::VectorXd& start,
                         Solution& solution);

}  // namespace dmocbench
