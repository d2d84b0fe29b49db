#include "methods/solvers/interior_point/filter_line_search.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace dmocbench::interior_point {
namespace {

constexpr double rounding_of_theta = 1e-13;

/// That of a solve that began at the violation θ.
FilterLineSearch search_from(double theta) {
  FilterLineSearch search;
  search.begin(theta, rounding_of_theta, 100);
  return search;
}

PointValues point(double theta, double phi) { return {.objective = phi, .theta = theta, .phi = phi}; }

TEST(FilterLineSearch, LetsTheViolationGrowTenfoldAndNoMoreHoweverLowTheCost) {
  FilterLineSearch search = search_from(1.0);
  EXPECT_TRUE(search.accept(point(0.5, 1.0), point(4.9, -1e6), -1.0, 1.0));
  EXPECT_FALSE(search.accept(point(0.5, 1.0), point(5.1, -1e6), -1.0, 1.0));
}

TEST(FilterLineSearch, LetsTheViolationGrowToThatOfTheStart) {
  FilterLineSearch search = search_from(300.0);
  EXPECT_TRUE(search.accept(point(0.5, 1.0), point(299.0, -1e6), -1.0, 1.0));
  EXPECT_FALSE(search.accept(point(0.5, 1.0), point(301.0, -1e6), -1.0, 1.0));
}

TEST(FilterLineSearch, AcceptsLessOfOneOfBoth) {
  EXPECT_TRUE(search_from(1.0).accept(point(1.0, 1.0), point(0.9, 5.0), -1e-9, 1.0));
  EXPECT_TRUE(search_from(1.0).accept(point(1.0, 1.0), point(1.1, 0.9), -1e-9, 1.0));
  EXPECT_FALSE(search_from(1.0).accept(point(1.0, 1.0), point(1.1, 1.1), -1e-9, 1.0));
}

TEST(FilterLineSearch, DoesNotGoBackToAPointThatItHasLeft) {
  FilterLineSearch search = search_from(1.0);
  ASSERT_TRUE(search.accept(point(1.0, 1.0), point(0.5, 2.0), -1e-9, 1.0));
  EXPECT_FALSE(search.accept(point(0.5, 2.0), point(1.0, 1.0), -1e-9, 1.0));
  search.forget();
  EXPECT_TRUE(search.accept(point(0.5, 2.0), point(1.0, 1.0), -1e-9, 1.0));
}

/// Close to the constraints a step that promises much of φ has to keep a part of its promise, (19) and (20).
TEST(FilterLineSearch, AsksForDecreaseWhereTheConstraintsHold) {
  FilterLineSearch search = search_from(1.0);
  EXPECT_FALSE(search.accept(point(1e-5, 1.0), point(1e-6, 1.0001), -1.0, 1.0));
  EXPECT_TRUE(search.accept(point(1e-5, 1.0), point(2e-5, 0.5), -1.0, 1.0));
}

TEST(FilterLineSearch, CountsDifferencesWithinRoundingAsNone) {
  FilterLineSearch search = search_from(1.0);
  const double theta = 0.1 * rounding_of_theta;
  const double ulp = std::numeric_limits<double>::epsilon();
  EXPECT_TRUE(search.accept(point(theta, 1.0), point(2.0 * theta, 1.0 + ulp), -1e-20, 1.0));
  EXPECT_FALSE(search.accept(point(theta, 1.0), point(2.0 * theta, 1.0 + 1e6 * ulp), -1e-20, 1.0));
}

/// Ten searches in a row whose last refusal is the filter's. Not more than five times in a solve.
TEST(FilterLineSearch, EmptiesAFilterThatShortensSearchAfterSearch) {
  FilterLineSearch search = search_from(1.0);
  double theta = 0.4;
  const PointValues refused = point(0.6, 0.5);
  const auto search_once = [&] {
    const bool is_blocked = !search.accept(point(theta, 1.0), refused, -1e-9, 1.0);
    if (is_blocked) {
      EXPECT_TRUE(search.accept(point(theta, 1.0), point(0.99 * theta, 1.0), -1e-9, 0.5));
    }
    theta *= 0.99;
    return is_blocked;
  };
  for (int emptied = 0; emptied < 5; ++emptied) {
    search.begin_restoration(point(0.5, 0.0));
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(search_once()) << emptied << ' ' << i;
    EXPECT_FALSE(search_once()) << emptied;
  }
  search.begin_restoration(point(0.5, 0.0));
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(search_once()) << i;
}

/// Were it not so, every step could raise the violation tenfold where the cost falls.
TEST(FilterLineSearch, KeepsTheViolationBelowThatOfTheStartOnceItIsEmptied) {
  const auto emptied_at = [](double theta) {
    FilterLineSearch search = search_from(1.0);
    search.begin_restoration(point(0.5 * theta, 0.0));
    for (int i = 0; i < 10; ++i) {
      EXPECT_FALSE(search.accept(point(theta, 1.0), point(theta, 0.5), -1e-9, 1.0));
      EXPECT_TRUE(search.accept(point(theta, 1.0), point(0.4 * theta, 1.0), -1e-9, 0.5));
    }
    return search;
  };
  EXPECT_TRUE(emptied_at(0.8).accept(point(0.8, 1.0), point(0.99, 0.5), -1e-9, 1.0));
  EXPECT_FALSE(emptied_at(0.8).accept(point(0.8, 1.0), point(1.01, -1e6), -1e-9, 1.0));
  EXPECT_TRUE(emptied_at(40.0).accept(point(30.0, 1.0), point(39.0, 0.5), -1e-9, 1.0));
  EXPECT_FALSE(emptied_at(40.0).accept(point(30.0, 1.0), point(41.0, -1e6), -1e-9, 1.0));
  FilterLineSearch search = emptied_at(0.8);
  search.forget();
  EXPECT_TRUE(search.accept(point(0.8, 1.0), point(1.01, -1e6), -1e-9, 1.0)) << "of another barrier problem";
}

TEST(FilterLineSearch, RefusesWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(search_from(1.0).accept(point(1.0, 1.0), point(nan, 0.0), -1.0, 1.0));
  EXPECT_FALSE(search_from(1.0).accept(point(1.0, 1.0), point(0.5, nan), -1.0, 1.0));
}

TEST(FilterLineSearch, HalvesNoLongerWhereAStepPromisesNothing) {
  const FilterLineSearch search = search_from(1.0);
  const double least = search.smallest_length(1.0, 1.0);
  EXPECT_GT(least, 0.0);
  EXPECT_LT(search.smallest_length(1.0, -100.0), least) << "as long as φ may fall enough";
  EXPECT_LT(search.smallest_length(1e-8, -100.0), search.smallest_length(1.0, -100.0)) << "as (19) may still hold";
}

}  // namespace
}  // namespace dmocbench::interior_point
