#include "methods/program/block_pattern.hpp"

#include <gtest/gtest.h>

#include "methods/program/interval_structure.hpp"

namespace dmocbench {
namespace {

/// A diagonal from (3, 0), a row from (0, 5), a column from (1, 4), and one entry.
BlockPattern four_runs() {
  BlockPattern pattern;
  EXPECT_EQ(pattern.append({.row = 3, .row_step = 1, .column_step = 1, .length = 3}), 0U);
  EXPECT_EQ(pattern.append({.column = 5, .column_step = 1, .length = 2}), 3U);
  EXPECT_EQ(pattern.append({.row = 1, .column = 4, .row_step = 1, .length = 2}), 5U);
  EXPECT_EQ(pattern.append(9, 9), 7U);
  return pattern;
}

TEST(BlockPattern, ExpandsRunsInTheirOrder) {
  const SparsityPattern entries = four_runs().expand();
  EXPECT_EQ(entries.rows, (std::vector<int>{3, 4, 5, 0, 0, 1, 2, 9}));
  EXPECT_EQ(entries.columns, (std::vector<int>{0, 1, 2, 5, 6, 4, 4, 9}));
  EXPECT_EQ(four_runs().size(), entries.size());
  EXPECT_EQ(BlockPattern().size(), 0U);
}

TEST(BlockPattern, FindsEveryEntryAndNoOther) {
  const BlockPattern pattern = four_runs();
  std::size_t found = 0;
  for (std::size_t row = 0; row < 12; ++row) {
    for (std::size_t column = 0; column < 12; ++column) {
      const auto entry = pattern.find(row, column);
      if (!entry) continue;
      ++found;
      EXPECT_EQ(pattern.expand().rows[*entry], static_cast<int>(row));
      EXPECT_EQ(pattern.expand().columns[*entry], static_cast<int>(column));
    }
  }
  EXPECT_EQ(found, pattern.size());
}

TEST(Places, AreThoseOfTheirRuns) {
  Places places;
  EXPECT_EQ(places.append(Place::Kind::node, 0, 3), 0U);
  EXPECT_EQ(places.append(Place::Kind::interval, 0, 2), 3U);
  EXPECT_EQ(places.append(Place::Kind::node, 2, 1), 5U);
  EXPECT_EQ(places.append(Place::Kind::border, 0, 2), 6U);
  ASSERT_EQ(places.size(), 8U);
  std::size_t number = 0;
  const std::vector<std::size_t> indices{0, 1, 2, 0, 1, 2, 0, 0};
  const std::vector<std::size_t> runs{0, 0, 0, 1, 1, 2, 3, 3};
  places.for_each([&](const Place& place) {
    EXPECT_EQ(place.index, indices[number]);
    EXPECT_EQ(places[number].index, indices[number]);
    EXPECT_EQ(places[number].kind, place.kind);
    EXPECT_EQ(places.run_of(number), runs[number]);
    ++number;
  });
  EXPECT_EQ(number, places.size());
}

}  // namespace
}  // namespace dmocbench
