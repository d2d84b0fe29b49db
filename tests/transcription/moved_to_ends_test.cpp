#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

/// q = (sin t, t²) for 0 <= t <= 2.
Motion curve() {
  const auto at = [](double t) {
    return MotionPoint{Eigen::Vector2d(std::sin(t), t * t), Eigen::Vector2d(std::cos(t), 2.0 * t),
                       Eigen::VectorXd::Constant(1, 3.0 * t)};
  };
  return {at, 2.0};
}

ProblemBounds ends(const BoundaryState& first, const BoundaryState& last) {
  ProblemBounds bounds;
  bounds.first = EndBounds::fixed(first);
  bounds.last = EndBounds::fixed(last);
  return bounds;
}

void expect_near(const Eigen::VectorXd& one, const Eigen::VectorXd& other, double tolerance) {
  EXPECT_LT((one - other).lpNorm<Eigen::Infinity>(), tolerance);
}

TEST(MovedToEnds, HasTheStatesThatAreFixedAndKeepsItsControls) {
  const BoundaryState first{.q = Eigen::Vector2d(0.3, -1.0), .v = Eigen::Vector2d(2.0, 0.5)};
  const BoundaryState last{.q = Eigen::Vector2d(-0.2, 4.5), .v = Eigen::Vector2d(-1.0, 0.0)};
  const Motion moved = moved_to_ends(curve(), ends(first, last));
  expect_near(moved.at(0.0).q, first.q, 1e-14);
  expect_near(moved.at(0.0).v, first.v, 1e-14);
  expect_near(moved.at(2.0).q, last.q, 1e-14);
  expect_near(moved.at(2.0).v, last.v, 1e-14);
  EXPECT_EQ(moved.at(0.7).u, curve().at(0.7).u);
  EXPECT_EQ(moved.horizon, 2.0);
}

TEST(MovedToEnds, HasTheVelocityOfItsConfiguration) {
  const BoundaryState first{.q = Eigen::Vector2d(0.3, -1.0), .v = Eigen::Vector2d(2.0, 0.5)};
  const BoundaryState last{.q = Eigen::Vector2d(-0.2, 4.5), .v = Eigen::Vector2d(-1.0, 0.0)};
  const Motion moved = moved_to_ends(curve(), ends(first, last));
  constexpr double step = 1e-5;
  for (const double t : {0.1, 0.9, 1.8}) {
    expect_near((moved.at(t + step).q - moved.at(t - step).q) / (2.0 * step), moved.at(t).v, 1e-8);
  }
}

TEST(MovedToEnds, MovesNothingThatIsFreeOrThereAlready) {
  const MotionPoint last = curve().at(2.0);
  ProblemBounds bounds = ends({.q = Eigen::Vector2d(0.0, 5.0), .v = Eigen::Vector2d(1.0, 0.0)}, {last.q, last.v});
  bounds.first.free_configuration(1);
  const Motion moved = moved_to_ends(curve(), bounds);
  for (const double t : {0.0, 0.6, 1.3, 2.0}) {
    expect_near(moved.at(t).q, curve().at(t).q, 1e-15);
    expect_near(moved.at(t).v, curve().at(t).v, 1e-15);
  }
}

// A displacement of half the way of one interval in that interval alone is far away for methods whose velocities are
// differences of configurations; over the whole motion it is not.
TEST(MovedToEnds, LetsMethodsWithoutVelocitiesStartWarmAsWellAsThoseThatHaveThem) {
  const auto problem = make_problem("orbital_transfer");
  const Motion start = tests::common_start(*problem);
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    const auto program = tests::transcribe(*problem, {method}, Grid::uniform(64));
    const Solution solved = make_solver("interior_point")->solve(*program, sample(*program, start));
    ASSERT_EQ(solved.status, Status::solved);
    const Motion motion = smooth_motion(read_trajectory(*program, solved.primal, solved.multipliers));
    BoundaryState displaced = problem->initial_state();
    displaced.q[1] += 0.1;  // h is 0.2, the velocity 1
    program->set_initial_state(displaced);
    const auto iterations_from = [&](const Eigen::VectorXd& from) {
      const Solution warm = make_solver("interior_point")->solve(*program, from, solved.multipliers);
      EXPECT_EQ(warm.status, Status::solved);
      return warm.major_iterations.value();
    };
    const int moved = iterations_from(sample(*program, moved_to_ends(motion, program->bounds())));
    const int with_a_jump =
        iterations_from(solved.primal.cwiseMax(program->variable_lower()).cwiseMin(program->variable_upper()));
    EXPECT_LE(moved, 4);
    if (method != "tangent") {
      EXPECT_LT(moved, with_a_jump);
    }
  }
}

}  // namespace
}  // namespace dmocbench
