#include "problems/kepler_cartesian.hpp"

#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "problems/orbital_transfer.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

using std::numbers::pi;

/// Position and velocity in the plane of a state in polar coordinates.
BoundaryState in_the_plane(const BoundaryState& polar) {
  const double r = polar.q[0];
  const Eigen::Vector2d outward(std::cos(polar.q[1]), std::sin(polar.q[1]));
  const Eigen::Vector2d along(-outward[1], outward[0]);
  return {.q = r * outward, .v = polar.v[0] * outward + r * polar.v[1] * along};
}

/// The angle that a motion sweeps around the origin, from node to node.
double swept_angle(const Trajectory& trajectory) {
  double angle = 0.0;
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    const Eigen::Vector2d a = trajectory.q.row(k);
    const Eigen::Vector2d b = trajectory.q.row(k + 1);
    angle += std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
  }
  return angle;
}

TEST(KeplerCartesian, MovesAsTheOrbitalTransferDoesInPolarCoordinates) {
  const KeplerCartesian plane;
  const OrbitalTransfer polar;
  EquationsOfMotion plane_motion{TracedProblem(plane)};
  EquationsOfMotion polar_motion{TracedProblem(polar)};
  tests::RandomPoints random;
  for (int trial = 0; trial < 20; ++trial) {
    const BoundaryState at{.q = Eigen::Vector2d(random.number(0.8, 1.5), random.number(-3.0, 3.0)),
                           .v = random.vector(2)};
    const Eigen::VectorXd u = random.vector(1);
    const Eigen::Vector2d acceleration = polar_motion.acceleration(at.q, at.v, u, 0.0);
    const double r = at.q[0];
    const Eigen::Vector2d outward(std::cos(at.q[1]), std::sin(at.q[1]));
    const Eigen::Vector2d along(-outward[1], outward[0]);
    const Eigen::Vector2d expected =
        (acceleration[0] - r * at.v[1] * at.v[1]) * outward + (r * acceleration[1] + 2.0 * at.v[0] * at.v[1]) * along;
    const BoundaryState there = in_the_plane(at);
    EXPECT_LT((plane_motion.acceleration(there.q, there.v, u, 0.0) - expected).norm(), 1e-13);
  }
}

TEST(KeplerCartesian, HasTheEndsAndTheDurationOfTheOrbitalTransfer) {
  KeplerCartesian plane;
  OrbitalTransfer polar;
  for (const double revolutions : {1.0, 2.0, 10.0}) {
    plane.set_parameter("revolutions", revolutions);
    polar.set_parameter("revolutions", revolutions);
    EXPECT_EQ(plane.horizon(), polar.horizon());
    const BoundaryState last = in_the_plane(polar.final_state());
    EXPECT_LT((plane.final_state().q - last.q).norm(), 1e-13);
    EXPECT_LT((plane.final_state().v - last.v).norm(), 1e-13);
  }
}

TEST(KeplerCartesian, HasALagrangianThatRotationsLeaveAlone) {
  const KeplerCartesian problem;
  tests::RandomPoints random;
  const Eigen::Vector2d q(0.9, -0.5);
  EXPECT_LT((tests::generator_at(problem, q) - Eigen::Vector2d(0.5, 0.9)).norm(), 1e-15);
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(random.number(-3.0, 3.0)).toRotationMatrix();
    const Eigen::Vector2d v = random.vector(2);
    EXPECT_NEAR(tests::lagrangian_at(problem, rotation * q, rotation * v), tests::lagrangian_at(problem, q, v), 1e-14);
  }
}

TEST(KeplerCartesian, HasTheOptimumOfTheOrbitalTransferAfterAsManyRevolutions) {
  // Trigonometric functions of time are to be resolved here, slow drifts there: hence the finer grid.
  const KeplerCartesian plane;
  const OrbitalTransfer polar;
  const auto solved = [](const Problem& problem, Eigen::Index intervals) {
    return tests::solve(problem, {"dmoc", 3}, Grid::uniform(intervals), guessed_motion(problem), 1e-11).trajectory;
  };
  const Trajectory in_plane = solved(plane, 160);
  const Trajectory in_angles = solved(polar, 48);
  EXPECT_NEAR(in_plane.cost / in_angles.cost, 1.0, 1e-9);
  EXPECT_NEAR(swept_angle(in_plane), 4.0 * pi, 1e-9);
  const ReferenceOptimum reference = tests::value_of(plane.card().reference);
  EXPECT_EQ(reference.objective, tests::value_of(polar.card().reference).objective);
  EXPECT_NEAR(in_angles.cost / reference.objective, 1.0, 1e-10);
}

TEST(KeplerCartesian, KnowsItsOptimumAfterTwoAndTenRevolutionsOnly) {
  KeplerCartesian problem;
  EXPECT_TRUE(problem.card().reference.has_value());
  const double after_two = tests::value_of(problem.card().reference).objective;
  problem.set_parameter("revolutions", 10.0);
  EXPECT_LT(tests::value_of(problem.card().reference).objective, 0.25 * after_two);
  problem.set_parameter("revolutions", 3.0);
  EXPECT_FALSE(problem.card().reference.has_value());
}

TEST(KeplerCartesian, MakesTangentSpaceAndHamiltonianCollocationOneMethod) {
  const KeplerCartesian problem;
  const auto solved = [&](const std::string& method) {
    return tests::solve(problem, {method, 1}, Grid::uniform(32), guessed_motion(problem), 1e-12).trajectory;
  };
  const Trajectory tangent = solved("tangent");
  const Trajectory hamiltonian = solved("hamiltonian");
  EXPECT_NEAR(tangent.cost / hamiltonian.cost, 1.0, 1e-11);
  EXPECT_LT((tangent.q - hamiltonian.q).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_LT((tangent.stage_u - hamiltonian.stage_u).lpNorm<Eigen::Infinity>(), 1e-11);
}

TEST(KeplerCartesian, PicturesWhatTheOrbitalTransferPictures) {
  const KeplerCartesian plane;
  const OrbitalTransfer polar;
  const BoundaryState at{.q = Eigen::Vector2d(1.04, 0.8), .v = Eigen::Vector2d::Zero()};
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(1, 2e-3);
  const auto expected = tests::picture_at(polar, {at.q, at.v, u});
  for (const auto& [name, value] : tests::picture_at(plane, {in_the_plane(at).q, at.v, u})) {
    EXPECT_NEAR(value, expected.at(name), 1e-12 * (1.0 + std::abs(value))) << name;
  }
}

}  // namespace
}  // namespace dmocbench
