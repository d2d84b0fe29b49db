#pragma once

#include <optional>

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"

namespace dmocbench {

/// The condition of the linear system that a solver meets at a solution: the largest by the smallest magnitude of an
/// eigenvalue of (H, Aᵀ; A, 0), with H the Hessian of φ + λᵀa and A the Jacobian of the equations, both of the free
/// variables alone.
///
/// Rows and columns are first brought to the same size (D K D with all largest entries 1), as solvers do, so that the
/// units of the problem do not count. Dense, for programs of up to some thousand unknowns. No inequality and no bound
/// may be active: throws `Error` if one is. Empty if the matrix is singular.
[[nodiscard]] std::optional<double> kkt_condition(NonlinearProgram& program, const Solution& solution);

}  // namespace dmocbench
