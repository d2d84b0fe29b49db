#include "methods/kkt/refusal_checks.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace dmocbench::kkt {
namespace {

/// Which of so many matrices, each of them refused rightly and so many times, are checked.
std::vector<int> checked_of(RefusalChecks& checks, int matrices, int refusals = 2) {
  std::vector<int> checked;
  for (int matrix = 1; matrix <= matrices; ++matrix) {
    bool is_checked = false;
    for (int refusal = 0; refusal < refusals; ++refusal) is_checked = checks.ask();
    if (is_checked) checked.push_back(matrix);
    checks.end_matrix();
  }
  return checked;
}

TEST(RefusalChecks, ComeTwiceAsLateWhereTheLastRefusalsWereRight) {
  RefusalChecks checks;
  EXPECT_EQ(checked_of(checks, 300), (std::vector<int>{33, 33 + 65, 33 + 65 + 129}));
}

TEST(RefusalChecks, DoNotEndWithAMatrixThatWasRefusedOnceOnly) {
  RefusalChecks checks;
  EXPECT_EQ(checked_of(checks, 40, 1), (std::vector<int>{33, 34, 35, 36}));
  checks.forget();
  EXPECT_EQ(checked_of(checks, 33, 1), std::vector<int>{33});
  EXPECT_EQ(checked_of(checks, 40, 2), std::vector<int>{1});
}

TEST(RefusalChecks, AskAboutEveryFourthRefusalOfAMatrix) {
  RefusalChecks checks;
  for (int i = 1; i <= 12; ++i) EXPECT_EQ(checks.ask(), i % 4 == 0) << i;
}

TEST(RefusalChecks, CountAnewWhereTwoMatricesInARowAreNotRefused) {
  RefusalChecks checks;
  for (int turn = 0; turn < 10; ++turn) {
    EXPECT_TRUE(checked_of(checks, 31).empty()) << turn;
    checks.end_matrix();
    checks.end_matrix();
  }
  EXPECT_TRUE(checked_of(checks, 31).empty());
  checks.end_matrix();  // one is not enough
  EXPECT_EQ(checked_of(checks, 2), std::vector<int>{2});
}

TEST(RefusalChecks, AskAboutAllRefusalsUntilThoseOfAMatrixWereRight) {
  RefusalChecks checks;
  EXPECT_TRUE(checked_of(checks, 32).empty());
  for (int matrix = 0; matrix < 5; ++matrix) {
    EXPECT_TRUE(checks.ask());
    EXPECT_TRUE(checks.ask());
    checks.contradict();
    checks.end_matrix();
  }
  EXPECT_EQ(checked_of(checks, 10), std::vector<int>{1});
}

}  // namespace
}  // namespace dmocbench::kkt
