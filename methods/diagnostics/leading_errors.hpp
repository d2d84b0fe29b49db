#pragma once

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// Errors of a discrete optimum to leading order in the step, found without solving its program.
struct LeadingErrors {
  /// (q, v)(T) of the continuous system less (q, v)(T) of the discrete flow, both from the initial state and with the
  /// optimal controls of the stages, 2n entries: the error of a replay (`ReplayError`), of order 2s.
  Eigen::VectorXd replay;
  /// The discrete optimal cost less the optimal one: Σ_k [ψ_{k+1}·δ_k + c_k] - J with the defects
  /// δ_k = F_h(x_k, U_k) - x_{k+1} of the exact optimum in the one-step map F_h on (q, p), and c_k the cost of its
  /// interval.
  double cost = 0.0;
};

/// The errors of a method whose controls are at the stages, on the grid of `optimum`: an exact optimum with its
/// costates at the nodes of a grid and its controls at the stages (`IndirectSolution::sampled_like`).
///
/// A discrete optimum is a motion of the discrete flow with its own controls, which differ from the optimal ones by
/// their error. That changes the error of the replay by a factor 1 + O(h). The discrete cost is the value of the
/// Lagrangian Σ c_k + ψ_{k+1}·(F_h(x_k, U_k) - x_{k+1}), which is stationary at the discrete optimum; so the exact
/// optimum, at a distance of O(h^(s+1)), gives it up to O(h^(2s+2)). Fixed ends and horizon, neither a final cost nor
/// first-order states. Throws `Error` if a step of the method has no solution.
[[nodiscard]] LeadingErrors leading_errors(const Problem& problem, const Element& element, const Trajectory& optimum);

}  // namespace dmocbench
