// A velocity constraint in three statements: two have the optimum and the orders of their tableaus, one loses order.
#include "problems/chaplygin_sleigh.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/transcription/elements/families.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

/// The component of a velocity (ẋ, ẏ, θ̇) across the blade: 0 on the constraint.
Expression across(const ControlledState& x) { return cos(x.q[2]) * x.v[1] - sin(x.q[2]) * x.v[0]; }

/// The sleigh by (x, y, θ), with the force λ of the blade as a formula.
class SleighByForce : public tests::SmallProblem {
 public:
  SleighByForce()
      : SmallProblem("sleigh_by_force", BoundaryState::at_rest(Eigen::Vector3d::Zero()),
                     BoundaryState::at_rest(Eigen::Vector3d(1.0, 1.0, 0.5 * std::numbers::pi)),
                     ChaplyginSleigh().horizon(), 2) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression centre_x = x.v[0] - a * sin(x.q[2]) * x.v[2];
    const Expression centre_y = x.v[1] + a * cos(x.q[2]) * x.v[2];
    return 0.5 * m * (centre_x * centre_x + centre_y * centre_y) + 0.5 * inertia * x.v[2] * x.v[2];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression lambda = force_of_blade(x);
    const Expression cosine = cos(x.q[2]);
    const Expression sine = sin(x.q[2]);
    return ExpressionVector{{x.u[0] * cosine - lambda * sine, x.u[0] * sine + lambda * cosine, x.u[1]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * (x.u[0] * x.u[0] + x.u[1] * x.u[1]);
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_velocity(0);  // across the blade
    return bounds;
  }

 protected:
  /// λ from the acceleration of the centre of mass across the blade.
  [[nodiscard]] virtual Expression force_of_blade(const ControlledState& x) const {
    const Expression along = cos(x.q[2]) * x.v[0] + sin(x.q[2]) * x.v[1];
    const Expression turn = (x.u[1] - m * a * along * x.v[2]) / (inertia + m * a * a);
    return m * (x.v[2] * along + a * turn);
  }

 private:
  const ChaplyginSleigh sleigh;
  const double m = sleigh.parameter("mass");
  const double a = sleigh.parameter("offset");
  const double inertia = sleigh.parameter("inertia");
};

/// The same with λ as a control and the constraint as an equality along the motion.
class SleighByMultiplier final : public SleighByForce {
 public:
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"push", "torque", "lambda"}; }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return ExpressionVector{{across(x)}};
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.path = Bounds::all(1, 0.0, 0.0);
    return bounds;
  }

 private:
  [[nodiscard]] Expression force_of_blade(const ControlledState& x) const override { return x.u[2]; }
};

Trajectory solved_sleigh(const Problem& problem, const Scheme& scheme, Eigen::Index intervals) {
  return tests::confirmed(problem, scheme, intervals, guessed_motion(problem), 1e-9).motion;
}

double optimum() { return tests::value_of(ChaplyginSleigh().card().reference).objective; }

/// Of a quantity whose limit is 0, on N and 2N intervals.
double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

/// Largest velocity across the blade at a node.
double drift(const Trajectory& motion) {
  const auto theta = motion.q.col(2).array();
  return (theta.cos() * motion.v.col(1).array() - theta.sin() * motion.v.col(0).array()).abs().maxCoeff();
}

TEST(ChaplyginSleigh, HasTheOptimumAndTheOrderOfTheTableauInBothStatements) {
  const ChaplyginSleigh by_quasi_velocities;
  const SleighByForce by_force;
  for (const Problem* problem :
       {static_cast<const Problem*>(&by_quasi_velocities), static_cast<const Problem*>(&by_force)}) {
    for (const std::string& method : paper_families()) {
      for (const int s : {1, 2}) {
        SCOPED_TRACE(problem->name() + ", " + method + ", s = " + std::to_string(s));
        const double coarse = solved_sleigh(*problem, {method, s}, 64).cost - optimum();
        const double fine = solved_sleigh(*problem, {method, s}, 128).cost - optimum();
        EXPECT_LT(std::abs(fine), s == 1 ? 5e-4 : 1e-8);
        EXPECT_NEAR(order(coarse, fine), 2.0 * s, 0.1);
      }
    }
  }
  EXPECT_NEAR(solved_sleigh(by_quasi_velocities, {"dmoc", 4}, 64).cost, optimum(), 5e-15 * optimum());
}

TEST(ChaplyginSleigh, SlipsByTheOrderOfTheTableauWhereTheForceOfTheBladeIsAFormula) {
  const SleighByForce problem;
  for (const int s : {1, 2}) {
    const double fine = drift(solved_sleigh(problem, {"dmoc", s}, 128));
    EXPECT_LT(fine, s == 1 ? 1e-4 : 1e-8);
    EXPECT_NEAR(order(drift(solved_sleigh(problem, {"dmoc", s}, 64)), fine), 2.0 * s, 0.2);
  }
}

/// Two stages have order 2 instead of 4.
TEST(ChaplyginSleigh, LosesOrderWhereTheForceOfTheBladeIsAControl) {
  const SleighByMultiplier problem;
  const double coarse = solved_sleigh(problem, {"dmoc", 2}, 64).cost - optimum();
  const double fine = solved_sleigh(problem, {"dmoc", 2}, 128).cost - optimum();
  EXPECT_GT(std::abs(fine), 1e-7);
  EXPECT_NEAR(order(coarse, fine), 2.0, 0.2);
}

}  // namespace
}  // namespace dmocbench
