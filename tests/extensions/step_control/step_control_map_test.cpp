#include "methods/extensions/step_control/step_control_map.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/one_step_map.hpp"
#include "methods/extensions/step_control/extended_action.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/numerics/adaptive_integration.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using From = StepControlMap::From;
using Step = StepControlMap::Step;

/// The Lagrangian of `MovingFrame` without forces: L_vv moves with q and t.
class UnforcedFrame final : public tests::SmallProblem {
 public:
  UnforcedFrame()
      : SmallProblem("unforced_frame", tests::MovingFrame().initial_state(), tests::MovingFrame().final_state(), 1.5,
                     1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return tests::MovingFrame().lagrangian(x); }
  [[nodiscard]] ExpressionVector force(const ControlledState& /*x*/) const override {
    return ExpressionVector::Zero(2);
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }
};

From state_of(const Problem& problem, const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t) {
  return {.q = q,
          .p = LegendreTransform(TracedProblem(problem)).momentum(q, v, t),
          .t = t,
          .energy = Energy(problem).energy(q, v, t),
          .velocity = v};
}

From start_of(const Problem& problem) {
  return state_of(problem, problem.initial_state().q, problem.initial_state().v, 0.0);
}

Expression uniform(const ControlledState& /*x*/) { return 1.0; }
/// Reads everything that it may read.
Expression of_everything(const ControlledState& x) {
  return 1.0 + 0.3 * x.q[0] * x.q[0] + 0.2 * x.v[1] * x.v[1] + 0.1 * sin(x.t) + 0.1 * x.u[0] * x.u[0];
}
Expression distance(const ControlledState& x) { return pow(x.q.dot(x.q), 0.75); }

Eigen::VectorXd flat(const From& at) {
  Eigen::VectorXd all(2 * at.q.size() + 2);
  all << at.q, at.t, at.p, -at.energy;
  return all;
}

TEST(StepControlMap, WithAConstantFunctionIsTheMapOfDmoc) {
  const tests::MovingFrame problem;
  tests::RandomPoints random;
  for (const int stages : {1, 2, 3}) {
    const Tableau tableau = gauss_tableau(stages);
    const Eigen::MatrixXd controls = random.vector(2L * stages).reshaped(stages, 2);
    const From from = start_of(problem);
    const auto plain = OneStepMap<double>(TracedProblem(problem), *make_element("dmoc"), tableau)
                           .advance(from.q, from.p, from.velocity, controls, 0.2, 0.0);
    for (const StepRule rule : {StepRule::variational, StepRule::imposed, StepRule::from_left}) {
      const Step step = StepControlMap(problem, tableau, uniform, rule).advance(from, controls, 0.2);
      EXPECT_LT((step.end.q - plain.q).norm(), 1e-13);
      EXPECT_LT((step.end.p - plain.p).norm(), 1e-13);
      EXPECT_LT((step.impulse - plain.impulse).norm(), 1e-13);
      EXPECT_NEAR(step.h, 0.2, 1e-14);
    }
  }
}

TEST(StepControlMap, JacobianIsThatOfCentralDifferences) {
  const tests::MovingFrame problem;
  const Eigen::MatrixXd controls = Eigen::RowVector2d(0.4, -0.7);
  for (const StepRule rule : {StepRule::variational, StepRule::imposed}) {
    const StepControlMap map(problem, gauss_tableau(1), of_everything, rule);
    const From from = start_of(problem);
    const Eigen::MatrixXd jacobian = map.jacobian(map.advance(from, controls, 0.1));
    constexpr double step = 1e-5;
    for (Eigen::Index j = 0; j < 6; ++j) {
      const auto moved = [&](double offset) {
        From other = from;
        if (j < 2) other.q[j] += offset;
        if (j == 2) other.t += offset;
        if (j > 2 && j < 5) other.p[j - 3] += offset;
        if (j == 5) other.energy -= offset;
        return flat(map.advance(other, controls, 0.1).end);
      };
      EXPECT_LT(((moved(step) - moved(-step)) / (2.0 * step) - jacobian.col(j)).norm(), 1e-8) << "column " << j;
    }
  }
}

