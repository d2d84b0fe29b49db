#include <map>

#include <gtest/gtest.h>

#include "methods/transcription/derivatives/series_assembly.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

/// Outputs (x, 10 x, 100 x) of one input.
Schedule multiples() {
  const Expression x = Expression::input(0);
  return Schedule(std::vector<Expression>{1.0 * x, 10.0 * x, 100.0 * x});
}

Eigen::VectorXd evaluated(const std::vector<std::size_t>& firsts, std::size_t size, const Eigen::VectorXd& x) {
  AssembledTape tape(multiples(), {{firsts.begin(), firsts.end()}, size, static_cast<std::size_t>(x.size())});
  const std::vector<Tape::Input> inputs{{x.data(), false}};
  // Whatever stood there before must not matter.
  Eigen::VectorXd result = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(size), 1e300);
  tape.evaluate(inputs, result);
  return result;
}

TEST(AssembledTape, AddsWhereTheRightEndOfAnIntervalMeetsTheLeftEndOfTheNext) {
  const Eigen::VectorXd x = Eigen::Vector3d(1.0, 2.0, 3.0);
  Eigen::VectorXd expected(8);
  expected << 0.0, 1.0, 2.0 + 10.0, 3.0 + 20.0, 30.0, 100.0, 200.0, 300.0;
  EXPECT_EQ(evaluated({1, 2, 5}, 8, x), expected);
  // The same in another order of outputs.
  Eigen::VectorXd swapped(8);
  swapped << 0.0, 10.0, 20.0 + 1.0, 30.0 + 2.0, 3.0, 100.0, 200.0, 300.0;
  EXPECT_EQ(evaluated({2, 1, 5}, 8, x), swapped);
}

TEST(AssembledTape, AddsAnyOverlapForEveryNumberOfIntervals) {
  tests::RandomPoints random;
  for (Eigen::Index intervals = 1; intervals <= 70; ++intervals) {
    const Eigen::VectorXd x = random.vector(intervals);
    const auto count = static_cast<std::size_t>(intervals);
    for (const std::vector<std::size_t>& firsts :
         {std::vector<std::size_t>{0, 1, 2}, {3, 0, 3}, {0, count, 2 * count}}) {
      const std::size_t size = 3 * count + 4;
      Eigen::VectorXd expected = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(size));
      const std::array<double, 3> factors{1.0, 10.0, 100.0};
      for (std::size_t output = 0; output < 3; ++output) {
        expected.segment(static_cast<Eigen::Index>(firsts[output]), intervals) += factors[output] * x;
      }
      ASSERT_LT((evaluated(firsts, size, x) - expected).lpNorm<Eigen::Infinity>(), 1e-13) << "N = " << intervals;
    }
  }
}

TEST(AssembledTape, SumsTheColumnsOfASharedPlace) {
  const Eigen::VectorXd x = Eigen::Vector3d(1.0, 2.0, 3.0);
  AssembledTape tape(multiples(), {{0, {4, true}, {4, true}}, 6, 3});
  const std::vector<Tape::Input> inputs{{x.data(), false}};
  Eigen::VectorXd result = Eigen::VectorXd::Constant(6, 1e300);
  tape.evaluate(inputs, result);
  Eigen::VectorXd expected(6);
  expected << 1.0, 2.0, 3.0, 0.0, 660.0, 0.0;
  EXPECT_EQ(result, expected);
}

TEST(AssembledTape, AsAPartAddsToWhatIsThere) {
  const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 2.0);
  AssembledTape tape(multiples(), {{3, 1, 1}, 4, 1, AssemblyMode::part});
  const std::vector<Tape::Input> inputs{{x.data(), false}};
  Eigen::VectorXd result = Eigen::Vector4d(1.0, 1.0, 1.0, 1.0);
  tape.evaluate(inputs, result);
  EXPECT_EQ(result, Eigen::Vector4d(1.0, 221.0, 1.0, 3.0));
}

