// Well-formed tables that are false: each turns the verdict that it should, though no field is missing and every number
// is a number.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/claims/claim.hpp"
#include "tests/bench/all_tables_for_claims.hpp"

namespace dmocbench {
namespace {

using tests::Rows;

struct Mistake {
  std::string what;
  std::string table;
  std::function<void(Rows&)> plant;
  std::string claim;  ///< its whole id
  ClaimVerdict becomes = ClaimVerdict::differs;
};

std::ostream& operator<<(std::ostream& stream, const Mistake& mistake) { return stream << mistake.what; }

using tests::has;
using tests::Where;

bool every_row(const Row& /*row*/) { return true; }

/// Changes a field of some rows.
std::function<void(Rows&)> set(const Where& where, const std::string& column, const Cell& value) {
  return [=](Rows& rows) {
    for (Row& row : rows) {
      if (where(row)) row.set(column, value);
    }
  };
}
/// Multiplies a number of some rows.
std::function<void(Rows&)> scale(const Where& where, const std::string& column, double factor) {
  return [=](Rows& rows) {
    for (Row& row : rows) {
      if (where(row)) row.set(column, row.needed(column) * factor);
    }
  };
}

/// Times of a clock that cannot be relied on: half of the rounds say one thing, half the opposite.
std::string noisy_rounds(double value) {
  std::vector<double> times(12);
  for (std::size_t round = 0; round < times.size(); ++round) times[round] = value * (round % 2 == 0 ? 0.4 : 2.5);
  return joined_numbers(times);
}

std::string on_orbit(const std::string& claim) { return std::string(orbit) + "/" + claim; }

std::vector<Mistake> mistakes_about_solutions() {
  return {
      {"a slope of first order", "convergence_slopes", set(has("method", "dmoc"), "slope", 1.0),
       on_orbit("state_slope")},
      {"a slope whose error is as large as itself", "convergence_slopes",
       [](Rows& rows) {
         set(every_row, "slope", 2.6)(rows);
         set(every_row, "standard_error", 2.0)(rows);
       },
       on_orbit("control_slope"), ClaimVerdict::undecided},
      {"a slope that the reference has not been taken out of", "convergence_512_slopes", set(every_row, "slope", 2.13),
       "two_link_manipulator/state_slope_against_512"},
      {"a cost of DMOC that is nearer to the optimum than it is", "objective",
       set([](const Row& row) { return row.text("method") != "tangent"; }, "objective", 4e-5 * (1.0 + 1e-7)),
       on_orbit("objective_evolution")},
      {"another cost in Mayer form", "objective_mayer", scale(has("method", "dmoc"), "objective", 1.0 + 1e-7),
       on_orbit("bolza_is_mayer")},
      {"another cost of Hamiltonian collocation", "objective",
       scale(has("method", "hamiltonian"), "objective", 1.0 + 1e-7), on_orbit("objective_evolution")},
      {"a reference that is DMOC's own finest grid", "convergence_indirect_reference",
       set(every_row, "cost", 4e-5 * (1.0 + std::pow(1.0 / 1024.0, 2) * 0.999)), on_orbit("objective_evolution")},
      {"a balance of momentum that is solved loosely", "consistency",
       set(has("method", "dmoc"), "momentum_defect_max", 1e-9), on_orbit("momentum_consistency")},
      {"a balance that tangent-space collocation keeps on fine grids", "consistency",
       set([](const Row& row) { return row.text("method") == "tangent" && row.text("intervals") == "1024"; },
           "momentum_defect_total", 1e-15),
       on_orbit("momentum_consistency")},
      {"costates that differ", "equivalence", set(has("method", "hamiltonian"), "costate_difference", 1e-6),
       on_orbit("equal_solutions")},
      {"a solution of DMOC in the other form of the control Lagrangian", "equivalence",
       set(has("method", "hamiltonian"), "forced_form_residual", 1e-5), on_orbit("dmoc_is_the_forced_form")},
      {"DMOC's motion replayed half as well", "convergence", scale(has("method", "dmoc"), "replay_error", 2.0),
       on_orbit("replay_beside_tangent")},
      {"an order at the nodes that is that of the stages", "convergence_indirect_slopes",
       set([](const Row& row) { return row.text("quantity") == "costate" && row.text("stages") == "3"; }, "slope", 4.0),
       on_orbit("order_of_convergence")},
      {"orders of which all but one are rounding", "convergence_indirect_slopes",
       [](Rows& rows) {
         for (std::size_t i = 1; i < rows.size(); ++i) rows[i].set("verdict", "floor");
       },
       on_orbit("order_of_convergence"), ClaimVerdict::floor},
      {"an adjoint scheme that Lobatto fulfils without the exchange", "equivalence",
       set(has("tableau", "lobatto"), "adjoint_residual_by_plain_coefficients", 1e-12),
       on_orbit("order_of_adjoint_scheme")},
      {"orders of 1 by the low tableaus, which finer grids contradict", "convergence_indirect_slopes",
       [](Rows& rows) {
         for (Row& row : rows) {
           if (row.text("stages") != "2") continue;
           row.set("slope", 1.0);
           row.set("fine_end", "orders");
         }
       },
       on_orbit("order_of_convergence"), ClaimVerdict::floor},
      {"stage controls of the order of the nodes", "convergence_indirect_slopes",
       set([](const Row& row) { return row.text("quantity") == "control" && row.text("stages") == "3"; }, "slope", 6.0),
       on_orbit("order_of_stage_controls")},
      {"a replay error that is smaller on coarse grids alone", "convergence",
       set([](const Row& row) { return row.text("method") == "dmoc" && row.text("intervals") == "1024"; },
           "replay_error", 1.2 * std::pow(1.0 / 1024.0, 2)),
       on_orbit("replay_beside_tangent"), ClaimVerdict::undecided},
      {"one grid of Hamiltonian collocation that misses the balance", "consistency",
       set([](const Row& row) { return row.text("method") == "hamiltonian" && row.text("intervals") == "1024"; },
           "momentum_defect_max", 1e-9),
       on_orbit("momentum_consistency")},
      {"one grid whose solutions differ", "equivalence",
       set([](const Row& row) { return row.text("method") == "hamiltonian" && row.text("intervals") == "1024"; },
           "control_difference", 1e-7),
       on_orbit("equal_solutions")},
      {"minima that are no motions", "local_minima_minima", set(has("minimum", "2"), "is_motion", "no"),
       "examples/local_minima"},
      {"a homotopy of which DMOC leaves steps unsolved", "sequence",
       set([](const Row& row) { return row.text("method") == "dmoc" && row.number("step", 0.0) > 10.0; }, "status",
           "step failed"),
       on_orbit("warm_starts_in_less_time"), ClaimVerdict::not_judged},
      {"a step by collocation as fast as by DMOC", "sequence", set(has("method", "hamiltonian"), "microseconds", "100"),
       on_orbit("warm_starts_in_less_time")},
  };
}

std::vector<Mistake> mistakes_about_flows() {
  return {
      {"an order of L_d one too low", "consistency_order_slopes", set(has("quantity", "lagrangian"), "slope", 2.0),
       on_orbit("order_of_discrete_lagrangian")},
      {"a momentum that changes by less than the work", "invariants_momentum",
       set(has("force", "along"), "momentum_change", 0.5 - 1e-8), "simulations/forced_noether_theorem"},
      {"forces along the group that do no work", "invariants_momentum",
       [](Rows& rows) {
         for (const char* column : {"momentum_change", "work", "work_of_discrete_forces"})
           set(every_row, column, 0.0)(rows);
       },
       "simulations/forced_noether_theorem"},
      {"a force along the group where it is said to be orthogonal", "invariants_momentum",
       [](Rows& rows) {
         for (const char* column : {"momentum_change", "work", "work_of_discrete_forces"})
           set(every_row, column, 0.1)(rows);
       },
       "simulations/momentum_preserved"},
      {"a flow that is not symplectic", "invariants_symplecticity", set(has("method", "hamiltonian"), "defect", 1e-9),
       "simulations/symplectic"},
      {"a continuous momentum that changes by less than the work", "invariants_flow_momentum",
       set(has("force", "along"), "momentum_change", 0.5 - 1e-8), "simulations/continuous_forced_noether_theorem"},
      {"a continuous momentum that an orthogonal force changes", "invariants_flow_momentum",
       set(has("force", "orthogonal"), "momentum_change", 1e-8), "simulations/continuous_forced_noether_theorem"},
      {"a continuous flow that is not symplectic", "invariants_flow_symplecticity", set(every_row, "defect", 1e-9),
       "simulations/lagrangian_form_preserved"},
      {"an energy that tangent-space collocation balances better", "invariants_energy_work",
       scale(has("method", "tangent"), "largest_gap", 0.01), on_orbit("energy_against_work")},
      {"an energy that it balances better on one grid", "invariants_energy_work",
       scale([](const Row& row) { return row.text("method") == "tangent" && row.text("intervals") == "64"; },
             "largest_gap", 0.01),
       on_orbit("energy_against_work"), ClaimVerdict::undecided},
      {"a negative direction of the second variation", "coercivity",
       set([](const Row& row) { return row.text("end") == "free"; }, "smallest_curvature", -15.25),
       on_orbit("coercive_with_a_free_end")},
      {"an error of the forces that is not a differential", "consistency_order_transforms",
       set(every_row, "force_error_curl", 5e-5), on_orbit("order_theorem")},
      {"transforms of the order that they have", "consistency_order_slopes",
       set([](const Row& row) { return row.text("quantity").ends_with("legendre"); }, "slope", 2.0),
       on_orbit("order_theorem")},
      {"an energy that drifts", "invariants_energy_behaviour", set(has("method", "dmoc"), "range", 0.5),
       "simulations/energy_does_not_drift"},
  };
}

std::vector<Mistake> mistakes_about_cost() {
  const Where sparse = has("factorisation", "sparse");
  const Where differences = [](const Row& row) { return row.text("derivatives").ends_with("differences"); };
  const auto drop = [](const Where& where) { return [=](Rows& rows) { std::erase_if(rows, where); }; };
  return {
      {"minor iterations of DMOC that are a tenth too many", "iterations",
       scale(has("method", "dmoc"), "minor_iterations", 1.1), on_orbit("minor_iteration_ratio")},
      {"all grids but one dropped", "iterations", drop([](const Row& row) { return row.text("intervals") != "64"; }),
       on_orbit("minor_iteration_ratio"), ClaimVerdict::not_judged},
      {"one minor iteration more on one grid", "iterations",
       [](Rows& rows) {
         const auto one = std::ranges::find_if(rows, has("crash", "none"));
         one->set("minor_iterations", one->needed("minor_iterations") + 1.0);
       },
       on_orbit("minor_iterations_equal_variable_ratio")},
      {"a crash basis that saves nothing", "iterations",
       [](Rows& rows) {
         for (Row& row : rows) {
           if (row.text("crash") == "basis") row.set("minor_iterations", row.needed("free_variables") + 3.0);
         }
       },
       on_orbit("minor_iterations_saved_in_phase_1")},
      {"minor iterations that miss the law", "iterations", scale(every_row, "predicted_minors", 1.01),
       on_orbit("minor_iterations_equal_variable_ratio")},
      {"quasi-Newton iterations that all methods need alike", "iterations_limited_memory_by_cost",
       set(every_row, "minor_iterations", 100LL), on_orbit("minor_iteration_ratio_by_quasi_newton")},
      {"minor iterations with bounds that all methods need alike", "iterations_bounds",
       [](Rows& rows) {
         set(every_row, "minor_iterations", 1000LL)(rows);
         set(every_row, "predicted_minors", 900LL)(rows);
       },
       "examples/minor_iteration_ratio_with_active_bounds"},
      {"another optimum by interior_point", "convergence_stages", scale(has("method", "dmoc"), "objective", 1.0 + 1e-7),
       on_orbit("interior_point_beside_ipopt")},
      {"DMOC with the variables of collocation", "convergence",
       scale(has("method", "dmoc"), "free_variables", 5.0 / 3.0), on_orbit("variable_ratio")},
      {"one constraint too many", "convergence_stages", set(has("method", "dmoc"), "constraints", 67LL),
       on_orbit("counts_of_variables_and_constraints")},
      {"savings that equal replay errors do not show", "convergence_equal_accuracy",
       set([](const Row& row) { return row.text("quantity") == "replay" && row.text("method") == "tangent"; },
           "variables_ratio", 0.9),
       on_orbit("savings_at_equal_replay_error")},
      {"a factor of Hamiltonian collocation that is no larger", "iterations_common_ratios",
       set(has("currency", "factor_nonzeros"), "ratio_at_equal_intervals", 0.99),
       on_orbit("collocation_more_expensive")},
      {"differences that need fewer iterations", "derivatives_quasi_newton", set(differences, "major_iterations", 8LL),
       on_orbit("automatic_differentiation_faster")},
      {"differences that need fewer iterations on one grid", "derivatives_quasi_newton",
       set([=](const Row& row) { return differences(row) && row.text("method") == "dmoc"; }, "major_iterations", 8LL),
       on_orbit("automatic_differentiation_faster"), ClaimVerdict::undecided},
      {"one way to eliminate that costs no more", "savings_by_solver_ratios",
       set(sparse, "round_ratios", tests::rounds_around(0.9)), on_orbit("collocation_takes_longer")},
      {"a noisy clock", "savings_by_solver_ratios", set(sparse, "round_ratios", noisy_rounds(1.5)),
       on_orbit("collocation_takes_longer"), ClaimVerdict::undecided},
      {"a verdict from three rounds", "savings_by_solver_ratios", set(sparse, "round_ratios", "1.5 1.5 1.5"),
       on_orbit("collocation_takes_longer"), ClaimVerdict::undecided},
      {"a verdict at the threshold", "savings_by_solver_ratios", set(sparse, "round_ratios", tests::rounds_around(1.0)),
       on_orbit("collocation_more_expensive_on_coarse_grids"), ClaimVerdict::undecided},
      {"differences that are as fast but for noise", "derivatives_quasi_newton",
       set(differences, "round_seconds", tests::rounds_around(0.01, 2.0)),
       on_orbit("automatic_differentiation_saves_time"), ClaimVerdict::undecided},
      {"differences that are faster", "derivatives_quasi_newton",
       set(differences, "round_seconds", tests::rounds_around(0.002)),
       on_orbit("automatic_differentiation_saves_time")},
  };
}

std::map<std::string, JudgedClaim> judged(const tests::TableRows& rows) {
  std::map<std::string, JudgedClaim> claims;
  for (const JudgedClaim& claim : judge_claims(tests::results_of(rows))) claims[claim.id()] = claim;
  return claims;
}

class PlantedMistake : public testing::TestWithParam<Mistake> {};

TEST_P(PlantedMistake, TurnsTheVerdict) {
  static const std::map<std::string, JudgedClaim> before = judged(tests::all_rows());
  const Mistake& mistake = GetParam();
  ASSERT_TRUE(before.contains(mistake.claim)) << mistake.claim;
  EXPECT_EQ(before.at(mistake.claim).verdict, ClaimVerdict::reproduced) << before.at(mistake.claim).measured();
  tests::TableRows rows = tests::all_rows();
  ASSERT_TRUE(rows.contains(mistake.table)) << mistake.table;
  mistake.plant(rows[mistake.table]);
  const JudgedClaim claim = judged(rows).at(mistake.claim);
  EXPECT_EQ(name_of(claim.verdict), name_of(mistake.becomes)) << claim.measured() << '\n' << claim.reason();
}

INSTANTIATE_TEST_SUITE_P(Solutions, PlantedMistake, testing::ValuesIn(mistakes_about_solutions()));
INSTANTIATE_TEST_SUITE_P(Flows, PlantedMistake, testing::ValuesIn(mistakes_about_flows()));
INSTANTIATE_TEST_SUITE_P(Cost, PlantedMistake, testing::ValuesIn(mistakes_about_cost()));

}  // namespace
}  // namespace dmocbench
