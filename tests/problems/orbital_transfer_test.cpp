#include "problems/orbital_transfer.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "tests/support/problem_values.hpp"

namespace dmocbench {
namespace {

using std::numbers::pi;

/// Energy of the nondimensional Kepler problem, by hand.
double energy(const BoundaryState& state) {
  const double r = state.q[0];
  return 0.5 * (state.v[0] * state.v[0] + r * r * state.v[1] * state.v[1]) - 1.0 / r;
}

TEST(OrbitalTransfer, BeginsAndEndsOnCircularOrbits) {
  OrbitalTransfer problem;
  for (const double target : {330.0, 500.0, 35786.0}) {
    problem.set_parameter("target_altitude", target);
    EquationsOfMotion motion{TracedProblem(problem)};
    for (const BoundaryState& state : {problem.initial_state(), problem.final_state()}) {
      const double r = state.q[0];
      EXPECT_NEAR(energy(state), -0.5 / r, 1e-15);
      EXPECT_NEAR(r * r * state.v[1], std::sqrt(r), 1e-15 * std::sqrt(r));
      // Without thrust a circle stays a circle: no acceleration in polar coordinates.
      EXPECT_LT(motion.acceleration(state.q, state.v, Eigen::VectorXd::Zero(1), 0.0).norm(), 1e-15);
    }
  }
}

TEST(OrbitalTransfer, HasTheRadiiThatTheAltitudesMean) {
  const OrbitalTransfer problem;
  EXPECT_EQ(problem.initial_state().q[0], 1.0);
  EXPECT_NEAR(problem.final_state().q[0], 6701.0 / 6401.0, 1e-15);
}

TEST(OrbitalTransfer, UnwrapsTheAngleOfItsRevolutions) {
  OrbitalTransfer problem;
  for (const int revolutions : {1, 2, 7}) {
    problem.set_parameter("revolutions", revolutions);
    EXPECT_DOUBLE_EQ(problem.final_state().q[1], 2.0 * pi * revolutions);
  }
}

TEST(OrbitalTransfer, LastsTheHoursThatThePaperPrints) {
  // T = 2.93 h and h = 2.9e-3 h at N = 1024.
  const OrbitalTransfer problem;
  EXPECT_EQ(problem.card().time_unit.name, "h");
  const double hours = problem.horizon() * problem.card().time_unit.factor;
  EXPECT_NEAR(hours, 2.93, 0.005);
  EXPECT_NEAR(hours / 1024.0, 2.9e-3, 5e-5);
}

TEST(OrbitalTransfer, LastsTheRevolutionsOnTheEllipseThatTouchesBothCircles) {
  // Kepler's third law for the Hohmann ellipse, semi-major axis (1 + ρ)/2: T = 2πd a^{3/2}.
  OrbitalTransfer problem;
  for (const int revolutions : {1, 2, 5}) {
    problem.set_parameter("revolutions", revolutions);
    const double axis = 0.5 * (1.0 + problem.final_state().q[0]);
    EXPECT_NEAR(problem.horizon(), 2.0 * pi * revolutions * std::pow(axis, 1.5), 1e-14 * problem.horizon());
  }
}

TEST(OrbitalTransfer, IsSymmetricUnderRotations) {
  // Neither L nor its Legendre transform knows φ: ξ = (0, 1) moves nothing but φ.
  tests::expect_translation(OrbitalTransfer());
}

TEST(OrbitalTransfer, PushesAlongTheOrbitAlone) {
  const OrbitalTransfer problem;
  const ControlledState x{input_vector(0, 2), input_vector(2, 2), input_vector(4, 1), Expression::input(5)};
  const ExpressionVector force = problem.force(x);
  EXPECT_TRUE(force[0].is_zero());
  EXPECT_TRUE(force[1].is_same(x.q[0] * x.u[0]));  // a torque: lever r times thrust u
}

TEST(OrbitalTransfer, PicturesPositionsInKilometresAndThrustAcrossTheRadius) {
  const OrbitalTransfer problem;
  const auto at = [&](double r, double phi, double u) {
    return tests::picture_at(problem,
                             {Eigen::Vector2d(r, phi), Eigen::Vector2d::Zero(), Eigen::VectorXd::Constant(1, u)});
  };
  auto start = at(1.0, 0.0, 1.0);
  EXPECT_NEAR(start["x"], 6401.0, 1e-9);
  EXPECT_NEAR(start["y"], 0.0, 1e-9);
  // One unit of acceleration is gravity on the first orbit, γM/r² in m/s².
  EXPECT_NEAR(start["thrust"], 398600.0 / (6401.0 * 6401.0) * 1e3, 1e-12);
  auto somewhere = at(1.04, 0.8, 2e-3);
  EXPECT_NEAR(std::hypot(somewhere["x"], somewhere["y"]), 1.04 * 6401.0, 1e-9);
  EXPECT_NEAR(std::atan2(somewhere["y"], somewhere["x"]), 0.8, 1e-14);
  EXPECT_NEAR(std::hypot(somewhere["thrust_x"], somewhere["thrust_y"]), somewhere["thrust"], 1e-15);
  EXPECT_NEAR(somewhere["thrust_x"] * somewhere["x"] + somewhere["thrust_y"] * somewhere["y"], 0.0, 1e-9);
  // Positive thrust drives counterclockwise.
  EXPECT_GT(somewhere["x"] * somewhere["thrust_y"] - somewhere["y"] * somewhere["thrust_x"], 0.0);
}

}  // namespace
}  // namespace dmocbench
