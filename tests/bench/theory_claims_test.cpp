// Claims on energy, momentum, smoothness, coercivity and the order theorem: each false number flips the row it should.

#include <gtest/gtest.h>

#include "bench/claims/claim.hpp"
#include "tests/bench/false_number.hpp"

namespace dmocbench {
namespace {

using tests::has;

using tests::FalseNumber;
using tests::Rows;
using tests::verdict_with;

TEST(TheoryClaims, DifferByOneFalseNumberOfTheirTables) {
  const std::string on_orbit = "orbital_transfer/";
  const std::vector<FalseNumber> all{
      {"invariants_energy_work", has("method", "dmoc"), "largest_gap", 2e-7, on_orbit + "energy_against_work"},
      {"invariants_energy_work_slopes", has("truncation", "6"), "slope", 4.0, on_orbit + "modified_energy_and_work"},
      {"invariants_modified_energy_slopes", has("method", "tangent"), "slope", 4.0,
       "simulations/modified_energy_by_orders"},
      {"invariants_modified_energy_slopes", has("method", "dmoc"), "slope", 2.0,
       "simulations/modified_energy_by_orders"},
      {"invariants_rotations", has("method", "dmoc"), "defect", 1e-9, "simulations/rotations_about_three_axes"},
      {"invariants_rotations", has("action", "linear"), "work", 0.0, "simulations/rotations_about_three_axes"},
      {"invariants_orthogonal_forces", has("method", "dmoc"), "momentum_deviation", 1e-10,
       "examples/momentum_of_optimal_motions"},
      {"invariants_orthogonal_forces", has("method", "tangent"), "momentum_deviation", 1e-14,
       "examples/momentum_of_optimal_motions"},
      {"consistency_order_transforms", has("problem", orbit), "right_defect", 1e-3,
       on_orbit + "exact_legendre_transform"},
      {"consistency_order_slopes", has("quantity", "left_legendre"), "slope", 2.0, on_orbit + "order_theorem"},
      {"equivalence_velocity_constraints", has("method", "hamiltonian"), "control_difference", 1e-8,
       "constrained/velocity_equal_solutions"},
      {"consistency_velocity_constraints", has("method", "dmoc"), "momentum_defect_max", 1e-6,
       "constrained/velocity_momentum"},
      {"convergence_velocity_constraints_slopes", has("quantity", "costate"), "slope", 1.0,
       "constrained/velocity_orders"},
      {"equivalence_phases", has("stages", "2"), "control_difference", 1e-5, "phases/equal_solutions"},
      {"consistency_phases", has("method", "dmoc"), "momentum_defect_total", 1e-6, "phases/momentum"},
      {"convergence_phases_slopes", has("quantity", "costate"), "slope", 3.0, "phases/orders"},
      {"invariants_impacts_slopes", has("condition", "steps"), "slope", 2.5, "phases/energy_at_impacts"},
      {"invariants_impacts", has("condition", "momenta"), "energy_change", 1e-9, "phases/energy_at_impacts"},
      {"error_constants_limits", has("quantity", "replay_error"), "constant", 1.21,
       on_orbit + "replay_error_is_predicted"},
      {"error_constants_two_stages_limits", has("quantity", "predicted_objective_error"), "constant", 1.21,
       "examples/cost_error_is_predicted"},
      {"closed_loop", has("feedback", "closed"), "final_distance", 0.1, on_orbit + "feedback_corrects_plans"},
      {"closed_loop", has("feedback", "closed"), "final_distance", 0.1, on_orbit + "order_under_feedback"},
      {"closed_loop", has("method", "tangent"), "cost", 1e-3, on_orbit + "disturbances_exceed_differences"},
      {"rigid_body_coordinates", has("problem", "satellite_quaternion_embedded"), "optimum_state_difference", 1e-9,
       "rigid_body/one_optimum"},
      {"rigid_body_coordinates_near_singularity_slopes", has("quantity", "replay"), "slope", 1.7,
       "rigid_body/one_order"},
      {"rigid_body_coordinates", has("problem", "satellite_quaternion_embedded"), "state_error", 0.0041,
       "rigid_body/charts"},
      {"rigid_body_coordinates", has("problem", "satellite_angles"), "free_variables", 380.0, "rigid_body/charts"},
      {"rigid_body_coordinates", has("problem", "satellite_quaternion_embedded"), "state_error", 0.02,
       "rigid_body/attitude_error"},
      {"rigid_body_coordinates_near_singularity", has("problem", "satellite_angles"), "state_error", 0.09,
       "rigid_body/near_singularity"},
      {"rigid_body_coordinates_near_singularity", has("problem", "satellite_directors"), "state_error", 0.009,
       "rigid_body/near_singularity"},
      {"smoothness_slopes", has("active", "control"), "slope", 1.0, "examples/order_within_control_bounds"},
      {"smoothness_slopes", has("end", "free"), "slope", 1.0, "examples/order_with_a_free_end"},
      {"smoothness_slopes", has("stages", "2"), "slope", 4.0, "examples/kinks_leave_order_2"},
      {"smoothness_slopes", has("quantity", "costate_q"), "slope", 2.0, "examples/order_within_a_state_bound"},
      {"coercivity", has("intervals", "256"), "smallest_curvature", 0.5, on_orbit + "coercive"},
      {"coercivity", has("end", "free"), "smallest_curvature", 0.0, on_orbit + "coercive_with_a_free_end"},
      {"coercivity", has("intervals", "256"), "smallest_curvature", 1e-3, "examples/brachistochrone_not_coercive"},
  };
  tests::expect_to_differ(all);
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
  EXPECT_EQ(verdict("order_theorem"), ClaimVerdict::differs) << "(ii) fails, whatever (iii) does";
  EXPECT_EQ(verdict("order_theorem_with_one_power_less"), ClaimVerdict::reproduced);
}

TEST(TheoryClaims, SecondOrderReplayHasASentenceForEachDirection) {
  Rows rows = tests::limit_rows("1");
  for (Row& row : rows) {
    if (row.text("problem") == "kepler_cartesian" && row.text("method") == "second_order") row.set("constant", 0.3);
  }
  const JudgedClaim judged =
      tests::judged_claim("examples/second_order_replay", tests::results_of({{"error_constants_limits", rows}}));
  ASSERT_EQ(judged.clauses.size(), 2U);
  const std::string more = judged.clauses[0].text;
  const std::string less = judged.clauses[1].text;
  EXPECT_NE(more.find("by more than DMOC's"), std::string::npos) << more;
  EXPECT_NE(more.find(orbit), std::string::npos) << more;
  EXPECT_EQ(more.find("kepler_cartesian"), std::string::npos) << more;
  EXPECT_NE(less.find("by less than DMOC's (ratios of the limits: kepler_cartesian 0.25"), std::string::npos) << less;
  EXPECT_EQ(less.find(orbit), std::string::npos) << less;
}

}  // namespace
}  // namespace dmocbench
