#include <cmath>

#include <gtest/gtest.h>

#include "methods/diagnostics/accuracy.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Restated;

/// The double integrator from rest to rest over a distance within a time, at the least cost 6 d²/T³.
class Displacement final : public tests::SmallProblem {
 public:
  explicit Displacement(double distance, double horizon = 1.0)
      : SmallProblem("displacement", at(0.0, 0.0), at(distance, 0.0), horizon, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }
};

TEST(GivenDistance, IsWhatBoundsAtSomeTimesKeepApartInEachEntry) {
  const tests::DoubleIntegrator base;
  EXPECT_EQ(given_distances(base.bounds()), Eigen::Vector2d(1.0, 0.0));
  const auto distance = [&](const std::function<void(Restated::Statement&)>& state) {
    return given_distances(Restated(base, state).bounds())[0];
  };
  EXPECT_EQ(distance([](auto& s) { s.last.free_configuration(0); }), 0.0);
  EXPECT_EQ(distance([](auto& s) { s.last.q = Bounds::all(1, -1.0, 0.5); }), 0.0);
  EXPECT_EQ(distance([](auto& s) { s.last.q = Bounds::all(1, 0.25, 0.5); }), 0.25);
  EXPECT_EQ(distance([](auto& s) { s.interior.push_back({.relative_time = 0.5, .q = Bounds::all(1, -2.0, -2.0)}); }),
            3.0);
  const Restated tiny(base, [](auto& s) {
    s.last.q = Bounds::all(1, 3e-200, 3e-200);
    s.last.v = Bounds::all(1, -4e-200, -4e-200);
  });
  EXPECT_EQ(given_distances(tiny.bounds()), Eigen::Vector2d(3e-200, 4e-200));
}

TEST(GivenDistance, IsLostWhereTheToleranceHidesIt) {
  struct Case {
    double distance = 0.0;
    double horizon = 1.0;
  };
  for (const Case& given : {Case{1e-9, 1000.0}, Case{1e-11}, Case{1e-12}, Case{1e-20}, Case{1e-50}, Case{1e-100}}) {
    const Displacement problem(given.distance, given.horizon);
    for (const char* method : {"dmoc", "tangent", "hamiltonian"}) {
      const Motion start = guessed_motion(problem);
      const Trajectory motion = tests::solve(problem, {method}, Grid::uniform(32), start, 1e-8).trajectory;
      const double cost = 6.0 * given.distance * given.distance / std::pow(given.horizon, 3);
      const bool is_right = std::abs(motion.cost - cost) < 0.01 * cost;
      EXPECT_NE(is_right, !lost_distance(problem.bounds(), motion, accuracy(problem, motion)).empty())
          << method << ' ' << given.distance << ": " << motion.cost;
    }
  }
}

/// Two masses, one of which moves by 1.
class UnequalDisplacements final : public tests::SmallProblem {
 public:
  explicit UnequalDisplacements(double distance)
      : SmallProblem("unequal", {.q = Eigen::Vector2d(1.0, 0.0), .v = Eigen::Vector2d::Zero()},
                     {.q = Eigen::Vector2d(1.0 + distance, 1.0), .v = Eigen::Vector2d::Zero()}, 1.0, 2) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v.dot(x.v); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }
};

TEST(GivenDistance, IsLostOfOneEntryNextToALargeOne) {
  for (const double distance : {1e-7, 1e-9, 1e-11, 1e-12}) {
    const UnequalDisplacements problem(distance);
    for (const char* method : {"dmoc", "tangent", "hamiltonian"}) {
      const Trajectory motion =
          tests::solve(problem, {method}, Grid::uniform(16), guessed_motion(problem), 1e-10).trajectory;
      EXPECT_EQ(lost_distance(problem.bounds(), motion, accuracy(problem, motion)), "") << method << ' ' << distance;
      Trajectory lost = motion;  // as fast as the guess, from the first node to the last
      lost.q.col(0) = Eigen::VectorXd::LinSpaced(17, 1.0, 1.0 + distance);
      lost.v.col(0).setZero();
      lost.stage_v.col(0).setConstant(distance);
      lost.stage_u.col(0).setZero();
      EXPECT_NE(lost_distance(problem.bounds(), lost, accuracy(problem, lost)), "") << method << ' ' << distance;
    }
  }
}

TEST(GivenDistance, OfRoundOffIsNone) {
  const UnequalDisplacements problem(0.0);
  ProblemBounds bounds = problem.bounds();
  const Trajectory motion = tests::solve(problem, {"dmoc"}, Grid::uniform(16), guessed_motion(problem)).trajectory;
  bounds.last.q.lower[0] = bounds.last.q.upper[0] = std::nextafter(1.0, 2.0);
  EXPECT_TRUE(small_distances(bounds, motion).isZero(0.0));
}

TEST(GivenDistance, IsNotLostInAMotionThatCoversIt) {
  const Displacement base(1.0);
  const Trajectory motion = tests::solve(base, {"dmoc"}, Grid::uniform(32), guessed_motion(base)).trajectory;
  for (const double distance : {1.0, 1e-3, 1e-8, 1e-12, 1e-100}) {
    Trajectory shorter = motion;
    for (Eigen::MatrixXd* part : {&shorter.q, &shorter.v, &shorter.stage_u}) *part *= distance;
    const Displacement problem(distance);
    EXPECT_EQ(lost_distance(problem.bounds(), shorter, accuracy(problem, shorter)), "") << distance;
  }
}

}  // namespace
}  // namespace dmocbench
