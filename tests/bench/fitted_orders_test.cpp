#include "bench/tables/fitted_orders.hpp"

#include <gtest/gtest.h>

#include "methods/transcription/elements/families.hpp"
#include "tests/bench/curves_for_tests.hpp"
#include "tests/bench/declared_tables.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using tests::convergence_of;
using tests::power_law;
using tests::sixteen_to_1024;

/// The slope of one quantity; the test fails if there is not exactly one.
Row slope_of(const FittedOrders& slopes, const std::string& quantity, const std::string& method = "dmoc") {
  std::vector<Row> found;
  for (const Row& row : slopes.table.rows()) {
    if (row.text("quantity") == quantity && row.text("method") == method) found.push_back(row);
  }
  EXPECT_EQ(found.size(), 1U) << quantity;
  return found.empty() ? Row() : found.front();
}

/// The table with one field of the row on N intervals replaced.
Table with_field(const Table& table, long long intervals, const std::string& column, const Cell& value) {
  Table result(table.columns());
  for (Row row : table.rows()) {
    if (row.number("intervals") == static_cast<double>(intervals)) row.set(column, value);
    result.append(row);
  }
  return result;
}

/// c (h^p - r^p) on N intervals, as errors against a grid of step r fall.
std::function<double(double)> against_step(double c, double p, double r) {
  return [=](double n) { return c * (std::pow(n, -p) - std::pow(r, p)); };
}

TEST(FittedOrders, APowerLawGivesItsExponentWithoutAnError) {
  for (const double order : {1.0, 2.0, 3.5}) {
    const Table table = convergence_of({{.error = power_law(7.0, order)}}, sixteen_to_1024);
    const Row row = slope_of(fit_orders(table, std::nullopt, exact_reference), "state");
    EXPECT_NEAR(row.number("slope").value_or(0.0), order, 1e-12);
    EXPECT_NEAR(row.number("standard_error").value_or(1.0), 0.0, 1e-12);
    EXPECT_EQ(row.text("coarsest"), "16");
    EXPECT_EQ(row.text("finest"), "1024");
    EXPECT_EQ(row.text("points"), "7");
    EXPECT_EQ(row.text("fine_end"), "grids");
  }
}

TEST(FittedOrders, AgainstAFinerGridAreThoseOfTheDifference) {
  for (const double order : {1.0, 2.0, 4.0}) {
    const Table table = convergence_of({{.error = against_step(7.0, order, 1.0 / 1024)}}, sixteen_to_1024);
    for (const long long reference : {0LL, 1024LL}) {
      const Row row = slope_of(fit_orders(table, std::nullopt, reference), "control");
      EXPECT_NEAR(row.number("slope").value_or(0.0), order, 1e-6);
      EXPECT_EQ(row.text("finest"), "512");
    }
    // Of a reference that is finer than the one named the order is too low.
    EXPECT_LT(slope_of(fit_orders(table, FitRange{16, 256}, 512), "control").needed("slope"), order - 0.01);
  }
}

TEST(FittedOrders, AreAgainstTheFinestGridThatIsSolvedAndSayWhyNotTheFinest) {
  const Table all = convergence_of({{.error = against_step(7.0, 2.0, 1.0 / 512)}}, sixteen_to_1024);
  const Table failed = with_field(all, 1024, "status", "time limit");
  const FittedOrders fits = fit_orders(failed, std::nullopt, 0);
  EXPECT_NEAR(slope_of(fits, "state").needed("slope"), 2.0, 1e-6);
  ASSERT_EQ(fits.notes.size(), 1U);
  for (const char* word : {"N = 1024", "time limit", "N = 512"}) {
    EXPECT_PRED2(tests::says, fits.notes.front(), word);
  }
  const FittedOrders named = fit_orders(failed, std::nullopt, 1024);
  ASSERT_FALSE(named.notes.empty());
  EXPECT_PRED2(tests::says, named.notes.front(), "choose a --reference");
  EXPECT_TRUE(fit_orders(all, std::nullopt, 0).notes.empty());
}