double defect_of_step(StepRule rule, int stages) {
  const UnforcedFrame problem;
  const auto sigma = [](const ControlledState& x) {
    return 1.0 + 0.3 * x.q[0] * x.q[0] + 0.2 * x.v[1] * x.v[1] + 0.1 * sin(x.t);
  };
  const StepControlMap map(problem, gauss_tableau(stages), sigma, rule);
  const Step step = map.advance(start_of(problem), Eigen::MatrixXd::Zero(stages, 1), 0.1);
  return symplecticity_defect(map.jacobian(step));
}

TEST(StepControlMap, IsSymplecticInTheExtendedPhaseSpaceOnlyWhereTheStepsArePartOfThePrinciple) {
  for (const int stages : {1, 2}) {
    EXPECT_LT(defect_of_step(StepRule::variational, stages), 1e-13);
    EXPECT_GT(defect_of_step(StepRule::imposed, stages), 1e-6);
  }
}

/// The largest change of the angular momentum that the work of the thrust does not explain, over 30 steps.
double momentum_defect(StepRule rule, const StepFunction& sigma, int stages) {
  const auto problem = make_problem("orbital_transfer");
  const StepControlMap map(*problem, gauss_tableau(stages), sigma, rule);
  From at = state_of(*problem, Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.1, 1.2), 0.0);
  double defect = 0.0;
  for (int k = 0; k < 30; ++k) {
    const Eigen::MatrixXd controls = Eigen::MatrixXd::Constant(stages, 1, 0.1 * std::sin(7.3 * k));
    const Step step = map.advance(at, controls, 0.05);
    defect = std::max(defect, std::abs(step.end.p[1] - at.p[1] - step.impulse[1]));
    at = step.end;
  }
  return defect;
}

TEST(StepControlMap, BalancesMomentumAgainstForcesWhereTheStepsAreInvariantUnderTheGroup) {
  constexpr double rounding = 1e-13;  // of 30 differences of angles, each divided by its step
  const auto by_radius = [](const ControlledState& x) { return pow(x.q[0], 1.5); };
  const auto by_thrust = [](const ControlledState& x) { return 1.0 / (1.0 + 20.0 * x.u[0] * x.u[0]); };
  for (const int stages : {1, 2}) {
    for (const StepRule rule : {StepRule::variational, StepRule::imposed, StepRule::from_left}) {
      EXPECT_LT(momentum_defect(rule, by_radius, stages), rounding);
      EXPECT_LT(momentum_defect(rule, by_thrust, stages), rounding);
    }
    const auto by_angle = [](const ControlledState& x) { return 2.0 + sin(x.q[1]); };
    EXPECT_GT(momentum_defect(StepRule::variational, by_angle, stages), 1e4 * rounding);
    EXPECT_LT(momentum_defect(StepRule::imposed, by_angle, stages), rounding);
  }
}

/// Runs until the time τ = 1 of the extended system.
Step end_of(const StepControlMap& map, From at, const Eigen::MatrixXd& controls, int steps) {
  Step step;
  for (int k = 0; k < steps; ++k) {
    step = map.advance(at, controls, 1.0 / steps);
    at = step.end;
  }
  return step;
}

TEST(StepControlMap, SolvesThePoincareTransformedHamiltonianWithTheOrderOfTheTableau) {
  // σ (H - E), H = ½|p|² - 1/r, σ = r^(3/2), with an E that is not the energy: q' = σ p, p' = -σ q/r³ - (H - E) ∇σ.
  const tests::CentralForce problem;
  From start = state_of(problem, Eigen::Vector2d(0.6, 0.2), Eigen::Vector2d(-0.3, 1.3), 0.0);
  start.energy += 0.4;
  const auto rate = [&](const std::vector<double>& x, std::vector<double>& x_rate, double /*tau*/) {
    const double r = std::hypot(x[0], x[1]);
    const double sigma = std::pow(r, 1.5);
    const double excess = 0.5 * (x[2] * x[2] + x[3] * x[3]) - 1.0 / r - start.energy;
    x_rate = {sigma * x[2], sigma * x[3], 0.0, 0.0, sigma};
    for (std::size_t i : {0U, 1U}) x_rate[2 + i] = -(sigma / (r * r * r) + 1.5 * excess * sigma / (r * r)) * x[i];
  };
  std::vector<double> exact{start.q[0], start.q[1], start.p[0], start.p[1], 0.0};
  ASSERT_TRUE(integrate<double>(rate, exact, 0.0, 1.0, 0.1, 1e-13));
  const auto error = [&](int stages, int steps) {
    const StepControlMap map(problem, gauss_tableau(stages), distance, StepRule::variational);
    const From end = end_of(map, start, Eigen::MatrixXd::Zero(stages, 2), steps).end;
    Eigen::VectorXd numbers(5);
    numbers << end.q, end.p, end.t;
    return (numbers - Eigen::Map<const Eigen::VectorXd>(exact.data(), 5)).norm();
  };
  for (const int stages : {1, 2}) {
    EXPECT_LT(error(stages, 32), 1e-2);
    EXPECT_NEAR(std::log2(error(stages, 16) / error(stages, 32)), 2.0 * stages, 0.1);
  }
}

