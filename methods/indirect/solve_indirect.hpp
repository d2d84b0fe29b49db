#pragma once

#include "methods/indirect/indirect_solution.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/trajectory.hpp"

namespace dmocbench {

/// How far `solve_indirect` goes.
struct IndirectOptions {
  double tolerance = 1e-12;           ///< grids are refined until two runs agree to this, relative
  Eigen::Index most_intervals = 512;  ///< of the coarser run; then the best agreement that was reached is reported
};

/// An optimal motion that owes nothing to any direct method but its start: Pontryagin's boundary value problem of the
/// same traced formulas, solved twice, by Gauss collocation of order 16 on N intervals and of order 20 on 3N/2, with N
/// doubled until both agree (`IndirectAgreement`). The finer run is returned.
///
/// `start` is a direct solution with costates on the branch that is wanted; a few dozen intervals do. What is found is
/// an extremal near it: Legendre's condition is checked, optimality is not. A problem of this class has no bounds
/// and no path constraints; where they come, they are to be refused here.
///
/// Throws `Error` if the start has no costates or another horizon, the running cost is not strictly convex in the
/// control, or Newton's method does not converge.
[[nodiscard]] IndirectSolution solve_indirect(const Problem& problem, const Trajectory& start,
                                              const IndirectOptions& options = {});

/// How far a solution, e.g. one read from a file, is from solving this problem: the largest residual of slopes against
/// the equations, of steps between nodes and of both ends, relative to the largest value of its kind (state or
/// costate). Rounding for a solution of the problem. Throws `Error` if the control cannot be found there, or sizes do
/// not fit.
[[nodiscard]] double boundary_value_residual(const Problem& problem, const IndirectSolution& solution);

}  // namespace dmocbench
