#include "methods/solvers/sqp/quadratic/pricing.hpp"

#include <set>

#include <gtest/gtest.h>

namespace dmocbench::sqp {
namespace {

const std::vector<PricedColumn> candidates{{2, -1.0}, {5, 4.0}, {7, -6.0}, {9, 3.0}};

TEST(Pricing, FollowsItsRule) {
  EXPECT_EQ(Pricing(PricingRule::largest).choose(candidates).column, 7);
  EXPECT_EQ(Pricing(PricingRule::lowest).choose(candidates).column, 2);
  EXPECT_EQ(Pricing(PricingRule::last).choose(candidates).column, 9);
}

TEST(Pricing, AtRandomRepeatsWithItsSeedAndReachesAll) {
  Pricing first(PricingRule::random, 5);
  Pricing second(PricingRule::random, 5);
  std::set<Eigen::Index> reached;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Index column = first.choose(candidates).column;
    EXPECT_EQ(column, second.choose(candidates).column);
    reached.insert(column);
  }
  EXPECT_EQ(reached.size(), candidates.size());
}

}  // namespace
}  // namespace dmocbench::sqp
