#include "methods/solvers/interior_point/pattern_runs.hpp"

#include <gtest/gtest.h>

#include "methods/solvers/interior_point/matrix_product.hpp"
#include "methods/transcription/transcription.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench::interior_point {
namespace {

using tests::RandomPoints;

SparsityPattern pattern_of(std::vector<int> rows, std::vector<int> columns) {
  return {std::move(rows), std::move(columns)};
}

/// Rows and columns that the runs stand for, in their order.
SparsityPattern written_out(const std::vector<PatternRun>& runs) {
  SparsityPattern pattern;
  for (const PatternRun& run : runs) {
    EXPECT_EQ(run.entry, static_cast<Eigen::Index>(pattern.size()));
    for (Eigen::Index i = 0; i < run.length; ++i) {
      pattern.rows.push_back(static_cast<int>(run.row + i * run.row_step));
      pattern.columns.push_back(static_cast<int>(run.column + i * run.column_step));
    }
  }
  return pattern;
}

void expect_same_entries(const SparsityPattern& pattern) {
  const SparsityPattern found = written_out(pattern_runs(pattern));
  EXPECT_EQ(found.rows, pattern.rows);
  EXPECT_EQ(found.columns, pattern.columns);
}

/// All positions of a small matrix that chance chooses, column by column or shuffled.
SparsityPattern random_pattern(RandomPoints& random, int rows, int columns, bool shuffled) {
  SparsityPattern pattern;
  for (int j = 0; j < columns; ++j) {
    for (int i = 0; i < rows; ++i) {
      if (random.number() < 0.0) continue;
      pattern.rows.push_back(i);
      pattern.columns.push_back(j);
    }
  }
  for (std::size_t e = pattern.size(); shuffled && e > 1; --e) {
    const auto other = static_cast<std::size_t>(random.number(0.0, 1.0) * static_cast<double>(e));
    std::swap(pattern.rows[e - 1], pattern.rows[other]);
    std::swap(pattern.columns[e - 1], pattern.columns[other]);
  }
  return pattern;
}

void expect_dense_product(const SparsityPattern& pattern, Eigen::Index rows, Eigen::Index columns,
                          RandomPoints& random) {
  const Eigen::VectorXd values = random.vector(static_cast<Eigen::Index>(pattern.size()));
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, columns);
  for (std::size_t e = 0; e < pattern.size(); ++e) {
    matrix(pattern.rows[e], pattern.columns[e]) = values[static_cast<Eigen::Index>(e)];
  }
  const Eigen::VectorXd multipliers = random.vector(rows);
  const Eigen::VectorXd before = random.vector(columns);
  Eigen::VectorXd sum = before;
  MatrixProduct::transposed(pattern_runs(pattern)).add(values, multipliers, sum);
  EXPECT_LT((sum - before - matrix.transpose() * multipliers).lpNorm<Eigen::Infinity>(), 1e-13);
}

TEST(PatternRuns, AreOneForADiagonalARowAndAColumn) {
  EXPECT_EQ(pattern_runs(pattern_of({3, 4, 5, 6}, {0, 1, 2, 3})).size(), 1U);
  EXPECT_EQ(pattern_runs(pattern_of({3, 3, 3}, {0, 1, 2})).size(), 1U);
  EXPECT_EQ(pattern_runs(pattern_of({3, 4, 5}, {7, 7, 7})).size(), 1U);
  EXPECT_EQ(pattern_runs(pattern_of({3}, {7})).size(), 1U);
  EXPECT_TRUE(pattern_runs(pattern_of({}, {})).empty());
}

TEST(PatternRuns, EndWhereTheDirectionChanges) {
  const auto runs = pattern_runs(pattern_of({0, 1, 2, 2, 2}, {0, 1, 2, 3, 4}));
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].length, 3);
  EXPECT_EQ(runs[1].row, 2);
  EXPECT_EQ(runs[1].column, 3);
  EXPECT_EQ(runs[1].row_step, 0);
  EXPECT_EQ(runs[1].length, 2);
}

TEST(PatternRuns, EndBeforeAStepBackOrOfTwo) {
  EXPECT_EQ(pattern_runs(pattern_of({0, 2, 4}, {0, 0, 0})).size(), 3U);
  EXPECT_EQ(pattern_runs(pattern_of({2, 1, 0}, {0, 1, 2})).size(), 3U);
}

TEST(PatternRuns, StandForTheSameEntriesAndTheSameProduct) {
  RandomPoints random;
  for (int i = 0; i < 200; ++i) {
    const int rows = 1 + i % 7;
    const int columns = 1 + i % 9;
    const SparsityPattern pattern = random_pattern(random, rows, columns, i % 2 == 1);
    expect_same_entries(pattern);
    expect_dense_product(pattern, rows, columns, random);
  }
}

TEST(PatternRuns, AreAsManyForALongGridAsForAShortOne) {
  const tests::Everything everything;
  RandomPoints random;
  for (const tests::Scheme& scheme : tests::all_schemes(2)) {
    SCOPED_TRACE(scheme.label());
    const auto runs_of = [&](Eigen::Index intervals) {
      Transcription program(everything.problem(), *make_element(scheme.method), scheme.tableau(),
                            Grid::uniform(intervals));
      expect_same_entries(program.jacobian_structure());
      expect_same_entries(program.hessian_structure());
      expect_dense_product(program.jacobian_structure(), static_cast<Eigen::Index>(program.constraint_count()),
                           static_cast<Eigen::Index>(program.variable_count()), random);
      return std::pair(pattern_runs(program.jacobian_structure()).size(),
                       pattern_runs(program.hessian_structure()).size());
    };
    EXPECT_EQ(runs_of(20), runs_of(40));
  }
}

}  // namespace
}  // namespace dmocbench::interior_point
