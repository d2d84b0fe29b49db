// Claims on energy, momentum, smoothness, coercivity and the order theorem: each false number flips the row it should.

#include <gtest/gtest.h>

#include "bench/claims/claim.hpp"
#include "tests/bench/all_tables_for_claims.hpp"

namespace dmocbench {
namespace {

using tests::has;

struct FalseNumber {
  std::string table;
  tests::Where where;
  std::string column;
  double number;
  std::string claim;
};

ClaimVerdict verdict_with(const FalseNumber& doctored) {
  ResultTables results;
  for (const auto& [name, rows] : tests::all_rows()) {
    Table table;
    for (Row row : rows) {
      if (name == doctored.table && doctored.where(row)) row.set(doctored.column, doctored.number);
      table.append(std::move(row));
    }
    results.add(name, std::move(table));
  }
  for (const JudgedClaim& judged : judge_claims(results)) {
    if (judged.id == doctored.claim) return judged.verdict;
  }
  ADD_FAILURE() << "no claim " << doctored.claim;
  return ClaimVerdict::not_yet;
}

TEST(TheoryClaims, DifferByOneFalseNumberOfTheirTables) {
  const std::string on_orbit = "orbital_transfer/";
  const std::vector<FalseNumber> all{
      {"structure_energy_work", has("method", "dmoc"), "largest_gap", 2e-8, on_orbit + "energy_against_work"},
      {"structure_energy_work_slopes", has("quantity", "gap_to_modified_work_6"), "slope", 4.0,
       on_orbit + "modified_energy_and_work"},
      {"structure_modified_energy_slopes", has("method", "tangent"), "slope", 4.0,
       "simulations/modified_energy_by_orders"},
      {"structure_modified_energy_slopes", has("method", "dmoc"), "slope", 2.0,
       "simulations/modified_energy_by_orders"},
      {"structure_rotations", has("method", "dmoc"), "defect", 1e-9, "simulations/rotations_about_three_axes"},
      {"structure_rotations", has("action", "linear"), "work", 0.0, "simulations/rotations_about_three_axes"},
      {"structure_orthogonal_forces", has("method", "dmoc"), "momentum_deviation", 1e-10,
       "examples/momentum_of_optimal_motions"},
      {"structure_orthogonal_forces", has("method", "tangent"), "momentum_deviation", 1e-14,
       "examples/momentum_of_optimal_motions"},
      {"consistency_order_transforms", has("problem", orbit), "right_defect", 1e-3,
       on_orbit + "exact_legendre_transform"},
      {"consistency_order_slopes", has("quantity", "left_legendre"), "slope", 2.0, on_orbit + "order_theorem"},
      {"smoothness_slopes", has("active", "control"), "slope", 1.0, "examples/order_within_control_bounds"},
      {"smoothness_slopes", has("end", "free"), "slope", 1.0, "examples/order_with_a_free_end"},
      {"smoothness_slopes", has("stages", "2"), "slope", 4.0, "examples/kinks_leave_order_2"},
      {"smoothness_slopes", has("quantity", "costate_q"), "slope", 2.0, "examples/order_within_a_state_bound"},
      {"low_thrust", has("method", "tangent"), "cost_error", 2e-4,
       on_orbit + "low_thrust_structure_pays_in_momentum_alone"},
      {"low_thrust", has("method", "tangent"), "momentum_balance", 1.5e-13,
       on_orbit + "low_thrust_structure_pays_in_momentum_alone"},
      {"low_thrust", has("method", "multiple_shooting_midpoint_1"), "state_error", 1e-4,
       on_orbit + "low_thrust_structure_pays_beside_explicit"},
      {"low_thrust", has("method", "multiple_shooting_rk4_1"), "cost_error", 5e-5,
       on_orbit + "low_thrust_order_pays_more"},
      {"primitives", has("problem", "hovercraft"), "excess_after", 0.4, "examples/global_minima_by_primitives"},
      {"primitives", has("problem", orbit), "excess_of_starts", -0.1, "examples/global_minima_by_primitives"},
      {"primitives", has("problem", orbit), "plan_lower", 10.5, "examples/global_minima_by_primitives"},
      {"step_control_symplecticity", has("rule", "variational"), "defect", 1e-3,
       "simulations/variational_steps_symplectic"},
      {"step_control_symplecticity", has("rule", "imposed"), "defect", 1e-15,
       "simulations/variational_steps_symplectic"},
      {"step_control_momentum", has("rule", "imposed"), "defect", 1e-6,
       "simulations/steps_by_the_motion_keep_momentum"},
      {"step_control_momentum", has("rule", "imposed"), "work", 0.0, "simulations/steps_by_the_motion_keep_momentum"},
      {"step_control_energy_behaviour", has("rule", "variational"), "range", 0.1,
       "simulations/variational_steps_energy"},
      {"step_control_energy_behaviour", has("rule", "from_left"), "change", 1e-6,
       "simulations/variational_steps_energy"},
      {"step_control", has("rule", "imposed"), "state_error", 2e-3, "simulations/variational_steps_accuracy"},
      {"step_control_transfer", has("rule", "imposed"), "cost_error", 2e-3, "simulations/variational_steps_accuracy"},
      {"coercivity", has("intervals", "256"), "smallest_curvature", 0.5, on_orbit + "coercive"},
      {"coercivity", has("intervals", "256"), "smallest_curvature", 1e-3, "examples/brachistochrone_not_coercive"},
  };
  for (const FalseNumber& doctored : all) {
    EXPECT_EQ(verdict_with({doctored.table, [](const Row&) { return false; }, doctored.column, 0.0, doctored.claim}),
              ClaimVerdict::reproduced)
        << doctored.claim;
    EXPECT_EQ(verdict_with(doctored), ClaimVerdict::differs) << doctored.claim << ", " << doctored.column;
  }
}

TEST(TheoryClaims, TheOrderTheoremHoldsWithOnePowerLessWhereItFailsAsPrinted) {
  const auto forces_and_transforms = [](const Row& row) {
    return row.text("quantity").ends_with("force") || row.text("quantity").ends_with("legendre");
  };
  const FalseNumber measured{"consistency_order_slopes", forces_and_transforms, "slope", 2.0, ""};
  const auto verdict = [&](const char* claim) {
    FalseNumber of_claim = measured;
    of_claim.claim = std::string(orbit) + "/" + claim;
    return verdict_with(of_claim);
  };
  EXPECT_EQ(verdict("order_theorem"), ClaimVerdict::differs);
  EXPECT_EQ(verdict("order_theorem_with_one_power_less"), ClaimVerdict::reproduced);
}

}  // namespace
}  // namespace dmocbench
