#pragma once

#include <optional>

#include "methods/program/solution.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The constant of coercivity of a discrete optimum (Assumption on coercivity, section 3.5): the largest α with
///
///   δξᵀ ∇²ℒ δξ >= α h Σ b_i |δU_i|²
///
/// for all δξ that keep the linearised equations and active bounds, ℒ the Lagrangian of the true cost. The weights make
/// it an approximation of the continuous quadratic form over ∫|δu|² dt on every grid: the smallest eigenvalue of the
/// reduced Hessian against the reduced weights.
///
/// Found by bisection to six digits, from the number of negative eigenvalues of the KKT matrix with α h b_i taken off
/// the diagonal of the controls (Sylvester): no null space is computed. Below 1e-9 it is 0 to the precision of that
/// number, and so returned; empty if the form is not even nonnegative.
[[nodiscard]] std::optional<double> smallest_curvature(Transcription& program, const Solution& solution);

}  // namespace dmocbench
