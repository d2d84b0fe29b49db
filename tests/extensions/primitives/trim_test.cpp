#include "methods/extensions/primitives/trim.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "problems/hovercraft.hpp"
#include "problems/orbital_transfer.hpp"
#include "problems/spherical_pendulum.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

/// Translations and rotations of the plane.
std::vector<Generator> motions_of_the_plane() {
  return {[](const ExpressionVector&) {
            return ExpressionVector{{1.0, 0.0, 0.0}};
          },
          [](const ExpressionVector&) {
            return ExpressionVector{{0.0, 1.0, 0.0}};
          },
          [](const ExpressionVector& q) {
            return ExpressionVector{{-q[1], q[0], 1.0}};
          }};
}

/// How far the simulated motion under the trim's control is from the flow of the group at time 1, by `steps` steps of
/// the classical method of order 4.
double distance_from_flow(const Problem& problem, const SymmetryGroup& group, const Trim& trim, int steps) {
  const TracedProblem traced(problem);
  EquationsOfMotion equations(traced);
  const Eigen::Index n = trim.q.size();
  const auto rate = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd result(2 * n);
    result << x.tail(n), equations.acceleration(x.head(n), x.tail(n), trim.u, 0.0);
    return result;
  };
  Eigen::VectorXd x(2 * n);
  x << trim.state.q, trim.state.v;
  const double h = 1.0 / steps;
  for (int k = 0; k < steps; ++k) {
    const Eigen::VectorXd k1 = rate(x);
    const Eigen::VectorXd k2 = rate(x + 0.5 * h * k1);
    const Eigen::VectorXd k3 = rate(x + 0.5 * h * k2);
    const Eigen::VectorXd k4 = rate(x + h * k3);
    x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  const BoundaryState there = group.flow(trim.rates, 1.0).state(trim.state);
  return std::max((x.head(n) - there.q).norm(), (x.tail(n) - there.v).norm());
}

/// The trim is followed exactly: what is left is the integrator's error, of order 4.
void expect_exact_motion(const Problem& problem, const SymmetryGroup& group, const Trim& trim) {
  const double coarse = distance_from_flow(problem, group, trim, 50);
  const double fine = distance_from_flow(problem, group, trim, 100);
  EXPECT_LT(fine, std::max(coarse / 12.0, 1e-12));
  EXPECT_LT(fine, 1e-6);
}

TEST(Trim, OfAnOrbitIsACircleWithKeplersRate) {
  const OrbitalTransfer problem;
  const SymmetryGroup group(problem);
  const TrimSolver solver(problem, group);
  const Trim guess{
      .q = Eigen::Vector2d(1.3, 0.0), .rates = Eigen::VectorXd::Constant(1, 0.8), .u = Eigen::VectorXd::Zero(1)};
  const Trim trim = solver.solve(guess, {2});
  EXPECT_NEAR(trim.rates[0], std::pow(1.3, -1.5), 1e-13);
  expect_exact_motion(problem, group, trim);
  // With a given rate the radius is found.
  EXPECT_NEAR(solver.solve(guess, {0}).q[0], std::pow(0.8, -2.0 / 3.0), 1e-12);
}

TEST(Trim, OfASphericalPendulumIsASteadyCone) {
  const SphericalPendulum problem;
  const SymmetryGroup group(problem);
  const TrimSolver solver(problem, group);
  const Trim trim = solver.solve(
      {.q = Eigen::Vector2d(0.9, 0.0), .rates = Eigen::VectorXd::Constant(1, 3.5), .u = Eigen::VectorXd::Zero(2)}, {2});
  EXPECT_NEAR(trim.rates[0], std::sqrt(problem.parameter("gravity") / std::cos(0.9)), 1e-12);
  expect_exact_motion(problem, group, trim);
}

TEST(Trim, OfAHovercraftThatTurnsHasAThrustTowardsTheCentre) {
  const Hovercraft problem;
  const SymmetryGroup group(problem, motions_of_the_plane());
  const TrimSolver solver(problem, group);
  const Trim trim = solver.solve(
      {.q = Eigen::Vector3d::Zero(), .rates = Eigen::Vector3d(0.3, -0.5, 1.2), .u = Eigen::Vector2d::Zero()},
      {3, 6, 7});
  EXPECT_NEAR(trim.rates[0], 0.0, 1e-12);  // the stern cannot push sideways without turning
  EXPECT_NEAR(trim.u[0], 0.5 * 1.2, 1e-12);
  EXPECT_NEAR(trim.u[1], 0.0, 1e-12);
}

TEST(Trim, IsRefusedWhereThereIsNone) {
  const OrbitalTransfer problem;
  const SymmetryGroup group(problem);
  const Trim guess{
      .q = Eigen::Vector2d(1.3, 0.0), .rates = Eigen::VectorXd::Constant(1, 0.8), .u = Eigen::VectorXd::Zero(1)};
  // The thrust is tangential: it does not hold a satellite on a circle that it is too slow for.
  tests::expect_error_naming({"orbital_transfer", "relative equilibrium"},
                             [&] { static_cast<void>(TrimSolver(problem, group).solve(guess, {3})); });
}

TEST(SymmetryGroup, FlowsAsItsGeneratorsSay) {
  const Hovercraft problem;
  const SymmetryGroup group(problem, motions_of_the_plane());
  const Eigen::Vector3d rates(0.4, -0.7, 1.3);
  const Eigen::Vector3d q(0.2, 0.5, 0.1);
  constexpr double step = 1e-5;
  const Eigen::VectorXd difference =
      (group.flow(rates, step).configuration(q) - group.flow(rates, -step).configuration(q)) / (2.0 * step);
  EXPECT_LT((difference - group.velocity(q, rates)).norm(), 1e-9);
  EXPECT_LT(group.flow(rates, 2.0).after(group.flow(rates, 1.5)).distance(group.flow(rates, 3.5)), 1e-13);
  const Displacement turned = group.flow(Eigen::Vector3d(0.0, 0.0, 1.0), 30.0);
  EXPECT_NEAR(turned.linear(0, 0), std::cos(30.0), 1e-12);
  EXPECT_NEAR(turned.linear(1, 0), std::sin(30.0), 1e-12);
}

TEST(SymmetryGroup, RefusesAGeneratorThatIsNotAffine) {
  const Hovercraft problem;
  const Generator bent = [](const ExpressionVector& q) { return ExpressionVector{{q[1] * q[1], 0.0, 0.0}}; };
  tests::expect_error_naming({"affine"}, [&] { SymmetryGroup(problem, {bent}); });
}

}  // namespace
}  // namespace dmocbench
