#pragma once

#include <optional>

#include <Eigen/Core>

#include "methods/judgement/linearised_conditions.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// A direction along which the Lagrangian is concave although the linearised conditions hold along it: the proof, to
/// second order, that a stationary point is not a minimum.
struct NegativeCurvature {
  Eigen::VectorXd direction;  ///< d, variable_count() entries, the largest of magnitude 1; zero for fixed variables
  double value = 0.0;         ///< dᵀ(H + Σ)d
  double share = 0.0;         ///< value / dᵀWd, below -`negligible_curvature`
};

/// The direction of (about) the most negative curvature at a stationary point; none where there is no negative one.
///
/// The matrix is the primal-dual one of `LinearisedConditions`, in the null space of the equalities: z/d of bounds and
/// λ/d of inequalities stand for the active set, which then need not be guessed where bounds are nearly active. Of 432
/// optima of the suite's problems this test suspects three, which are saddles; with guessed active sets eleven minima
/// are suspected.
///
/// Eigenvalues of H + Σ next to W above -`negligible_curvature` count as zero: one sparse factorisation of the matrix,
/// shifted by so much of W, decides. W is the largest entry of H. Where none is found it is the largest entry of H for
/// each run of unknowns of the interval structure, since one stiff coordinate would hide the curvature of all others.
/// The direction needs about twenty factorisations more, for a bisection of the shift and inverse iteration. None, too,
/// where a factorisation fails. Throws `Stopped` where the `StopScope` of the thread ends that.
[[nodiscard]] std::optional<NegativeCurvature> negative_curvature(const NonlinearProgram& program,
                                                                  const LinearisedConditions& at);

/// See above.
inline constexpr double negligible_curvature = 1e-7;

}  // namespace dmocbench