TEST(AssembledTape, RefusesOutputsThatLeaveTheArray) {
  const Eigen::VectorXd x = Eigen::Vector3d::Ones();
  EXPECT_NO_THROW(static_cast<void>(evaluated({0, 1, 5}, 8, x)));
  EXPECT_THROW(static_cast<void>(evaluated({0, 1, 6}, 8, x)), Error);
  EXPECT_THROW(static_cast<void>(evaluated({0, 1}, 8, x)), Error);
}

TEST(AssemblePattern, PutsEveryLocalEntryWhereItBelongsAndNothingTwice) {
  // Local entries between two node columns (0, 1 and N+1, N+2) and an interval column, as elements make them.
  for (const std::size_t intervals : {1UL, 2UL, 3UL, 64UL, 65UL}) {
    const std::size_t nodes = intervals + 1;
    const std::vector<std::size_t> heads{0, 1, nodes, nodes + 1, 2 * nodes, 2 * nodes + intervals};
    std::vector<SeriesPlace> rows;
    std::vector<SeriesPlace> columns;
    for (const std::size_t row : heads) {
      for (const std::size_t column : heads) {
        rows.emplace_back(row);
        columns.emplace_back(column);
      }
    }
    const AssembledPattern assembled = assemble_pattern({rows, columns, intervals});
    std::map<std::pair<int, int>, std::size_t> place;
    assembled.pattern.for_each([&](Eigen::Index e, int row, int column) {
      EXPECT_TRUE(place.emplace(std::pair(row, column), static_cast<std::size_t>(e)).second) << "N = " << intervals;
    });
    ASSERT_EQ(assembled.places.size(), rows.size());
    std::size_t reached = 0;
    std::map<std::size_t, bool> seen;
    for (std::size_t e = 0; e < rows.size(); ++e) {
      for (std::size_t k = 0; k < intervals; ++k) {
        const auto found = place.find({static_cast<int>(rows[e].at(k)), static_cast<int>(columns[e].at(k))});
        ASSERT_NE(found, place.end());
        EXPECT_EQ(found->second, assembled.places[e].at(k)) << "N = " << intervals;
        if (!seen[found->second]) ++reached;
        seen[found->second] = true;
      }
    }
    EXPECT_EQ(reached, assembled.pattern.size()) << "entries that no local one reaches";
  }
}

TEST(AssemblePattern, KeepsRowsAndColumnsOfAQuantityOfTheWholeHorizon) {
  // Rows of intervals and of nodes against one shared unknown, and that unknown against itself.
  constexpr std::size_t intervals = 5;
  const SeriesPlace horizon(20, true);
  const AssembledPattern assembled =
      assemble_pattern({{0, 1, 10, horizon}, {horizon, horizon, horizon, horizon}, intervals});
  EXPECT_EQ(assembled.pattern.size(), (intervals + 1) + intervals + 1);
  const SparsityPattern pattern = assembled.pattern.expand();
  for (std::size_t k = 0; k < intervals; ++k) {
    const std::size_t left = assembled.places[0].at(k);
    const std::size_t right = assembled.places[1].at(k);
    EXPECT_EQ(pattern.rows[left], static_cast<int>(k));
    EXPECT_EQ(pattern.rows[right], static_cast<int>(k + 1));
    EXPECT_EQ(pattern.columns[right], 20);
    EXPECT_EQ(pattern.rows[assembled.places[2].at(k)], static_cast<int>(10 + k));
  }
  EXPECT_TRUE(assembled.places[3].is_global);
  EXPECT_EQ(pattern.rows[assembled.places[3].first], 20);
}

TEST(ExtendPattern, FindsWhatIsThereAndAppendsTheRest) {
  BlockPattern pattern;
  pattern.append({.row_step = 1, .column_step = 1, .length = 3});
  const std::vector<SeriesPlace> places = extend_pattern(pattern, {{1, 7, 2, 7}, {1, 0, 2, 0}, 1});
  EXPECT_EQ(places, (std::vector<SeriesPlace>{1, 3, 2, 3}));
  const SparsityPattern entries = pattern.expand();
  EXPECT_EQ(entries.rows, (std::vector<int>{0, 1, 2, 7}));
  EXPECT_EQ(entries.columns, (std::vector<int>{0, 1, 2, 0}));
}

}  // namespace
}  // namespace dmocbench