TEST(FittedOrders, UseStatesButNoControlsOfAnswersWhoseControlIsNotDetermined) {
  const Table all = convergence_of({{.error = power_law(1.0, 2.0)}}, sixteen_to_1024);
  const FittedOrders fits =
      fit_orders(with_field(all, 128, "status", "solved, control not determined"), std::nullopt, exact_reference);
  EXPECT_EQ(slope_of(fits, "state").text("points"), "7");
  EXPECT_EQ(slope_of(fits, "control").text("points"), "6");
}

TEST(FittedOrders, NameTheBoundsThatAreActiveOnTheFinestGrid) {
  const Table all = convergence_of({{.error = power_law(1.0, 2.0)}}, sixteen_to_1024);
  const auto active_of = [](const Table& table) {
    return slope_of(fit_orders(table, std::nullopt, exact_reference), "state").text("active");
  };
  EXPECT_EQ(active_of(all), "");
  EXPECT_EQ(active_of(with_field(all, 1024, "active", "control")), "control");
}

TEST(FittedOrders, BeginWhereNeighbouringGridsAgree) {
  const auto bent = [](double n) { return std::pow(n, -2.0) * (1.0 + std::pow(100.0 / n, 4.0)); };
  const Table table = convergence_of({{.error = bent}}, {16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512});
  const Row row = slope_of(fit_orders(table, std::nullopt, exact_reference), "state");
  EXPECT_EQ(row.text("coarse_end"), "orders");
  EXPECT_GT(row.needed("coarsest"), 96.0);
  EXPECT_NEAR(row.needed("slope"), 2.0, 0.1);
}

TEST(FittedOrders, OfACurveWithoutFourGridsAreNoneAndGetANote) {
  const FittedOrders none =
      fit_orders(convergence_of({{.error = power_law(1.0, 2.0)}}, {16, 32, 64}), std::nullopt, exact_reference);
  EXPECT_EQ(slope_of(none, "state").text("verdict"), "few grids");
  EXPECT_EQ(slope_of(none, "state").text("slope"), "");
  ASSERT_EQ(none.notes.size(), 1U);
  EXPECT_PRED2(tests::says, none.notes[0], "no order is fitted (few grids: 3 grids");
}

TEST(FittedOrders, OfErrorsThatStopFallingFarAboveRoundOffAreNoneAndTheNoteNamesTheLevel) {
  const auto stuck = [](double n) { return 0.012 + 1e-4 * std::fmod(n, 3.0); };
  const FittedOrders none =
      fit_orders(convergence_of({{.error = stuck}}, sixteen_to_1024), std::nullopt, exact_reference);
  EXPECT_EQ(slope_of(none, "state").text("verdict"), "floor");
  ASSERT_EQ(none.notes.size(), 1U);
  EXPECT_PRED2(tests::says, none.notes[0], "the state error stops falling at 1.2e-02, and 0 grids are");
}

TEST(FittedOrders, OfStatesAtRestAreNoReasonForTheNote) {
  const Table table = convergence_of({{.error = power_law(1.0, 2.0)}}, {16, 32, 64});
  Table of_controls(table.columns());
  Table of_nothing(table.columns());
  for (Row row : table.rows()) {
    row.set("state_error", 0.0);
    of_controls.append(row);
    row.set("control_error", 0.0);
    of_nothing.append(row);
  }
  for (const auto& [errors, reason] :
       {std::pair(of_controls, "(few grids: 3 grids"), std::pair(of_nothing, "(floor: the errors are 0")}) {
    const FittedOrders none = fit_orders(errors, std::nullopt, exact_reference);
    ASSERT_EQ(none.notes.size(), 1U);
    EXPECT_PRED2(tests::says, none.notes[0], reason);
  }
}

TEST(FittedOrders, OfGridsThatDisagreeAreNone) {
  const auto jumping = [](double n) { return std::pow(n, -2.0) * (std::fmod(std::log2(n), 2.0) < 0.5 ? 1.0 : 1.4); };
  const FittedOrders none =
      fit_orders(convergence_of({{.error = jumping}}, sixteen_to_1024), std::nullopt, exact_reference);
  EXPECT_EQ(slope_of(none, "state").text("verdict"), "unsteady");
  EXPECT_EQ(slope_of(none, "state").text("slope"), "");
  EXPECT_EQ(none.notes.size(), 1U);
}

