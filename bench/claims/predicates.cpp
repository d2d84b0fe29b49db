#include "bench/claims/predicates.hpp"

#include <string>

#include "bench/claims/claim_rows.hpp"

namespace dmocbench {

namespace {

// Statements without an experiment so far.
std::vector<Claim> claims_without_experiment() {
  const auto open = [](const std::string& id, const char* where, const char* paper) {
    return Claim{
        .id = id, .where = where, .paper = paper, .measured = "no experiment yet", .verdict = Verdict::not_yet};
  };
  const std::string o = orbit;
  const std::string t = two_link;
  return {
      open(t + "/order_of_adjoint_scheme", "th:orderapp", "the adjoint scheme has the order of the state scheme"),
      open(t + "/order_of_convergence", "main_theorem", "order kappa for state, costate and u(x, psi) at the nodes"),
      open(t + "/order_of_consistency", "th:ordercalculation",
           "L_d, f_d and the Legendre transforms have the map's order"),
      open(o + "/forced_noether_theorem", "th:discforcNoe",
           "a force orthogonal to the group action keeps the momentum"),
      open(o + "/modified_energy", "section 2.2", "energy oscillates but does not drift"),
      open(t + "/local_minima", "section 4.1", "different initial guesses can lead to different solutions"),
  };
}

}  // namespace

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
    claims.push_back(derivatives_claim(tables, problem));
    claims.push_back(adolc_claim(tables, problem));
  }
  for (const Row* row : tables.rows("slips")) claims.push_back(slip_claim(*row));
  for (Claim& claim : claims_without_experiment()) claims.push_back(std::move(claim));
  return claims;
}

}  // namespace dmocbench
