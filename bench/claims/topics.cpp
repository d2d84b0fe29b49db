#include "bench/claims/claim.hpp"

namespace dmocbench {

Claims solution_claims();
Claims grid_claims();
Claims accuracy_claims();
Claims error_constant_claims();
Claims iteration_claims();
Claims cost_claims();
Claims derivative_claims();
Claims energy_claims();
Claims coercivity_claims();
Claims consistency_order_claims();
Claims order_theorem_claims();
Claims order_claims();
Claims galerkin_claims();
Claims minima_claims();
Claims cold_start_claims();
Claims warm_start_claims();
Claims closed_loop_claims();
Claims shooting_claims();
Claims stage_control_claims();
Claims coincidence_claims();
Claims flow_claims();
Claims modified_energy_claims();
Claims rotation_claims();
Claims optimal_momentum_claims();
Claims smoothness_claims();
Claims constraint_claims();
Claims phase_claims();
Claims rigid_body_claims();
Claims adaptive_claims();
Claims library_claims();

std::vector<std::vector<Claims (*)()>> topics_by_chapter() {
  return {
      {solution_claims, grid_claims, accuracy_claims, iteration_claims, cost_claims, derivative_claims},
      {energy_claims, coercivity_claims},
      {consistency_order_claims, order_theorem_claims},
      {order_claims, galerkin_claims, error_constant_claims},
      {minima_claims, cold_start_claims, warm_start_claims, closed_loop_claims},
      {shooting_claims},
      {stage_control_claims, coincidence_claims, flow_claims, modified_energy_claims, rotation_claims},
      {optimal_momentum_claims, smoothness_claims},
      {constraint_claims, rigid_body_claims, phase_claims},
      {adaptive_claims},
      {library_claims},
  };
}

}  // namespace dmocbench
