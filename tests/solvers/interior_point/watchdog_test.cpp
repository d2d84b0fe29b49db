#include "methods/solvers/interior_point/watchdog.hpp"

#include <gtest/gtest.h>

#include "methods/solvers/interior_point/constants.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench::interior_point {
namespace {

/// An iterate, its values and a step.
struct Place {
  Iterate at;
  Evaluation values;
  Iterate step;
};

Iterate random_iterate(tests::RandomPoints& random) {
  Iterate result;
  result.x = random.vector(5);
  result.s = random.vector(2);
  result.multipliers = random.vector(3);
  for (Eigen::VectorXd& z : result.z) z = random.vector(4);
  return result;
}

Place random_place(tests::RandomPoints& random) {
  Place place{.at = random_iterate(random), .values = {}, .step = random_iterate(random)};
  const Eigen::VectorXd numbers = random.vector(3);
  place.values.objective = numbers[0];
  place.values.theta = numbers[1];
  place.values.phi = numbers[2];
  place.values.constraints = random.vector(3);
  return place;
}

void expect_equal(const Iterate& found, const Iterate& wanted) {
  EXPECT_EQ(found.x, wanted.x);
  EXPECT_EQ(found.s, wanted.s);
  EXPECT_EQ(found.multipliers, wanted.multipliers);
  EXPECT_EQ(found.z, wanted.z);
}

TEST(Watchdog, IsDueAfterAsManyShortenedSearchesInARow) {
  Watchdog watchdog;
  for (int i = 1; i < constants::watchdog_trigger; ++i) watchdog.count(true);
  EXPECT_FALSE(watchdog.is_due());
  watchdog.count(false);
  for (int i = 1; i < constants::watchdog_trigger; ++i) watchdog.count(true);
  EXPECT_FALSE(watchdog.is_due());
  watchdog.count(true);
  EXPECT_TRUE(watchdog.is_due());
  watchdog.forget();
  EXPECT_FALSE(watchdog.is_due());
}

/// Twice: what was swapped away the first time is not what is restored the second time.
TEST(Watchdog, GoesBackExactlyToWhereItBegan) {
  tests::RandomPoints random;
  Watchdog watchdog;
  for (int round = 0; round < 2; ++round) {
    const Place start = random_place(random);
    watchdog.begin(start.at, start.values, start.step, -2.0, 0.5);
    EXPECT_TRUE(watchdog.is_on());
    EXPECT_FALSE(watchdog.is_due());
    for (int i = 0; i < constants::most_watched_steps; ++i) EXPECT_TRUE(watchdog.allows_another());
    EXPECT_FALSE(watchdog.allows_another());
    Place now = random_place(random);
    watchdog.go_back(now.at, now.values, now.step);
    EXPECT_FALSE(watchdog.is_on());
    expect_equal(now.at, start.at);
    expect_equal(now.step, start.step);
    EXPECT_EQ(now.values.objective, start.values.objective);
    EXPECT_EQ(now.values.theta, start.values.theta);
    EXPECT_EQ(now.values.phi, start.values.phi);
    EXPECT_EQ(now.values.constraints, start.values.constraints);
    EXPECT_EQ(watchdog.start().derivative, -2.0);
    EXPECT_EQ(watchdog.start().longest, 0.5);
  }
}

}  // namespace
}  // namespace dmocbench::interior_point
