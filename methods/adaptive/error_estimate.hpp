#pragma once

#include <Eigen/Core>

#include "methods/adaptive/extremal_flow.hpp"
#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The estimated difference between the optimal motion and the answer of a program: optimum minus answer.
struct ErrorEstimate {
  Eigen::MatrixXd q = {};      ///< at the nodes, (N + 1) × n
  Eigen::MatrixXd p = {};      ///< (N + 1) × n
  Eigen::MatrixXd psi_q = {};  ///< (N + 1) × n, of the true cost
  Eigen::MatrixXd psi_p = {};  ///< (N + 1) × n
  double objective = 0.0;      ///< of the true cost
  /// The largest |δq_k| / range of q, |δp_k| / range of p and |δJ| / |J|. Norms are Euclidean, the range of q is the
  /// norm of the differences between the largest and the smallest value of each component; a q or p that is constant
  /// up to rounding counts by its size, or 1.
  double relative = 0.0;
  /// Relative rounding error of the momenta; a smaller estimate means nothing. It is ε max|q| max|L_vv| / h, with h of
  /// the narrowest interval, over the range of p.
  double floor = 0.0;
  /// Per interval how far the optimal flow, started at its first node, misses the next one: the largest of state and
  /// costate, each relative to its range. Of order h^(r + 1) for a method of order r.
  Eigen::VectorXd defects = {};
};

/// The largest |δq_k| / range of q, |δp_k| / range of p and |δJ| / |J| of differences from an answer, as
/// `ErrorEstimate::relative` has them; a cost below 1e-8 of the solvers' unit counts as that.
[[nodiscard]] double relative_size(const Trajectory& answer, const Eigen::MatrixXd& q, const Eigen::MatrixXd& p,
                                   double objective, double cost_scale);

/// The error of an answer by its differences from an earlier one, on the same nodes with fewer stages or on a grid of
/// which every interval was halved: an upper bound if the later answer is at least twice as accurate. `relative` counts
/// the horizon too; there are differences of q and p at the nodes of the earlier answer, and no `defects`. It needs
/// no assumption on the problem: horizon, ends and active bounds may be of any kind.
[[nodiscard]] ErrorEstimate error_by_comparison(const Transcription& program, const Trajectory& earlier,
                                                const Trajectory& later);

/// Estimates the error of solved programs of one problem from their answer alone.
///
/// 1. Local: every interval is replayed by Pontryagin's equations (`ExtremalFlow`) from the state and costate of its
///    first node. By (th:orderapp) state and costate of a direct solution are a Runge-Kutta solution of these
///    equations, so that they miss the next node by the local error, δx_k and δψ_k, of order h^(r + 1) for every family
///    and tableau.
/// 2. Global: the optimum satisfies the program's conditions of optimality if interval k sees its last node moved back
///    by these misses. To first order the error is therefore one more linear solve with the matrix of a Newton step at
///    the answer; the right-hand side is that matrix, interval by interval, times the misses. Residuals that the
///    solver left are part of the misses.
/// 3. The cost: to first order J* - J = Σ_k (∫ C dt along the replayed interval - its discrete cost + ψ_{k+1}·δx_k).
///    Where the cost is flat, the second order is larger: with the errors e of state and costate at the nodes,
///    ½ Σ_k [e^ψ_{k+1}·δx_k - δψ_k·(e^x_{k+1} - δx_k)], half the derivative of the Lagrangian along the error.
///
/// The estimate becomes exact as the steps become small: its relative error is of the order of the error.
class ErrorEstimator {
 public:
  /// Throws `Error` if the problem has a free horizon or boundary conditions, whose conditions the misses leave out, or
  /// no strictly convex cost.
  explicit ErrorEstimator(const Transcription& program);

  /// `primal` and `multipliers` of a solved program of the same problem, for the same values, on any grid and by any
  /// method, in Bolza form; `motion` is its trajectory with costates. Entries are infinite where an interval cannot be
  /// replayed. Throws `Error` if a bound or an inequality is active, since the optimal flow without bounds is another
  /// one there, if the matrix is singular, or in Mayer form.
  [[nodiscard]] ErrorEstimate estimate(Transcription& program, const Eigen::VectorXd& primal,
                                       const Eigen::VectorXd& multipliers, const Trajectory& motion);

 private:
  [[nodiscard]] ExtremalCoordinates::Canonical in_momenta(const ExtremalStates& nodes, const ExtremalStates& errors,
                                                          const Trajectory& motion);

  double cost_scale_;
  ExtremalFlow flow_;
  ExtremalCoordinates coordinates_;
};

}  // namespace dmocbench
