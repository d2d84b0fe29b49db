#include <set>
#include <string>

#include <gtest/gtest.h>

#include "bench/tables/ratios.hpp"
#include "tests/bench/curves_for_tests.hpp"

namespace dmocbench {
namespace {

using tests::convergence_of;
using tests::power_law;
using tests::sixteen_to_1024;

TEST(EqualAccuracy, PowerLawsGiveTheRatioOfTheirCosts) {
  // Four times the error at order 2: twice the intervals; and three times the time on the same grid.
  const Table table = equal_accuracy(
      convergence_of({{.error = power_law(1.0, 2.0)},
                      {.name = "tangent", .error = power_law(4.0, 2.0), .seconds = [](double n) { return 3e-3 * n; }}},
                     sixteen_to_1024));
  int of_tangent = 0;
  for (const Row& row : table.rows()) {
    const double factor = row.text("method") == "tangent" ? 2.0 : 1.0;
    const double intervals = factor / std::sqrt(row.needed("error"));
    EXPECT_NEAR(row.needed("intervals") / intervals, 1.0, 1e-12);
    EXPECT_NEAR(row.needed("variables") / (10.0 * intervals), 1.0, 1e-12);
    EXPECT_NEAR(row.needed("variables_ratio"), factor, 1e-12);
    EXPECT_NEAR(row.needed("seconds_ratio"), factor == 2.0 ? 6.0 : 1.0, 1e-12);
    of_tangent += factor == 2.0 ? 1 : 0;
  }
  EXPECT_GE(of_tangent, 2 * 4) << "half decades from 1e-2 to 1e-5, for state and control";
}

TEST(EqualAccuracy, ComparesMethodsBySolverAndDerivatives) {
  const auto method = [](const char* name, const char* solver, const char* derivatives, double factor) {
    return tests::MadeUpMethod{.name = name,
                               .error = power_law(1.0, 2.0),
                               .seconds = [factor](double n) { return factor * n; },
                               .solver = solver,
                               .derivatives = derivatives};
  };
  const Table table = equal_accuracy(convergence_of(
      {method("dmoc", "ipopt", "tape", 1.0), method("tangent", "ipopt", "tape", 2.0),
       method("dmoc", "ipopt", "adolc", 10.0), method("tangent", "ipopt", "adolc", 30.0),
       method("dmoc", "interior_point", "tape", 100.0), method("tangent", "interior_point", "tape", 400.0)},
      sixteen_to_1024));
  std::set<std::string> keys;
  for (const Row& row : table.rows()) {
    const double expected = row.text("method") == "dmoc"             ? 1.0
                            : row.text("derivatives") == "adolc"     ? 3.0
                            : row.text("solver") == "interior_point" ? 4.0
                                                                     : 2.0;
    EXPECT_NEAR(row.needed("seconds_ratio"), expected, 1e-12);
    std::string key;
    for (const char* column : {"method", "solver", "derivatives", "quantity", "error"}) key += row.text(column) + ',';
    EXPECT_TRUE(keys.insert(key).second) << key;
  }
  EXPECT_FALSE(keys.empty());
}

TEST(EqualAccuracy, ErrorsThatAMethodDoesNotReachAreLeftOut) {
  const Table table = equal_accuracy(convergence_of(
      {{.error = power_law(1.0, 2.0)}, {.name = "tangent", .error = power_law(1e3, 2.0)}}, sixteen_to_1024));
  for (const Row& row : table.rows()) {
    EXPECT_GE(row.needed("error"), 1e3 / (1024.0 * 1024.0) * (1.0 - 1e-12));
    EXPECT_LE(row.needed("error"), 1.0 / (16.0 * 16.0) * (1.0 + 1e-12));
  }
  EXPECT_FALSE(table.rows().empty());
}

TEST(EqualAccuracy, WithoutDmocThereAreNoRatios) {
  const Table table =
      equal_accuracy(convergence_of({{.name = "hamiltonian", .error = power_law(1.0, 2.0)}}, sixteen_to_1024));
  ASSERT_FALSE(table.rows().empty());
  for (const Row& row : table.rows()) EXPECT_EQ(row.text("variables_ratio"), "");
}

TEST(EqualAccuracy, OneGridIsNoCurve) {
  EXPECT_TRUE(equal_accuracy(convergence_of({{.error = power_law(1.0, 2.0)}}, {64})).rows().empty());
}

}  // namespace
}  // namespace dmocbench
