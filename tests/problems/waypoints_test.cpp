#include "problems/waypoints.hpp"

#include <gtest/gtest.h>

#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

TEST(Waypoints, GuessPassesThroughThem) {
  const Waypoints problem;
  for (const InteriorBounds& at : problem.bounds().interior) {
    const MotionPoint point = problem.guess(at.relative_time * problem.horizon());
    EXPECT_NEAR((point.q - at.q.lower).norm(), 0.0, 1e-12);
  }
}

class WaypointsBy : public testing::TestWithParam<std::string> {};

TEST_P(WaypointsBy, CostLessThroughSquares) {
  Waypoints problem;
  const auto solved = [&](double width) {
    problem.set_parameter("width", width);
    return tests::solve(problem, {GetParam(), 2}, Grid::uniform(12), guessed_motion(problem)).trajectory;
  };
  const Trajectory through_points = solved(0.0);
  const Trajectory through_squares = solved(0.01);
  // Every bound gives way by 0.01 in the direction that is cheaper.
  const double expected = 0.01 * through_points.prices.q.cwiseAbs().sum();
  EXPECT_NEAR(through_points.cost - through_squares.cost, expected, 0.05 * expected);
}

INSTANTIATE_TEST_SUITE_P(All, WaypointsBy, testing::Values("dmoc", "hamiltonian", "tangent"),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace dmocbench
