// A rigid satellite by its rotation matrix: the closed form, Euler's angles, and momentum about every axis.
#include "problems/satellite_directors.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/mechanics/forwarding_problem.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

/// The slew of `SatelliteDirectors` by ZYX angles (φ, θ, ψ): R = R_z(ψ) R_y(θ) R_x(φ).
class SatelliteByAngles final : public Problem {
 public:
  explicit SatelliteByAngles(const SatelliteDirectors& directors) : directors_(directors) {}
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"roll", "pitch", "yaw"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_1", "u_2", "u_3"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const ExpressionVector omega = rates(x.q) * x.v;
    Expression sum = 0.0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      sum += 0.5 * directors_.parameter("inertia_" + std::to_string(i + 1)) * omega[i] * omega[i];
    }
    return sum;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return rates(x.q).transpose() * x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }
  [[nodiscard]] BoundaryState initial_state() const override { return angles_of(directors_.initial_state().q); }
  [[nodiscard]] BoundaryState final_state() const override { return angles_of(directors_.final_state().q); }
  [[nodiscard]] double horizon() const override { return directors_.horizon(); }

 private:
  /// B with ω = B q̇.
  static ExpressionMatrix rates(const ExpressionVector& q) {
    ExpressionMatrix b(3, 3);
    b << 1.0, 0.0, -sin(q[1]), 0.0, cos(q[0]), cos(q[1]) * sin(q[0]), 0.0, -sin(q[0]), cos(q[1]) * cos(q[0]);
    return b;
  }
  static BoundaryState angles_of(const Eigen::VectorXd& directors) {
    const Eigen::Matrix3d attitude = directors.reshaped(3, 3);
    return BoundaryState::at_rest(Eigen::Vector3d(std::atan2(attitude(2, 1), attitude(2, 2)),
                                                  -std::asin(attitude(2, 0)),
                                                  std::atan2(attitude(1, 0), attitude(0, 0))));
  }

  const SatelliteDirectors& directors_;
};

SatelliteDirectors general_slew() {
  SatelliteDirectors problem;
  for (const char* component : {"axis_1", "axis_2", "axis_3"}) problem.set_parameter(component, 1.0);
  problem.set_parameter("angle", 1.0);
  return problem;
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
  const SatelliteByAngles by_angles(problem);
  const double exact = cost_of(by_angles, {"dmoc", 4}, 32);
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
