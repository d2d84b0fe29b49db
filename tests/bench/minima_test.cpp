#include "bench/tables/minima.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "bench/run/start_provider.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"
#include "tests/bench/declared_tables.hpp"
#include "tests/support/restated_problems.hpp"

namespace dmocbench {
namespace {

Row answer(const char* method, double objective, double relative_jump, double replay_error,
           const char* status = "solved") {
  Row row = tests::scheme_row(method, "p");
  row.set("intervals", 48LL);
  row.set("status", status);
  row.set("objective", objective);
  row.set("relative_jump", relative_jump);
  row.set("replay_error", replay_error);
  return row;
}

Table answers() {
  Table table({"problem"});
  table.append(answer("dmoc", 80.0, 0.01, 5.0));  // unstable: the whole replay cannot judge it
  table.append(answer("dmoc", 90.0, 0.01, 0.01));
  table.append(answer("dmoc", 60.0, 0.01, 0.01, "iteration limit"));
  table.append(answer("tangent", 80.3, 0.01, 5.0));
  table.append(answer("tangent", 70.0, 0.5, 0.01));
  table.append(answer("tangent", 80.1, 0.02, 5.0));
  return table;
}

TEST(DistinctMinima, AreTheClustersOfTheObjectivesAndTheBestIsTheLowestThatIsAMotion) {
  const Table minima = distinct_minima(answers(), 0.01);
  ASSERT_EQ(minima.rows().size(), 3U);
  const auto expect = [&](std::size_t i, double objective, const char* best, const char* motion, const char* confirmed,
                          double dmoc, double tangent) {
    const Row& row = minima.rows()[i];
    EXPECT_EQ(row.number("objective"), objective);
    EXPECT_EQ(row.text("is_best"), best);
    EXPECT_EQ(row.text("is_motion"), motion);
    EXPECT_EQ(row.text("replay_confirmed"), confirmed);
    EXPECT_EQ(row.number("dmoc"), dmoc);
    EXPECT_EQ(row.number("tangent"), tangent);
  };
  expect(0, 70.0, "no", "no", "yes", 0.0, 1.0);
  expect(1, 80.0, "yes", "yes", "no", 1.0, 2.0);
  expect(2, 90.0, "no", "yes", "yes", 1.0, 0.0);
}

TEST(DistinctMinima, OfSeveralMethodsAreNoneWhereTheirGridErrorsExplainTheDifference) {
  const auto minima_with = [](double interval_cost) {
    Table table({"problem"});
    table.append(answer("dmoc", 80.0, 0.01, 0.01));
    Row tangent = answer("tangent", 78.0, 0.01, 0.01);
    tangent.set("interval_cost", interval_cost);
    table.append(std::move(tangent));
    return distinct_minima(table, 0.01);
  };
  EXPECT_EQ(minima_with(78.1).rows().size(), 2U);
  const Table same = minima_with(79.9);
  ASSERT_EQ(same.rows().size(), 1U);
  EXPECT_EQ(same.rows()[0].text("is_best"), "yes");
}

TEST(DistinctMinima, HaveOnEveryGridTheBestOfTheFinest) {
  Table table({"problem"});
  const auto on_grid = [](Row row, long long intervals) {
    row.set("intervals", intervals);
    return row;
  };
  table.append(on_grid(answer("dmoc", 70.0, 0.01, 0.01), 12));  // an answer that only the coarse grid has
  table.append(on_grid(answer("dmoc", 80.3, 0.01, 0.01), 12));
  table.append(on_grid(answer("dmoc", 80.0, 0.01, 0.01), 48));
  table.append(on_grid(answer("dmoc", 90.0, 0.01, 0.01), 48));
  const Table minima = distinct_minima(table, 0.01);
  ASSERT_EQ(minima.rows().size(), 4U);
  for (const Row& row : minima.rows())
    EXPECT_EQ(row.text("is_best") == "yes", std::abs(row.needed("objective") - 80.0) < 1.0);
  const Table shares = best_minimum_shares(table, 0.01);
  ASSERT_EQ(shares.rows().size(), 2U);
  for (const Row& row : shares.rows()) EXPECT_EQ(row.number("best"), 1.0);
}

TEST(BestMinimumShares, CountEveryStartOfAMethodSolvedOrNot) {
  const Table shares = best_minimum_shares(answers(), 0.01);
  ASSERT_EQ(shares.rows().size(), 2U);
  EXPECT_EQ(shares.rows()[0].number("starts"), 3.0);
  EXPECT_EQ(shares.rows()[0].number("solved"), 2.0);
  EXPECT_EQ(shares.rows()[0].number("best"), 1.0);
  EXPECT_EQ(shares.rows()[1].number("best"), 2.0);
  EXPECT_EQ(shares.rows()[0].number("unsolved"), 1.0);
  EXPECT_EQ(shares.rows()[0].number("unconfirmed"), 0.0);
  EXPECT_EQ(shares.rows()[1].number("unsolved"), 0.0);
  EXPECT_EQ(shares.rows()[1].number("unconfirmed"), 1.0);
  EXPECT_LT(shares.rows()[0].number("share_lower").value_or(1.0), 1.0 / 3.0);
  EXPECT_GT(shares.rows()[0].number("share_upper").value_or(0.0), 1.0 / 3.0);
}

TEST(Basins, TellOfEveryStartTheMinimumThatItEndsIn) {
  const Table given = answers();
  Table starts({"problem"});
  for (Row row : given.rows()) {
    row.set("bulge_1", 0.1 * static_cast<double>(starts.rows().size()));
    row.set("bulge_2", -0.5);
    starts.append(std::move(row));
  }
  const Table table = basins(starts, 0.01);
  ASSERT_EQ(table.rows().size(), starts.rows().size());
  const Table distinct = distinct_minima(given, 0.01);
  const Selection minima(distinct);
  for (const Row& row : table.rows()) {
    const auto place = static_cast<std::size_t>(std::lround(row.number("bulge_1", -1.0) / 0.1));
    const Row& start = starts.rows().at(place);
    EXPECT_EQ(row.text("method"), start.text("method"));
    EXPECT_EQ(row.text("status"), start.text("status"));
    if (start.text("status") != "solved") {
      EXPECT_EQ(row.text("minimum"), "");
      continue;
    }
    EXPECT_NEAR(row.number("objective", 0.0), start.number("objective", 0.0), 0.4);
    const Selection minimum = minima.where("minimum", row.text("minimum"));
    ASSERT_EQ(minimum.size(), 1U);
    EXPECT_EQ(row.number("objective"), minimum.front().number("objective"));
    EXPECT_EQ(row.text("is_motion"), minimum.front().text("is_motion"));
  }
}

TEST(BulgedGuess, IsAsWideAsItSaysInTheMiddleAndKeepsTheEnds) {
  const auto problem = make_problem("two_link_manipulator");
  const Motion guess{[&](double t) { return problem->guess(t); }, problem->horizon()};
  const Motion moved = bulged(guess, {0.5, -0.25});
  for (const double t : {0.0, problem->horizon()}) EXPECT_LT((moved.at(t).q - guess.at(t).q).norm(), 1e-14);
  const double middle = 0.5 * problem->horizon();
  const double range = std::numbers::pi;  // of both angles
  EXPECT_LT((moved.at(middle).q - guess.at(middle).q - range * Eigen::Vector2d(0.5, -0.25)).norm(), 1e-12);
  constexpr double step = 1e-6;
  const Eigen::VectorXd slope = (moved.at(0.3 + step).q - moved.at(0.3 - step).q) / (2.0 * step);
  EXPECT_LT((slope - moved.at(0.3).v).norm(), 1e-6);
}

TEST(BulgedGuess, HasASecondBulgeWhereThereIsOneCoordinate) {
  const auto problem = make_problem("double_integrator");
  const Motion guess{[&](double t) { return problem->guess(t); }, problem->horizon()};
  const Motion moved = bulged(guess, {0.0, 1.0});
  const double quarter = 0.25 * problem->horizon();
  EXPECT_NEAR(moved.at(2.0 * quarter).q[0], guess.at(2.0 * quarter).q[0], 1e-14);
  EXPECT_GT(moved.at(quarter).q[0] - guess.at(quarter).q[0], 0.5);
  EXPECT_LT(moved.at(3.0 * quarter).q[0] - guess.at(3.0 * quarter).q[0], -0.5);
}

TEST(PerturbedGuess, KeepsTheEndsAndTheSeedTellsItApart) {
  const auto problem = make_problem("two_link_manipulator");
  const Motion guess{[&](double t) { return problem->guess(t); }, problem->horizon()};
  const Motion moved = perturbed(guess, 0.5, 7, 3);
  for (const double t : {0.0, problem->horizon()}) EXPECT_LT((moved.at(t).q - guess.at(t).q).norm(), 1e-14);
  EXPECT_GT((moved.at(0.4).q - guess.at(0.4).q).norm(), 1e-3);
  EXPECT_EQ(moved.at(0.4).q, perturbed(guess, 0.5, 7, 3).at(0.4).q);
  EXPECT_NE(moved.at(0.4).q, perturbed(guess, 0.5, 7, 4).at(0.4).q);
  EXPECT_NE(moved.at(0.4).q, perturbed(guess, 0.5, 8, 3).at(0.4).q);
  EXPECT_EQ(perturbed(guess, 0.5, 7, 0).at(0.4).q, guess.at(0.4).q);
}

/// Sized by its bounds or by the guess; where neither tells, it stays, and so do the curves of the motion.
TEST(PerturbedGuess, VariesControlsInTheirOwnSize) {
  const tests::DoubleIntegrator base;
  const tests::Restated bounded(base, [](tests::Restated::Statement& s) { s.u = tests::all_between(1, -8.0, 4.0); });
  EXPECT_EQ(control_scales(bounded)[0], 6.0);
  EXPECT_EQ(control_scales(base)[0], 0.0);
  const Motion guess = guessed_motion(bounded);
  double largest = 0.0;
  for (std::uint64_t number = 1; number <= 20; ++number) {
    const Motion moved = perturbed(guess, 0.5, 1, number, control_scales(bounded));
    EXPECT_EQ(moved.at(0.3).q, perturbed(guess, 0.5, 1, number).at(0.3).q);
    EXPECT_EQ(perturbed(guess, 0.5, 1, number, control_scales(base)).at(0.3).u, guess.at(0.3).u);
    largest = std::max(largest, std::abs(moved.at(0.3).u[0] - guess.at(0.3).u[0]));
  }
  EXPECT_GT(largest, 1.0);
  EXPECT_LT(largest, 0.5 * 6.0 * (1.0 + 0.5 + 1.0 / 3.0));
  EXPECT_NE(varied_in_words(bounded).find("the controls u1"), std::string::npos);
  EXPECT_NE(varied_in_words(base).find("the controls u1 do not vary"), std::string::npos);
}

TEST(PerturbedGuess, HasTheVelocityThatIsItsSlope) {
  const auto problem = make_problem("orbital_transfer");
  const Motion guess{[&](double t) { return problem->guess(t); }, problem->horizon()};
  const Motion moved = perturbed(guess, 0.3, 1, 5);
  constexpr double e = 1e-6;
  for (const double t : {0.5, 3.0, 9.0}) {
    const Eigen::VectorXd slope = (moved.at(t + e).q - moved.at(t - e).q) / (2.0 * e);
    const Eigen::VectorXd guess_slope = (guess.at(t + e).q - guess.at(t - e).q) / (2.0 * e);
    EXPECT_LT((slope - guess_slope - (moved.at(t).v - guess.at(t).v)).norm(), 1e-7);
  }
}

}  // namespace
}  // namespace dmocbench
