#pragma once

#include <vector>

#include "methods/diagnostics/traced_newton.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

/// The one-step map (q_0, p_0) ↦ (q_1, p_1) of any element: for DMOC the forced discrete Hamiltonian map.
///
/// Solves p_0 = left momentum and the stage equations of one interval for all unknowns but q_0 and the controls, by
/// Newton's method from traced formulas, and reads q_1 and the right momentum. For tangent-space collocation p = L_v(q,
/// v) at both ends. `Scalar` is double or long double.
template <class Scalar>
class OneStepMap {
 public:
  /// A vector of the map's numbers.
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  /// A matrix of the map's numbers.
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  /// The image of a point.
  struct Step {
    Vector q;              ///< q_1, n entries
    Vector p;              ///< p_1
    Vector mean_velocity;  ///< (q_1 - q_0)/h, an estimate for the next step
    Vector impulse;        ///< h Σ b_i f(Q_i, Q̇_i, U_i), n entries
    /// The solved interval, for `jacobian`: its `IntervalUnknowns` as by `take_unknowns`, h, t and p_0.
    std::vector<Scalar> inputs;
  };

  /// The map of one interval of `element` by `tableau`; traces it.
  OneStepMap(const TracedProblem& problem, const Element& element, const Tableau& tableau);

  /// One step of length `h` from (q_0, p_0) at time `t`. Row i of `controls` is U_i, at
  /// stage i of `Element::controls` (s × m). `velocity` is an estimate
  /// of q̇, from which the iteration starts. Throws `Error` if it does not converge.
  [[nodiscard]] Step advance(const Vector& q_0, const Vector& p_0, const Vector& velocity, const Matrix& controls,
                             Scalar h, Scalar t) const;

  /// ∂(q_1, p_1)/∂(q_0, p_0) at a step, 2n × 2n, by the implicit function theorem: exact to rounding.
  [[nodiscard]] Matrix jacobian(const Step& step) const;

 private:
  Eigen::Index n_;
  Eigen::Index unknowns_ = 0;
  NodeState node_state_;
  Eigen::Index interior_;  // number of stages whose rates are unknowns
  TracedNewton<Scalar> newton_;
  Schedule reading_;      // right momentum, then the impulse
  Schedule derivatives_;  // R by w, R by q_0, right momentum by w, by q_0, column by column
};

extern template class OneStepMap<double>;
extern template class OneStepMap<long double>;

/// The symplecticity defect of a map of (q, p) with the Jacobian D (2n × 2n): the largest entry of |DᵀΩD - Ω| with
/// Ω = (0, I; -I, 0). Its rounding is a few ε times the square of the largest entry of D.
template <class Matrix>
[[nodiscard]] typename Matrix::Scalar symplecticity_defect(const Matrix& d) {
  const Eigen::Index n = d.rows() / 2;
  Matrix omega = Matrix::Zero(2 * n, 2 * n);
  omega.topRightCorner(n, n).setIdentity();
  omega.bottomLeftCorner(n, n) = -Matrix::Identity(n, n);
  const Matrix defect = d.transpose() * omega * d - omega;
  return defect.template lpNorm<Eigen::Infinity>();
}

}  // namespace dmocbench
