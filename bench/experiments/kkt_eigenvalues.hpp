#pragma once

#include <cstdint>
#include <optional>

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The final state along the variations of an optimum.
enum class EndVariation : std::uint8_t {
  stated,  ///< kept where the problem fixes it
  free     ///< moved: the space M of the paper, which has no condition at T
};

/// The constant of coercivity of a discrete optimum (Assumption on coercivity, section 3.5): the largest α with
///
///   δξᵀ ∇²ℒ δξ >= α h Σ b_i |δU_i|²
///
/// for all δξ that keep the linearised equations and active bounds, ℒ the Lagrangian of the true cost. With the end
/// free, unknowns of the last node are free and its equations dropped; ℒ stays, so that its terms of r are linear in
/// (q, p) as V = 0 of the paper requires: for families whose last node is q or (q, p). The weights make
/// it an approximation of the continuous quadratic form over ∫|δu|² dt on every grid: the smallest eigenvalue of the
/// reduced Hessian against the reduced weights.
///
/// Found by bisection to six digits, from the number of negative eigenvalues of the KKT matrix with α h b_i taken off
/// the diagonal of the controls (Sylvester): no null space is computed. Between -1e-9 and 1e-9 it is 0 to the precision
/// of that number, and so returned; empty if no α above -1e12 satisfies this.
[[nodiscard]] std::optional<double> smallest_curvature(Transcription& program, const Solution& solution,
                                                       EndVariation end = EndVariation::stated);

/// The condition of the linear system that a solver meets at a solution: the largest by the smallest magnitude of an
/// eigenvalue of (H, Aᵀ; A, 0), with H the Hessian of φ + λᵀa and A the Jacobian of the equations, both of the free
/// variables alone.
///
/// Rows and columns are first brought to the same size (D K D with all largest entries 1), as solvers do, so that the
/// units of the problem do not count. Dense, for programs of up to some thousand unknowns. No inequality and no bound
/// may be active: throws `Error` if one is. Empty if the matrix is singular.
[[nodiscard]] std::optional<double> kkt_condition(NonlinearProgram& program, const Solution& solution);

}  // namespace dmocbench