TEST(StepControlMap, FollowsForcedMotionsOfATimeDependentSystemWithTheOrderOfTheTableau) {
  const tests::MovingFrame problem;
  const From start = start_of(problem);
  const Eigen::Vector2d u(0.5, -0.8);
  EquationsOfMotion equations{TracedProblem(problem)};
  const auto error = [&](StepRule rule, int stages, int steps) {
    const StepControlMap map(problem, gauss_tableau(stages), of_everything, rule);
    const From end = end_of(map, start, u.transpose().replicate(stages, 1), steps).end;
    std::vector<double> x(start.q.begin(), start.q.end());
    x.insert(x.end(), start.velocity.begin(), start.velocity.end());
    const auto rate = [&](const std::vector<double>& y, std::vector<double>& y_rate, double t) {
      equations.write_rate(y, u, t, y_rate);
    };
    EXPECT_TRUE(integrate<double>(rate, x, 0.0, end.t, 0.1, 1e-13));
    const From exact = state_of(problem, Eigen::Vector2d(x[0], x[1]), Eigen::Vector2d(x[2], x[3]), end.t);
    return (flat(end) - flat(exact)).norm();  // E is the energy of the exact motion
  };
  for (const StepRule rule : {StepRule::variational, StepRule::imposed}) {
    for (const int stages : {1, 2}) {
      EXPECT_NEAR(std::log2(error(rule, stages, 16) / error(rule, stages, 32)), 2.0 * stages, 0.2);
    }
  }
}

TEST(StepControlMap, MultiplierIsTheDiscreteEnergyLessTheAccountAndVanishesWithTheSquareOfThePace) {
  const tests::MovingFrame problem;
  const StepControlMap map(problem, gauss_tableau(1), of_everything, StepRule::variational);
  const auto last = [&](int steps) {
    return std::abs(end_of(map, start_of(problem), Eigen::RowVector2d(0.5, -0.8), steps).multiplier);
  };
  EXPECT_GT(last(32), 1e-8);
  EXPECT_NEAR(std::log2(last(32) / last(64)), 2.0, 0.15);
}

TEST(StepControlMap, RefusesAFunctionThatVanishesOrIsNegativeOrReadsAVelocityThatIsNotKnownYet) {
  const tests::MovingFrame problem;
  for (const double value : {0.0, -0.5}) {
    const auto constant = [value](const ControlledState& /*x*/) { return Expression(value); };
    const StepControlMap map(problem, gauss_tableau(1), constant, StepRule::variational);
    tests::expect_error_naming({"positive", "t = 0"}, [&] {
      static_cast<void>(map.advance(start_of(problem), Eigen::MatrixXd::Zero(1, 2), 0.1));
    });
    tests::expect_error_naming({"positive"},
                               [&] { static_cast<void>(step_times(constant, guessed_motion(problem), 10)); });
  }
  tests::expect_error_naming({"velocity"}, [&] {
    static_cast<void>(StepControlMap(problem, gauss_tableau(1), of_everything, StepRule::from_left));
  });
}

TEST(StepTimes, DivideTheTimeOfAMotionInProportionToTheFunction) {
  // σ = 1 + t from 0 to 1: ∫ dt/σ = log(1 + t), the nodes are 2^(k/N) - 1.
  const tests::DoubleIntegrator problem;
  const auto sigma = [](const ControlledState& x) { return 1.0 + x.t; };
  const StepTimes steps = step_times(sigma, guessed_motion(problem), 4);
  EXPECT_NEAR(steps.pace, std::log(2.0) / 4.0, 1e-8);
  for (int k = 0; k <= 4; ++k) EXPECT_NEAR(steps.times[k], std::exp2(k / 4.0) - 1.0, 1e-7);
}

}  // namespace
}  // namespace dmocbench
