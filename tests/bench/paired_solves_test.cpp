#include "bench/tables/paired_solves.hpp"

#include <gtest/gtest.h>

namespace dmocbench {
namespace {

const ColumnNames key{"problem", "intervals"};

Table solves(const std::vector<std::vector<std::string>>& rows) {
  Table table({"problem", "intervals", "status", "major_iterations"});
  for (const auto& fields : rows) {
    Row row;
    for (std::size_t i = 0; i < fields.size(); ++i) row.set(table.columns()[i], fields[i]);
    table.append(std::move(row));
  }
  return table;
}

const Table first = solves({{"a", "64", "solved", "30"},
                            {"a", "128", "step failed", "7"},
                            {"b", "64", "too coarse", "10"},
                            {"b", "128", "solved", "0"},
                            {"c", "64", "acceptable", "9"},
                            {"d", "64", "solved", "4"}});
const Table second = solves({{"c", "64", "time limit", "3"},
                             {"b", "128", "solved", "5"},
                             {"b", "64", "solved", "20"},
                             {"a", "128", "solved", "8"},
                             {"a", "64", "solved", "10"}});

TEST(PairedSolves, JoinsRowsOfTheSameProgramInTheOrderOfTheFirst) {
  const auto pairs = paired_solves(first, second, key);
  ASSERT_EQ(pairs.size(), 5U);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].first.get().csv(key), first.rows()[i].csv(key));
    EXPECT_EQ(pairs[i].second.get().csv(key), first.rows()[i].csv(key));
  }
}

TEST(PairedSolves, CountEveryPairOnceAndListWhatTheSecondAloneSolves) {
  const auto pairs = paired_solves(first, second, key);
  const PairedCount count = count_of(pairs);
  EXPECT_EQ(count.both, 3U);
  EXPECT_EQ(count.first_only, 0U);
  EXPECT_EQ(count.second_only, 1U);
  EXPECT_EQ(count.neither, 1U);
  const auto lost = lost_by_first(pairs);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost.front().first.get().text("status"), "step failed");
  EXPECT_TRUE(lost_by_first(paired_solves(second, first, key)).empty());
}

TEST(PairedSolves, CompareIterationsOnlyWhereBothSolve) {
  const std::vector<double> ratios = iteration_ratios(paired_solves(first, second, key));
  EXPECT_EQ(ratios, (std::vector<double>{0.5, 3.0}));
}

}  // namespace
}  // namespace dmocbench
