#pragma once

#include <array>

#include "methods/diagnostics/discrete_lagrangian.hpp"
#include "methods/diagnostics/traced_newton.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The first three coefficients of a series in h²: of h⁰, h², h⁴.
using StepSeries = std::array<long double, 3>;

/// The series at step h, cut off after 1, 2 and 3 terms: errors are then of order 2, 4 and 6.
[[nodiscard]] StepSeries partial_sums(const StepSeries& series, long double h);

/// The modified energy of the midpoint rule by backward error analysis: the energy of the system that the discrete
/// motion follows more closely than the problem's ("Conservation of a Modified Energy", section 3.3).
///
/// With y = (q, p), X = J∇H and D_c the derivative along a constant direction c, the midpoint rule
/// y_{k+1} = y_k + h X((y_k + y_{k+1})/2) is up to O(h⁶) the flow of H + h²H₂ + h⁴H₄,
///
///   H₂ = -D_X² H/24,   H₄ = -D_X² H₂/24 - D_X D_Y H/30 - D_X⁴ H/1920,   Y = J∇H₂,
///
/// where X and Y are held constant while the derivatives are taken. DMOC and Hamiltonian collocation by one Gauss stage
/// are this rule for every L. methods/diagnostics/README.md derives the terms.
///
/// With forces X becomes F = X + (0, f), and the modified energy changes by modified work: on one step by
/// h (W + h²W₂ + h⁴W₄) + O(h⁷) at the midpoint, where W = f·q̇ is the virtual work of the method and
///
///   W₂ = D_F³ H/24 + D_F H₂,   W₄ = D_F⁵ H/1920 + D_F³ H₂/24 + D_F H₄
///
/// vanish with f. The controls are arbitrary: they may jump from step to step.
class ModifiedEnergy {
 public:
  /// Throws `Error` if L depends on time. L_vv has to be regular, and so have its leading principal minors.
  explicit ModifiedEnergy(const Problem& problem);

  /// H, H₂ and H₄ at (q, v).
  [[nodiscard]] StepSeries energy(const LongVector& q, const LongVector& v) const;
  /// W, W₂ and W₄ at (q, v, u, t), the midpoint of a step.
  [[nodiscard]] StepSeries power(const LongVector& q, const LongVector& v, const LongVector& u, long double t) const;
  /// The v with L_v(q, v) = p, by Newton's method from `start`. Throws `Error` if it does not converge.
  [[nodiscard]] LongVector velocity(const LongVector& q, const LongVector& p, const LongVector& start) const;

 private:
  Schedule energy_;                      // of (q, v)
  Schedule power_;                       // of (q, v, u, t)
  TracedNewton<long double> transform_;  // of (q, v, p), solved for v
};

}  // namespace dmocbench
