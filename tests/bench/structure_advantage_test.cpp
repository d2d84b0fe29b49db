// What the experiment structure_advantage counts, and which rows it compares.

#include <string>

#include <gtest/gtest.h>

#include "bench/experiments/advantage_ratios.hpp"
#include "bench/experiments/operation_count.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/orbital_transfer.hpp"
#include "problems/two_link_manipulator.hpp"

namespace dmocbench {
namespace {

/// Operations per interval of the midpoint rule.
OperationCount operations(const Problem& problem, const std::string& method, Eigen::Index intervals,
                          const std::string& factorisation) {
  Transcription program(problem, *make_element(method), make_tableau("gauss", 1), Grid::uniform(intervals));
  const Solution solution = make_solver("ipopt")->solve(program, sample(program, guessed_motion(problem)));
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  OperationCount count = count_operations(program, solution, factorisation);
  if (count.elimination) *count.elimination /= static_cast<double>(intervals);
  return count;
}

double elimination(const Problem& problem, const std::string& method, Eigen::Index intervals,
                   const std::string& factorisation) {
  return operations(problem, method, intervals, factorisation).elimination.value_or(-1.0);
}

TEST(OperationCount, OfAnEliminationByIntervalsIsTheSameOnEveryGrid) {
  const OrbitalTransfer orbit;
  for (const char* method : {"dmoc", "hamiltonian"}) {
    const double on_coarse_grid = elimination(orbit, method, 16, "intervals");
    EXPECT_GT(on_coarse_grid, 0.0);
    EXPECT_EQ(on_coarse_grid, elimination(orbit, method, 32, "intervals"));
    EXPECT_EQ(on_coarse_grid, elimination(orbit, method, 37, "intervals"));
  }
}

/// Products and divisions of one step backward for n configurations and w controls by DMOC's midpoint rule: the state
/// has X = 2 n entries, and everything is linear in the N entries of (w, X, 1).
int operations_of_formulas(int n, int w) {
  const int X = 2 * n;
  const int N = w + X + 1;
  const int Z = n + w;
  const auto sum_to = [](int last) { return last * (last + 1) / 2; };
  int equalities = 2 * n;  // a reciprocal, and a comparison with the usual pivot
  for (int p = 0; p < n; ++p) equalities += (n - 1 - p) * (Z + X + 1 - p);
  equalities += N * sum_to(n);
  const int next_state = N * n * n;  // momenta, from the increments of the configuration
  const int slopes = N * (w * n + X * X);
  const int pairs = sum_to(N) - 1;  // of the lower triangle, without the constant
  const int condensed = pairs * X + (pairs - sum_to(N) + sum_to(X + 1)) * n;
  const int end_multiplier = N * X * X;
  int free = 0;  // each with a reciprocal, and two comparisons with the diagonal entry
  for (int p = 0; p < w; ++p) free += p * (N - p + X) + 3 + (N - 1 - p) + X + (2 * X + 1) * (w - 1 - p);
  const int value = w * (sum_to(X + 1) - 1 + X * (X + 1) + sum_to(X));
  return equalities + next_state + slopes + condensed + end_multiplier + free + value;
}

TEST(OperationCount, IsThatOfTheFormulas) {
  EXPECT_EQ(elimination(OrbitalTransfer(), "dmoc", 16, "intervals"), operations_of_formulas(2, 1));
  EXPECT_EQ(elimination(TwoLinkManipulator(), "dmoc", 16, "intervals"), operations_of_formulas(2, 2));
}

TEST(OperationCount, OfDmocIsLessThanOfCollocation) {
  const OrbitalTransfer orbit;
  EXPECT_LT(elimination(orbit, "dmoc", 24, "intervals"), elimination(orbit, "hamiltonian", 24, "intervals"));
}

TEST(OperationCount, KnowsTheOtherWays) {
  const OrbitalTransfer orbit;
  const OperationCount banded = operations(orbit, "dmoc", 24, "banded");
  EXPECT_EQ(banded.half_bandwidth, 8);
  EXPECT_GT(banded.elimination.value_or(-1.0), 0.0);
  EXPECT_GT(elimination(orbit, "dmoc", 24, "sparse"), 0.0);
  EXPECT_FALSE(operations(orbit, "dmoc", 24, "").elimination);
}

Row row_of(const std::string& method, const std::string& factorisation, int intervals, double seconds, double error) {
  Row row;
  row.set("problem", "orbital_transfer");
  row.set("method", method);
  row.set("tableau", "gauss");
  row.set("stages", 1LL);
  row.set("solver", "interior_point");
  row.set("factorisation", factorisation);
  row.set("intervals", static_cast<long long>(intervals));
  row.set("status", "solved");
  row.set("branch", "same");
  row.set("objective", 1.0 + error);
  row.set("objective_error", error);
  row.set("seconds", seconds);
  row.set("operations_per_interval", 10.0);
  return row;
}

/// The row of the ratios of a quantity; an empty one if there is none.
Row ratio_of(const Table& table, const std::string& factorisation, int intervals, const std::string& quantity) {
  for (const Row& row : table.rows()) {
    if (row.text("factorisation") == factorisation && row.text("quantity") == quantity &&
        row.text("intervals") == std::to_string(intervals)) {
      return row;
    }
  }
  return {};
}

TEST(AdvantageRatios, StandAtEqualGridsAndAtEqualErrors) {
  Table table({"problem"});
  table.append(row_of("dmoc", "intervals", 16, 1.0, 4e-4));
  table.append(row_of("dmoc", "intervals", 32, 2.0, 1e-4));
  table.append(row_of("hamiltonian", "intervals", 16, 3.0, 4e-4));
  table.append(row_of("hamiltonian", "intervals", 32, 2.5, 1e-4));
  table.append(row_of("tangent", "intervals", 16, 3.0, 1e-4));
  const Table ratios = advantage_ratios(table);
  EXPECT_EQ(ratio_of(ratios, "intervals", 32, "seconds").number("ratio_at_equal_intervals"), 1.25);
  EXPECT_EQ(ratio_of(ratios, "intervals", 32, "operations").number("ratio_at_equal_accuracy"), 1.0);
  int of_tangent = 0;
  for (const Row& row : ratios.rows()) {
    if (row.text("method") != "tangent" || row.text("quantity") != "seconds") continue;
    ++of_tangent;
    EXPECT_EQ(row.number("ratio_at_equal_intervals"), 3.0);
    EXPECT_NEAR(row.number("ratio_at_equal_accuracy").value_or(0.0), 1.5, 1e-12);
  }
  EXPECT_EQ(of_tangent, 1);
}

TEST(AdvantageRatios, LeaveOutWhatIsNotSolvedOrNotTheSameAnswer) {
  Table table({"problem"});
  table.append(row_of("dmoc", "intervals", 16, 1.0, 4e-4));
  table.append(row_of("hamiltonian", "intervals", 16, 3.0, 4e-4));
  Row failed = row_of("hamiltonian", "sparse", 16, 1.0, 4e-4);
  failed.set("status", "iteration limit");
  table.append(failed);
  Row elsewhere = row_of("hamiltonian", "banded", 16, 1.0, 4e-4);
  elsewhere.set("objective", 1.5);
  table.append(elsewhere);
  table.append(row_of("dmoc", "banded", 16, 1.0, 4e-4));
  table.append(row_of("dmoc", "sparse", 16, 1.0, 4e-4));
  const Table ratios = advantage_ratios(table);
  EXPECT_FALSE(ratio_of(ratios, "intervals", 16, "seconds").text("method").empty());
  EXPECT_TRUE(ratio_of(ratios, "sparse", 16, "seconds").text("method").empty());
  EXPECT_TRUE(ratio_of(ratios, "banded", 16, "seconds").text("method").empty());
}

}  // namespace
}  // namespace dmocbench
