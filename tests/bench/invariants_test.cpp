#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "bench/experiments/invariants/energy_tables.hpp"
#include "bench/experiments/invariants/impact_tables.hpp"
#include "bench/experiments/invariants/long_time_energy.hpp"
#include "bench/experiments/invariants/momentum_tables.hpp"
#include "bench/experiments/invariants/simulated_tables.hpp"

namespace dmocbench {
namespace {

double number(const Row& row, const std::string& column) {
  return row.number(column).value_or(std::numeric_limits<double>::quiet_NaN());
}

TEST(NoetherTable, BalanceHoldsToRoundingForDmocAndHamiltonianAndNotForTangent) {
  const Table table = noether_table(50);
  ASSERT_FALSE(table.rows().empty());
  for (const Row& row : table.rows()) {
    const double defect = number(row, "defect");
    const double in_long_double = number(row, "defect_in_long_double");
    const std::string label = row.text("problem") + " " + row.text("method") + " " + row.text("stages");
    if (row.text("method") == "tangent") {
      if (row.text("tableau") == "gauss") {
        EXPECT_GT(in_long_double, 1e-13) << label;  // three stages leave little
      }
    } else {
      EXPECT_LT(defect, 3e-12) << label;
      EXPECT_LT(in_long_double, 1e-15) << label;
    }
    if (row.text("method") == "tangent" && row.text("stages") == "1") {
      EXPECT_GT(in_long_double, 1e-9) << label;
    }
    if (row.text("method") == "dmoc") {
      EXPECT_NEAR(number(row, "work_of_discrete_forces"), number(row, "work"), 1e-14) << label;
    }
    if (row.text("force") == "orthogonal") {
      EXPECT_EQ(number(row, "work"), 0.0) << label;
    } else {
      EXPECT_GT(std::abs(number(row, "work")), 1e-6) << label;
    }
  }
}

TEST(SymplecticityTable, OnlyTangentWithAMovingMassIsNotSymplectic) {
  const Table table = symplecticity_table(example_states()).table;
  for (const Row& row : table.rows()) {
    // A constant mass saves tangent-space collocation with Gauss tableaus alone: others are not their own conjugate.
    if (row.text("method") == "tangent" && row.text("tableau") != "gauss") continue;
    const bool symplectic = number(row, "defect") < 100.0 * number(row, "rounding");
    EXPECT_EQ(symplectic, row.text("method") != "tangent" || row.text("problem") == "kepler")
        << row.text("problem") << " " << row.text("method") << " " << row.text("stages");
  }
}

TEST(ImpactTables, EnergiesOfTheNeighbouringStepsHaveOrderOneAsSoonAsForcesAct) {
  const ImpactTables tables = impact_tables({16, 32, 64, 128, 256});
  for (const Row& row : tables.impacts.rows()) {
    if (row.text("condition") != "momenta") continue;
    EXPECT_LT(number(row, "energy_change"), 1e-14) << row.text("force") << ' ' << row.text("steps");
  }
  std::size_t orders_of_states = 0;
  for (const Row& row : tables.orders.rows()) {
    const std::string condition = row.text("condition");
    const double order_of_method = 2.0 * number(row, "stages");
    const bool has_full_order = row.text("force") == "none" || condition == "momenta";
    const double expected = has_full_order ? order_of_method : condition == "steps" ? 1.0 : 2.0;
    EXPECT_NEAR(number(row, "slope"), expected, 0.2)
        << row.text("quantity") << ' ' << row.text("force") << ' ' << condition << ' ' << order_of_method;
    if (row.text("quantity") == "state_error") ++orders_of_states;
  }
  EXPECT_EQ(orders_of_states, 12U);  // forces, conditions, stages
}

TEST(OrthogonalForces, KeepTheMomentumOfOptimalMotionsUnlessTheyAreCollocatedInTangentSpace) {
  const Table table = orthogonal_forces_table({});
  ASSERT_FALSE(table.rows().empty());
  for (const Row& row : table.rows()) {
    const std::string label = row.text("problem") + " " + row.text("method") + " " + row.text("intervals");
    EXPECT_GT(number(row, "largest_control"), 1e-2) << label;
    if (row.text("method") == "tangent") {
      EXPECT_GT(number(row, "momentum_deviation"), 1e-10) << label;
    } else {
      EXPECT_LT(number(row, "momentum_deviation"), 10.0 * number(row, "rounding")) << label;
    }
  }
}

TEST(Rotations, AreBalancedAboutEveryAxisWhereTheyActLinearly) {
  const Table table = rotations_table(50);
  ASSERT_EQ(table.rows().size(), 27U);  // systems, methods, axes
  for (const Row& row : table.rows()) {
    const std::string label = row.text("problem") + " " + row.text("method") + " " + row.text("axis");
    EXPECT_GT(std::abs(number(row, "work")), 1e-5) << label;
    const bool is_invariant = row.text("action") == "linear" || row.text("axis") == "3";
    const bool moves_mass_in_tangent_space =
        row.text("method") == "tangent" && row.text("problem") != "elastic_pendulum";
    if (is_invariant && !moves_mass_in_tangent_space) {
      EXPECT_LT(number(row, "defect"), 1e-15) << label;
    } else {
      EXPECT_GT(number(row, "defect"), 1e-8) << label;
    }
  }
}

TEST(ModifiedEnergyTables, DriftWithTheOrderOfTheirTruncationUnlessTangentSpaceHasAMovingMass) {
  const Table slopes = modified_energy_tables().orders;
  ASSERT_FALSE(slopes.rows().empty());
  for (const Row& row : slopes.rows()) {
    const bool is_other_rule = row.text("method") == "tangent" && row.text("problem") != "pendulum";
    const double order = is_other_rule ? 2.0 : number(row, "truncation");
    EXPECT_NEAR(number(row, "slope"), order, 0.1) << row.text("problem") << row.text("method") << row.text("quantity");
  }
}

TEST(LongTimeEnergy, OscillationFallsWithTheOrderAndOnlyMethodsThatAreNotSymplecticLeaveIt) {
  for (const LongTimeMethod& method : long_time_methods()) {
    const EnergyBehaviour coarse = energy_behaviour(long_time_energy(method, 64, 100));
    if (method.name != "dmoc") {
      EXPECT_GT(std::abs(coarse.change), 3.0 * coarse.oscillation) << method.name;
      continue;
    }
    EXPECT_LT(coarse.range, 1.01 * coarse.oscillation) << method.order;
    const EnergyBehaviour fine = energy_behaviour(long_time_energy(method, 128, 100));
    EXPECT_NEAR(std::log2(coarse.oscillation / fine.oscillation), method.order, 0.1);
  }
}

TEST(EnergyBehaviour, TellsDriftFromOscillation) {
  std::vector<PeriodEnergy> periods;
  for (int k = 0; k < 50; ++k) {
    const double mean = 0.25 * k;
    periods.push_back({.period = k, .smallest = mean - 1.0, .mean = mean, .largest = mean + 1.0});
  }
  const EnergyBehaviour behaviour = energy_behaviour(periods);
  EXPECT_NEAR(behaviour.drift_per_period, 0.25, 1e-13);
  EXPECT_NEAR(behaviour.oscillation, 2.0 + 9 * 0.25, 1e-13);
  EXPECT_NEAR(behaviour.range, 2.0 + 49 * 0.25, 1e-13);
  EXPECT_NEAR(behaviour.change, 49 * 0.25, 1e-13);
  EXPECT_LT(behaviour.standard_error, 1e-13);
}

}  // namespace
}  // namespace dmocbench
