#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/expression/schedule.hpp"
#include "methods/extensions/primitives/symmetry_group.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// A relative equilibrium: under the constant control u the motion from q is exp(t Σ c_i ξ_i)(q).
struct Trim {
  Eigen::VectorXd q;      ///< n entries
  Eigen::VectorXd rates;  ///< c, an entry per generator
  Eigen::VectorXd u;      ///< m entries, in the frame that moves
  /// (q, Σ c_i ξ_i(q)).
  BoundaryState state = {};
};

/// Solves for relative equilibria of a problem that does not depend on time. With v = Σ c_i ξ_i(q) and the acceleration
/// (∂v/∂q) v of the flow, the Euler-Lagrange equations of the problem's own L and f,
///   L_vv (∂v/∂q) v + L_vq v - L_q - f(q, v, u) = 0,
/// are n equations in (q, c, u).
class TrimSolver {
 public:
  /// The problem and the group must outlive it.
  TrimSolver(const Problem& problem, const SymmetryGroup& group);

  /// The trim that Newton's method finds next to a guess (whose `state` is not read), moving the unknowns of these
  /// numbers only, counted through (q, c, u); where they are more than the equations, by steps of least length. Throws
  /// `Error` if it does not converge.
  [[nodiscard]] Trim solve(const Trim& guess, const std::vector<Eigen::Index>& unknowns) const;

 private:
  [[nodiscard]] Eigen::VectorXd point_of(const Trim& trim) const;
  [[nodiscard]] std::vector<double> values_at(const Eigen::VectorXd& point) const;

  const Problem& problem_;
  const SymmetryGroup& group_;
  Eigen::Index n_;
  Schedule schedule_;  // the residual, then its derivative column by column
};

}  // namespace dmocbench
