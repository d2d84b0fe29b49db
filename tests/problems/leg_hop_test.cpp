// Bounds on forces of constraint: their formula, pressure and friction that bind, and the hop with a stance.
#include "problems/leg_hop.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/transcription/motions/phase_trajectories.hpp"
#include "problems/chaplygin_sleigh_cartesian.hpp"
#include "problems/spherical_pendulum_cartesian.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

Trajectory solved_hop(const Problem& problem, const Scheme& scheme, Eigen::Index intervals) {
  return tests::confirmed(problem, scheme, intervals, guessed_motion(problem), 1e-9).motion;
}

TEST(ConstraintMultipliers, AreThoseOfTheEquationsOfMotion) {
  const ChaplyginSleighCartesian sleigh;
  const SphericalPendulumCartesian pendulum;
  const LegHop::Stance stance;
  for (const Problem* problem : {static_cast<const Problem*>(&sleigh), static_cast<const Problem*>(&pendulum),
                                 static_cast<const Problem*>(&stance)}) {
    const Eigen::Index n = problem->configuration_size();
    EquationsOfMotion motion{TracedProblem(*problem)};
    const MotionPoint point{.q = Eigen::VectorXd::LinSpaced(n, 0.3, 0.9),
                            .v = Eigen::VectorXd::LinSpaced(n, 1.0, -0.7),
                            .u = Eigen::Vector2d(0.4, -1.3)};
    const Eigen::VectorXd found = tests::formulas_at(
        *problem, point, 0.2, [&](const ControlledState& x) { return constraint_multipliers(*problem, x); });
    EXPECT_LT((found - motion.multipliers(point, 0.2)).norm(), 1e-13) << problem->name();
  }
}

/// A body that rises fast is stopped at rest, 0.3 m higher: by a leg on a foot that may leave the floor.
class Stopped : public Problem {
 public:
  explicit Stopped(bool has_foot) : has_foot_(has_foot) {}
  [[nodiscard]] std::string name() const override { return "stopped"; }
  [[nodiscard]] std::vector<std::string> configuration_names() const override {
    return has_foot_ ? std::vector<std::string>{"z", "z_foot"} : std::vector<std::string>{"z"};
  }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"leg"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression of_body = 0.5 * x.v[0] * x.v[0] - LegHop::gravity * x.q[0];
    if (!has_foot_) return of_body;
    return of_body + LegHop::foot_mass * (0.5 * x.v[1] * x.v[1] - LegHop::gravity * x.q[1]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return has_foot_ ? ExpressionVector{{x.u[0], -x.u[0]}} : ExpressionVector{{x.u[0]}};
  }
  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    return has_foot_ ? ExpressionVector{{-q[1]}} : ExpressionVector();
  }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return has_foot_ ? constraint_multipliers(*this, x) : ExpressionVector();
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    if (!has_foot_) bounds.u = Bounds::all(1, -lift(), 1e3);
    return bounds;
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }
  [[nodiscard]] BoundaryState initial_state() const override { return {.q = at(0.8), .v = at(3.0, 0.0)}; }
  [[nodiscard]] BoundaryState final_state() const override { return BoundaryState::at_rest(at(1.1)); }
  [[nodiscard]] double horizon() const override { return 0.5; }
  /// The pull that lifts the foot.
  static double lift() { return LegHop::foot_mass * LegHop::gravity; }

 private:
  [[nodiscard]] Eigen::VectorXd at(double body, double foot = 0.0) const {
    return Eigen::VectorXd(Eigen::Vector2d(body, foot)).head(has_foot_ ? 2 : 1);
  }
  bool has_foot_;
};

/// The pressure of the floor binds where the leg would pull the foot up, as a bound on the leg does.
TEST(PressureOfAFloor, BindsWhereTheLegWouldLiftTheFoot) {
  for (const Scheme& scheme : {Scheme{"dmoc", 1}, Scheme{"hamiltonian", 1}, Scheme{"tangent", 2}}) {
    SCOPED_TRACE(scheme.label());
    const Trajectory by_pressure = solved_hop(Stopped(true), scheme, 32);
    const Trajectory by_bound = solved_hop(Stopped(false), scheme, 32);
    EXPECT_NEAR(by_pressure.cost, by_bound.cost, 1e-9 * by_bound.cost);
    EXPECT_LT((by_pressure.stage_u - by_bound.stage_u).lpNorm<Eigen::Infinity>(), 1e-6);
    const auto binding = (by_pressure.stage_u.array() < 1e-6 - Stopped::lift()).count();
    EXPECT_GT(binding, by_pressure.stage_u.size() / 8);
    EXPECT_LT(binding, by_pressure.stage_u.size());
  }
}

/// The least of μ λ_n - |λ_t| over the stages of the stance.
double least_margin_of_friction(const LegHop& problem, const Trajectory& motion) {
  const Trajectory stance = phase_trajectories(problem, motion)[0].motion;
  EquationsOfMotion equations{TracedProblem(LegHop::Stance())};
  double least = 1e3;
  for (Eigen::Index row = 0; row < stance.stage_times.size(); ++row) {
    const Eigen::VectorXd lambda = equations.multipliers(stance.stage(row), stance.stage_times[row]);
    EXPECT_GT(lambda[1], 0.0);
    least = std::min(least, LegHop::friction * lambda[1] - std::abs(lambda[0]));
  }
  return least;
}

TEST(LegHop, HasItsOptimumWithOrderTwo) {
  const LegHop problem;
  const double optimum = tests::value_of(problem.card().reference).objective;
  const double coarse = solved_hop(problem, {"dmoc", 1}, 64).cost - optimum;
  const double fine = solved_hop(problem, {"dmoc", 1}, 128).cost - optimum;
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1) << coarse << ", " << fine;
}

TEST(LegHop, KeepsToTheConeOfFrictionWhichBindsAndHasEqualSolutions) {
  const LegHop problem;
  const Trajectory motion = solved_hop(problem, {"dmoc", 1}, 64);
  const Trajectory collocated = solved_hop(problem, {"hamiltonian", 1}, 64);
  EXPECT_NEAR(least_margin_of_friction(problem, motion), 0.0, 1e-7);
  EXPECT_LT((motion.q - collocated.q).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_LT((motion.stage_u - collocated.stage_u).lpNorm<Eigen::Infinity>(), 1e-7);
  const Trajectory flight = phase_trajectories(problem, motion)[1].motion;
  EXPECT_GT(flight.q.col(3).minCoeff(), -1e-9);  // the foot
}

}  // namespace
}  // namespace dmocbench
