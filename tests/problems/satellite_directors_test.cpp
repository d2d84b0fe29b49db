// A rigid satellite by its rotation matrix: other coordinates, the closed form, and momentum about every axis.
#include "problems/satellite_directors.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/mechanics/forwarding_problem.hpp"
#include "problems/satellite_angles.hpp"
#include "problems/satellite_quaternion.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

template <class Satellite>
Satellite general_slew(const Eigen::Vector3d& axis, double angle) {
  Satellite problem;
  problem.set_parameter("axis_1", axis[0]);
  problem.set_parameter("axis_2", axis[1]);
  problem.set_parameter("axis_3", axis[2]);
  problem.set_parameter("angle", angle);
  return problem;
}

SatelliteDirectors general_slew() { return general_slew<SatelliteDirectors>({1.0, 1.0, 1.0}, 1.0); }

/// What must not depend on coordinates at a point of the guess: the attitude, the kinetic energy and the power of the
/// torques (1, 2, 3).
Eigen::VectorXd seen_from_outside(const SatelliteSlew& problem, double t) {
  const MotionPoint point = problem.guess(t);
  const ExpressionVector q = point.q.cast<Expression>();
  const ExpressionVector v = point.v.cast<Expression>();
  const ExpressionVector torques = Eigen::Vector3d(1.0, 2.0, 3.0).cast<Expression>();
  Eigen::VectorXd seen(11);
  seen << problem.attitude_at(point.q).reshaped(), problem.lagrangian({q, v, t}).constant_value().value(),
      problem.force({q, v, torques, t}).dot(v).constant_value().value();
  return seen;
}

TEST(Satellites, TurnTheSameBodyByTheSameTorquesInAllCoordinates) {
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1.0, 1.0, 0.3), Eigen::Vector3d(0.1, 1.0, 0.1)}) {
    const auto directors = general_slew<SatelliteDirectors>(axis, 2.6);
    const auto angles = general_slew<SatelliteAngles>(axis, 2.6);
    const auto quaternion = general_slew<SatelliteQuaternion>(axis, 2.6);
    for (int i = 0; i <= 32; ++i) {
      const double t = directors.horizon() * i / 32.0;
      const Eigen::VectorXd seen = seen_from_outside(directors, t);
      EXPECT_LT((seen_from_outside(angles, t) - seen).norm(), 1e-13 * (1.0 + seen.norm()));
      EXPECT_LT((seen_from_outside(quaternion, t) - seen).norm(), 1e-13 * (1.0 + seen.norm()));
    }
  }
}

double cost_of(const Problem& problem, const tests::Scheme& scheme, Eigen::Index intervals) {
  return tests::solve(problem, scheme, Grid::uniform(intervals), guessed_motion(problem)).trajectory.cost;
}

TEST(SatelliteDirectors, SlewsAboutAPrincipalAxisAtTheCostOfTheClosedForm) {
  SatelliteDirectors problem;
  problem.set_parameter("axis_1", 0.0);
  problem.set_parameter("axis_3", 1.0);
  problem.set_parameter("angle", 2.0);
  const double exact = 6.0 * std::pow(problem.parameter("inertia_3") * 2.0, 2) / std::pow(problem.horizon(), 3);
  const auto error = [&](Eigen::Index intervals) {
    return std::abs(cost_of(problem, {"dmoc", 3, "lobatto"}, intervals) / exact - 1.0);
  };
  EXPECT_LT(error(32), 1e-5);
  EXPECT_NEAR(std::log2(error(16) / error(32)), 4.0, 0.2);
}

TEST(SatelliteDirectors, HaveTheOptimumOfEulersAnglesAwayFromTheirSingularity) {
  const SatelliteDirectors problem = general_slew();
  const double exact = cost_of(general_slew<SatelliteAngles>({1.0, 1.0, 1.0}, 1.0), {"dmoc", 4}, 32);
  EXPECT_NEAR(cost_of(problem, {"dmoc", 3, "lobatto"}, 64), exact, 1e-7 * exact);
  EXPECT_NEAR(cost_of(problem, {"tangent", 2}, 64), exact, 1e-7 * exact);
}

/// The same slew with the momentum about another axis of space.
class AboutAxis final : public ForwardingProblem {
 public:
  AboutAxis(const SatelliteDirectors& base, Eigen::Index axis) : ForwardingProblem(base), axis_(axis) {}
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    ExpressionVector generator(9);
    for (Eigen::Index i = 0; i < 9; i += 3) {
      generator[i + (axis_ + 1) % 3] = -q[i + (axis_ + 2) % 3];
      generator[i + (axis_ + 2) % 3] = q[i + (axis_ + 1) % 3];
    }
    return generator;
  }

 private:
  Eigen::Index axis_;
};

TEST(SatelliteDirectors, BalanceMomentumAboutEveryAxisOfSpace) {
  const SatelliteDirectors base = general_slew();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const AboutAxis problem(base, axis);
    for (const tests::Scheme& scheme : {tests::Scheme{"dmoc", 1}, tests::Scheme{"hamiltonian", 2, "lobatto"}}) {
      const Trajectory motion =
          tests::solve(problem, scheme, Grid::uniform(16), guessed_motion(problem), 1e-12).trajectory;
      const MomentumConsistency consistency = momentum_consistency(problem, motion);
      EXPECT_GT(consistency.largest_force, 0.1);
      EXPECT_LT(consistency.largest, 1e-11) << scheme.label() << ", axis " << axis;
    }
  }
}

}  // namespace
}  // namespace dmocbench