/// Grids off the powers of two: enough of them above a floor.
const std::vector<long long> dense_grids{16, 32, 40, 48, 56, 64, 96, 128, 192, 256, 512, 768, 1024};

/// Order 6 down to 1e-12, where errors stay.
double with_floor(double n) { return 1e3 * std::pow(n, -6.0) + 1e-12; }

TEST(FittedOrders, EndAHundredTimesAboveTheMeasuredFloorAgainstAnExactReference) {
  const FittedOrders slopes =
      fit_orders(convergence_of({{.error = with_floor}}, dense_grids), std::nullopt, exact_reference);
  const Row row = slope_of(slopes, "state");
  EXPECT_EQ(row.text("verdict"), "slope");
  EXPECT_EQ(row.text("coarsest"), "16");
  EXPECT_EQ(row.text("finest"), "128");  // 2.3e-10; 192 has 2.1e-11
  EXPECT_EQ(row.text("fine_end"), "floor");
  EXPECT_EQ(row.text("points"), "8");
  EXPECT_NEAR(row.number("floor").value_or(0.0), 1e-12, 5e-14);
  EXPECT_NEAR(row.number("slope").value_or(0.0), 6.0, 0.01);
  const Table same = convergence_of({{.error = with_floor}}, dense_grids);
  EXPECT_EQ(slope_of(fit_orders(same, FitRange{32, 256}, exact_reference), "state").text("finest"), "192");
}

TEST(FittedOrders, ThroughFewerThanFourGridsAboveTheFloorAreNone) {
  const std::vector<long long> powers_of_two{32, 64, 128, 256, 512, 1024};
  const Row row = slope_of(
      fit_orders(convergence_of({{.error = with_floor}}, powers_of_two), std::nullopt, exact_reference), "state");
  EXPECT_EQ(row.text("verdict"), "floor");
  EXPECT_EQ(row.text("slope"), "");
  EXPECT_EQ(row.text("points"), "3");
}

TEST(FittedOrders, AFloorMeasuredOnOneCurveHoldsForAllOfItsMethod) {
  const auto slow = [](double n) { return 1e-6 * std::pow(n, -2.0); };  // 1e-10 only below N = 100
  const Table table = convergence_of({{.error = slow}, {.stages = "3", .error = with_floor}}, dense_grids);
  const FittedOrders slopes = fit_orders(table, std::nullopt, exact_reference);
  for (const Row& row : slopes.table.rows()) {
    if (row.text("quantity") == "state" && row.text("stages") == "1") {
      EXPECT_EQ(row.text("finest"), "96");
    }
  }
}

TEST(FittedOrders, OfDifferencesEndAboveThoseOfHamiltonianCollocation) {
  Table table({"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals", "step", "status",
               "branch", "configuration_difference"});
  for (const std::string& method : paper_families()) {
    for (const long long n : dense_grids) {
      Row row = tests::scheme_row(method, "pendulum");
      row.set("intervals", n);
      row.set("step", 1.0 / static_cast<double>(n));
      row.set("status", "solved");
      row.set("branch", "same");
      const bool tangent = method == std::string("tangent");
      const double h = 1.0 / static_cast<double>(n);
      if (method != std::string("dmoc")) row.set("configuration_difference", tangent ? h * h : 1e-7);
      table.append(row);
    }
  }
  const Table slopes = fit_differences(table, "configuration_difference");
  ASSERT_EQ(slopes.rows().size(), 1U);
  const Row& row = slopes.rows().front();
  EXPECT_EQ(row.text("method"), "tangent");
  EXPECT_EQ(row.text("verdict"), "slope");
  EXPECT_NEAR(row.number("slope").value_or(0.0), 2.0, 1e-9);
  EXPECT_EQ(row.text("finest"), "256");  // 1.5e-5; the floor is 1e-7
}

