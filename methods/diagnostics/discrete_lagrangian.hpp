#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "methods/diagnostics/traced_newton.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

/// A vector of numbers with 64 bits of mantissa.
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
/// A matrix of numbers with 64 bits of mantissa.
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// A control as a formula of time, m entries.
using ControlFormula = std::function<ExpressionVector(const Expression& t)>;

/// The discrete mechanical objects of one interval [0, h] with end points q_0 and q_1, approximate or exact.
struct DiscreteObjects {
  long double lagrangian = 0.0L;  ///< L_d(q_0, q_1)
  LongVector left_force;          ///< f_d^-, n entries
  LongVector right_force;         ///< f_d^+
  LongVector left_momentum;       ///< p_0 of the forced discrete Legendre transform (eq:varmech_dlegf-)
  LongVector right_momentum;      ///< p_1 of (eq:varmech_dlegf+)
};

/// The discrete Lagrangian L_d (eq:DMOC_RK_L) and the discrete forces f_d^± (eq:DMOC_RK_f) of DMOC, one by one, for any
/// tableau.
///
/// The element states A(q_0, q_1, Q̇) and the virtual work at fixed interior rates. The stage equations make the rates
/// functions of (q_0, q_1), so that f_d^± = h Σ b_i f·∂Q_i/∂q needs dQ̇/dq from the implicit function theorem. (Only the
/// sum D_1 L_d + f_d^- does not: there the stage equations cancel the terms with dQ̇/dq.) Computed in long double.
class DiscreteLagrangian {
 public:
  /// Traces L_d and f_d of the problem by this tableau.
  DiscreteLagrangian(const Problem& problem, const Tableau& tableau);

  /// The objects between `q_0` and `q_1` on an interval of length `h` that begins at time `t`. Row i of `controls` is
  /// U_i (s × m). Throws `Error` if the interior rates cannot be found.
  [[nodiscard]] DiscreteObjects at(const LongVector& q_0, const LongVector& q_1, const LongMatrix& controls,
                                   long double h, long double t) const;

 private:
  Eigen::Index n_;
  Eigen::Index stages_;
  TracedNewton<long double> interior_rates_;
  // A; ∂A/∂q_0 + W, ∂A/∂q_1 + W; W[∂Q/∂q_0], W[∂Q/∂q_1], W[∂Q/∂Q̇]; stage equations by Q̇, q_0, q_1, column by column
  Schedule objects_;
};

}  // namespace dmocbench
