#include "bench/claims/predicates.hpp"

#include <string>

#include "bench/claims/claim_rows.hpp"
#include "bench/summary/performance_profile.hpp"

namespace dmocbench {

std::vector<Claim> judge_claims(const ResultTables& tables) {
  std::vector<Claim> claims;
  for (const std::string problem : {orbit, two_link}) {
    claims.push_back(consistency_claim(tables, problem));
    claims.push_back(equality_claim(tables, problem));
    claims.push_back(difference_claim(tables, problem));
    claims.push_back(slope_claim(tables, problem, "state", "convergence_slopes"));
    claims.push_back(slope_claim(tables, problem, "control", "convergence_slopes"));
    if (problem == two_link) {
      claims.push_back(slope_claim(tables, problem, "state", "convergence_512_slopes"));
      claims.push_back(slope_claim(tables, problem, "control", "convergence_512_slopes"));
    }
    claims.push_back(objective_claim(tables, problem));
    claims.push_back(variable_claim(tables, problem));
    claims.push_back(step_claim(tables, problem));
    claims.push_back(minor_iterations_claim(tables, problem));
    claims.push_back(agreement_claim(tables, problem));
    claims.push_back(crash_claim(tables, problem));
    claims.push_back(expense_claim(tables, problem));
    claims.push_back(factorisation_claim(tables, problem));
    claims.push_back(derivatives_claim(tables, problem));
    claims.push_back(adolc_claim(tables, problem));
  }
  for (const std::string problem : {orbit, two_link}) {
    claims.push_back(consistency_order_claim(tables, problem,
                                             {.id = "order_of_discrete_lagrangian",
                                              .where = "eq:DMOC_orderL, th:ordercalculation",
                                              .paper = "L_d and the one-step map are exact up to h^(r + 1)",
                                              .quantities = {"lagrangian", "map"}}));
    claims.push_back(consistency_order_claim(tables, problem,
                                             {.id = "order_of_discrete_forces",
                                              .where = "eq:DMOC_orderf",
                                              .paper = "f_d is exact up to h^(r + 1)",
                                              .quantities = {"left_force", "right_force"}}));
    claims.push_back(consistency_order_claim(tables, problem,
                                             {.id = "order_of_legendre_transforms",
                                              .where = "eq:DMOC_orderLeg",
                                              .paper = "the discrete Legendre transforms are exact up to h^(r + 1)",
                                              .quantities = {"left_legendre", "right_legendre"}}));
  }
  for (const std::string problem : {orbit, two_link}) {
    claims.push_back(convergence_order_claim(tables, problem));
    claims.push_back(adjoint_order_claim(tables, problem));
  }
  for (const std::string problem : {orbit, two_link}) {
    claims.push_back(local_minima_claim(tables, problem));
    claims.push_back(best_minimum_claim(tables, problem));
  }
  // The orbit's costate is nearly constant, and so low-order terms of its stages are too small to be seen.
  claims.push_back(stage_control_claim(tables, two_link));
  claims.push_back(coincidence_claim(tables));
  claims.push_back(noether_claim(tables, "along"));
  claims.push_back(noether_claim(tables, "orthogonal"));
  claims.push_back(symplecticity_claim(tables));
  claims.push_back(modified_energy_claim(tables));
  // The library is swept by choice only.
  if (!tables.rows("profile_summary").empty()) {
    for (const std::string& measure : profile_measures()) claims.push_back(library_claim(tables, measure));
  }
  for (const Row* row : tables.rows("slips")) claims.push_back(slip_claim(*row));
  return claims;
}

}  // namespace dmocbench