TEST(FittedOrders, UnsolvedRowsAndOtherBranchesAreLeftOut) {
  const Table good = convergence_of({{.error = power_law(1.0, 2.0)}}, sixteen_to_1024);
  const Table wrong = with_field(good, 64, "state_error", Cell(1.0));
  const FitRange all{16, 1024};
  EXPECT_GT(std::abs(slope_of(fit_orders(wrong, all, exact_reference), "state").needed("slope") - 2.0), 0.05);
  EXPECT_EQ(slope_of(fit_orders(wrong, std::nullopt, exact_reference), "state").text("coarsest"), "128");
  for (const auto& [column, value] : {std::pair{"status", "iteration limit"}, std::pair{"branch", "other"}}) {
    const Table marked = with_field(wrong, 64, column, Cell(std::string(value)));
    const Row row = slope_of(fit_orders(marked, std::nullopt, exact_reference), "state");
    EXPECT_NEAR(row.number("slope").value_or(0.0), 2.0, 1e-12) << column;
    EXPECT_EQ(row.text("points"), "6");
  }
}

TEST(FittedOrders, InARangeOfTheUsersLeaveOutRounding) {
  const auto floor = [](double n) { return std::max(1e3 * std::pow(n, -6.0), 1e-13); };
  const Table table = convergence_of({{.error = floor}}, sixteen_to_1024);
  const Row row = slope_of(fit_orders(table, FitRange{16, 256}, exact_reference), "state");
  EXPECT_NEAR(row.number("slope").value_or(0.0), 6.0, 1e-9);
  EXPECT_EQ(row.text("fine_end"), "range");
}

TEST(FittedOrders, TwoGridsMakeNone) {
  const Table table = convergence_of({{.error = power_law(1.0, 2.0)}}, sixteen_to_1024);
  EXPECT_EQ(slope_of(fit_orders(table, FitRange{32, 64}, exact_reference), "state").text("slope"), "");
  EXPECT_NE(slope_of(fit_orders(table, FitRange{32, 128}, exact_reference), "state").text("slope"), "");
}

TEST(FittedOrders, EveryCurveHasItsOwn) {
  const Table table = convergence_of(
      {{.error = power_law(1.0, 2.0)}, {.name = "tangent", .error = power_law(3.0, 1.0)}}, sixteen_to_1024);
  const FittedOrders slopes = fit_orders(table, std::nullopt, exact_reference);
  EXPECT_NEAR(slope_of(slopes, "state", "dmoc").number("slope").value_or(0.0), 2.0, 1e-12);
  EXPECT_NEAR(slope_of(slopes, "state", "tangent").number("slope").value_or(0.0), 1.0, 1e-12);
}

/// A curve with errors e and jumps j.
Table with_jumps(const std::function<double(double)>& e, const std::function<double(double)>& j) {
  const Table errors = convergence_of({{.error = e}}, dense_grids);
  std::vector<std::string> columns = errors.columns();
  columns.emplace_back("largest_jump");
  Table table(columns);
  for (Row row : errors.rows()) {
    row.set("largest_jump", j(row.needed("intervals")));
    table.append(row);
  }
  return table;
}

TEST(FittedJumps, OneOrderApartExplainTheSameShareOfTheErrorOnEveryGrid) {
  const Table table = with_jumps(power_law(3.0, 2.0), power_law(2.0, 3.0));
  const Table jumps = fit_jumps(table);
  ASSERT_EQ(jumps.rows().size(), 1U);
  const Row& row = jumps.rows()[0];
  EXPECT_NEAR(row.number("jump_slope").value_or(0.0), 3.0, 1e-12);
  EXPECT_NEAR(row.number("error_slope").value_or(0.0), 2.0, 1e-12);
  EXPECT_NEAR(row.number("orders_apart").value_or(0.0), 1.0, 1e-12);
  EXPECT_NEAR(row.number("error_of_jumps_coarsest").value_or(0.0), 1.5, 1e-12);
  EXPECT_NEAR(row.number("error_of_jumps_finest").value_or(0.0), 1.5, 1e-12);
}

TEST(FittedJumps, UseGridsAloneWhereBothAreAboveTheirFloors) {
  const Table table = with_jumps(power_law(3.0, 2.0), with_floor);
  const Table jumps = fit_jumps(table);
  ASSERT_EQ(jumps.rows().size(), 1U);
  EXPECT_NEAR(jumps.rows()[0].number("jump_slope").value_or(0.0), 6.0, 0.05);
  EXPECT_EQ(jumps.rows()[0].text("verdict"), "slope");
  EXPECT_LT(jumps.rows()[0].number("finest").value_or(0.0), 512.0);
}

}  // namespace
}  // namespace dmocbench
