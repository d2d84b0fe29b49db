#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bench/all_tables_for_claims.hpp"

namespace dmocbench::tests {

/// A number that turns a claim, in the rows of a table that a predicate chooses.
struct FalseNumber {
  std::string table;
  Where where;
  std::string column;
  double number;
  std::string claim;
};

/// The verdict on the claim where the tables agree with the paper but for that number.
inline ClaimVerdict verdict_with(const FalseNumber& doctored) {
  const ResultTables results = results_of(all_rows(), [&](const std::string& name, Row& row) {
    if (name == doctored.table && doctored.where(row)) row.set(doctored.column, doctored.number);
  });
  return judged_claim(doctored.claim, results).verdict;
}

/// Each claim is reproduced by the tables as they are, and differs with its false number.
inline void expect_to_differ(const std::vector<FalseNumber>& all) {
  for (const FalseNumber& doctored : all) {
    EXPECT_EQ(verdict_with({doctored.table, [](const Row&) { return false; }, doctored.column, 0.0, doctored.claim}),
              ClaimVerdict::reproduced)
        << doctored.claim;
    EXPECT_EQ(verdict_with(doctored), ClaimVerdict::differs) << doctored.claim << ", " << doctored.column;
  }
}

}  // namespace dmocbench::tests
