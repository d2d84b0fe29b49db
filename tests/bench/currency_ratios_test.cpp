#include <gtest/gtest.h>

#include "bench/tables/ratios.hpp"
#include "tests/bench/declared_tables.hpp"

namespace dmocbench {
namespace {

/// A row of iterations by Ipopt on N intervals, with an error of order 2.
Row solved(const char* method, const char* derivatives, double tolerance, int intervals, int iterations) {
  Row row = tests::scheme_row(method, "pendulum");
  row.set("solver", "ipopt");
  row.set("derivatives", derivatives);
  row.set("tolerance", tolerance);
  row.set("intervals", intervals);
  row.set("status", "solved");
  row.set("branch", "same");
  row.set("crash", "");
  row.set("major_iterations", iterations);
  row.set("replay_error", 1.0 / (intervals * intervals));
  return row;
}

TEST(CurrencyRatios, CompareWithDmocAtTheSameToleranceAndDerivatives) {
  Table iterations({"problem", "method", "tableau", "stages", "solver", "derivatives", "tolerance", "intervals",
                    "status", "branch", "crash", "major_iterations", "replay_error"});
  for (const int intervals : {32, 64}) {
    iterations.append(solved("dmoc", "tape", 1e-6, intervals, 2));
    iterations.append(solved("dmoc", "tape", 1e-10, intervals, 4));
    iterations.append(solved("dmoc", "adolc", 1e-6, intervals, 8));
    iterations.append(solved("tangent", "tape", 1e-6, intervals, 6));
    iterations.append(solved("tangent", "tape", 1e-10, intervals, 20));
    iterations.append(solved("tangent", "adolc", 1e-6, intervals, 56));
  }
  const Table table = currency_ratios(iterations);
  const Selection rows = Selection(table).where("currency", "ipopt_iterations");
  ASSERT_EQ(rows.size(), 6);
  for (const Row& row : rows) {
    const double expected = row.text("derivatives") == "adolc" ? 7.0 : row.needed("tolerance") == 1e-6 ? 3.0 : 5.0;
    EXPECT_NEAR(row.needed("ratio_at_equal_intervals"), expected, 1e-12);
    EXPECT_NEAR(row.needed("ratio_at_equal_accuracy"), expected, 1e-12);
  }
}

}  // namespace
}  // namespace dmocbench
