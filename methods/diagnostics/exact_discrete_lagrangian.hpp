#pragma once

#include <vector>

#include "methods/diagnostics/discrete_lagrangian.hpp"
#include "methods/diagnostics/one_step_map.hpp"
#include "methods/expression/schedule.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// A motion of the forced Euler-Lagrange equations on [0, h] and the exact discrete objects between its end points.
struct ExactInterval {
  LongVector q_0;                ///< q(0), n entries
  LongVector v_0;                ///< q̇(0)
  LongVector q_1;                ///< q(h)
  LongVector v_1;                ///< q̇(h)
  DiscreteObjects objects;       ///< L_d^E, f_d^{E±} with p_0 = L_v(0), p_1 = L_v(h)
  LongMatrix right_by_velocity;  ///< ∂q(h)/∂q̇(0) at fixed q(0), n × n
  LongMatrix derivative;         ///< of the flow, ∂(q, q̇)(h)/∂(q, q̇)(0), 2n × 2n
};

/// The exact discrete Lagrangian and forces, (eq:varmech_exactL), (eq:varmech_exactf+) and (eq:varmech_exactf-), for a
/// given smooth control.
///
/// The equations of motion and their variational equations are integrated in long double, adaptively with an explicit
/// method of order 7(8) and tolerance 1e-17. With A = ∂q(t)/∂q(0) and B = ∂q(t)/∂q̇(0), the derivatives at fixed end
/// points that the forces need are ∂q(t)/∂q_1 = B(t) B(h)⁻¹ and ∂q(t)/∂q_0 = A(t) - B(t) B(h)⁻¹ A(h).
class ExactDiscreteLagrangian {
 public:
  /// `control` is called once with the traced time.
  ExactDiscreteLagrangian(const Problem& problem, const ControlFormula& control);

  /// The motion from (q_0, v_0) at t = 0, and the objects between its ends; h > 0. Throws `Error` if the motion cannot
  /// be integrated or h is a conjugate time (B(h) is singular).
  [[nodiscard]] ExactInterval along(const LongVector& q_0, const LongVector& v_0, long double h) const;

  /// The motion with q(0) = q_0, q(h) = q_1: the boundary value problem, by shooting with Newton's method from
  /// q̇(0) = `v_start`. Throws `Error` if it does not converge.
  [[nodiscard]] ExactInterval between(const LongVector& q_0, const LongVector& q_1, const LongVector& v_start,
                                      long double h) const;

  /// The control at time t, m entries.
  [[nodiscard]] LongVector control(long double t) const;

 private:
  void derivative(const std::vector<long double>& state, std::vector<long double>& rate, long double t) const;

  Eigen::Index n_;
  Schedule control_;   // of t
  Schedule equation_;  // of (q, v, a, t): R = d/dt L_v - L_q - f with a for q̈; ∂R/∂a, ∂R/∂q, ∂R/∂v; L; f
  Schedule momentum_;  // of (q, v, a, t): L_v
};

/// Distances between DMOC's discrete objects and the exact ones on [0, h], the largest over some motions.
struct ConsistencyErrors {
  double lagrangian = 0.0;      ///< |L_d - L_d^E| (eq:DMOC_orderL)
  double left_force = 0.0;      ///< ‖f_d^- - f_d^{E-}‖ (eq:DMOC_orderf)
  double right_force = 0.0;     ///< ‖f_d^+ - f_d^{E+}‖
  double left_legendre = 0.0;   ///< ‖𝔽^{f-}L_d - 𝔽^{f-}L_d^E‖ (eq:DMOC_orderLeg)
  double right_legendre = 0.0;  ///< ‖𝔽^{f+}L_d - 𝔽^{f+}L_d^E‖
  double map = 0.0;             ///< ‖(q_1, p_1) - exact‖ of the one-step map from the same (q_0, p_0)
};

/// The errors in (th:ordercalculation): errors of the discrete objects at the end points of exact motions, under one
/// smooth control whose values at the stage times are the discrete controls.
class ConsistencyOrder {
 public:
  /// `starts` are the initial conditions of the motions, at t = 0.
  ConsistencyOrder(const Problem& problem, const ControlFormula& control, std::vector<BoundaryState> starts);

  /// Largest errors over the motions, one entry per tableau. Throws `Error` if an equation cannot be solved for this h.
  [[nodiscard]] std::vector<ConsistencyErrors> errors(const std::vector<Tableau>& tableaus, double h) const;

 private:
  const Problem& problem_;
  ExactDiscreteLagrangian exact_;
  std::vector<BoundaryState> starts_;
};

}  // namespace dmocbench
