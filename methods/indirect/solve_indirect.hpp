#pragma once

#include "methods/indirect/indirect_solution.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The stopping rule of `solve_indirect`.
struct IndirectOptions {
  double tolerance = 1e-12;            ///< grids are refined until two runs agree to this, relative
  Eigen::Index fewest_intervals = 16;  ///< N to begin with; long horizons need a few intervals per period
  Eigen::Index most_intervals = 512;   ///< the largest N; beyond it the best agreement so far is returned
};

/// The maximum principle is stated here for fixed ends, a fixed horizon and a motion without bounds. Throws `Error`
/// that names the first thing of the problem that is outside this class: bounds, constraints of any kind, a final cost,
/// free ends, a free horizon, first-order states or unknown parameters.
void require_indirect(const Problem& problem);

/// An optimal motion that depends on direct methods for its start only: Pontryagin's boundary value problem of the same
/// traced formulas, solved twice, by Gauss collocation of order 16 on N intervals and of order 20 on 3N/2, with N
/// doubled until both agree (`IndirectAgreement`). The finer run is returned.
///
/// `start` is a direct solution with costates on the wanted branch; a few dozen intervals suffice. The result is an
/// extremal near it: Legendre's condition is checked, optimality is not.
///
/// Throws `Error` as `require_indirect`, and if the start has no costates or another horizon, the running cost is not
/// strictly convex in the control, or Newton's method does not converge.
[[nodiscard]] IndirectSolution solve_indirect(const Problem& problem, const Trajectory& start,
                                              const IndirectOptions& options = {});

/// The residual of a solution, for example one read from a file, in this problem: the largest residual of rates in the
/// equations, of steps between nodes and of both ends, relative to the largest value of its kind (state or costate).
/// It is of rounding size for a solution of the problem. Throws `Error` if the control cannot be found, or sizes do not
/// fit.
[[nodiscard]] double boundary_value_residual(const Problem& problem, const IndirectSolution& solution);

/// The distance from the next node at which an adaptive Runge-Kutta method of order 7(8) ends that starts at each node
/// (q, p, ψ)_k: the largest mismatch, relative to the largest state or costate. It confirms state and costate
/// independently of collocation. It restarts at every node, because over the whole horizon the equations of an
/// optimal motion amplify rounding. Throws `Error` if a step size vanishes.
[[nodiscard]] double shooting_defect(const Problem& problem, const IndirectSolution& solution);

}  // namespace dmocbench
