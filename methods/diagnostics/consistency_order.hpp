#pragma once

#include <vector>

#include "methods/diagnostics/discrete_lagrangian.hpp"
#include "methods/diagnostics/exact_discrete_lagrangian.hpp"
#include "methods/diagnostics/one_step_map.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

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
