#include "methods/diagnostics/replay_error.hpp"

#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

/// A trajectory that says nothing but the controls u(t) at the stages: all that a replay may look at.
Trajectory controls_alone(const Problem& problem, int stages, const Grid& grid,
                          const std::function<double(double)>& u) {
  const auto program = tests::transcribe(problem, {"dmoc", stages}, grid);
  Trajectory trajectory = read_trajectory(*program, sample(*program, guessed_motion(problem)), Eigen::VectorXd());
  for (Eigen::Index row = 0; row < trajectory.stage_u.rows(); ++row) {
    trajectory.stage_u.row(row).setConstant(u(trajectory.stage_times[row]));
  }
  trajectory.q.setConstant(99.0);
  trajectory.v.setConstant(99.0);
  return trajectory;
}

TEST(ReplayError, VanishesForTheControlsOfKnownMotions) {
  const tests::HarmonicOscillator oscillator(3.0);
  const auto nothing = [](double) { return 0.0; };
  EXPECT_LT(replay_error(oscillator, controls_alone(oscillator, 1, Grid::uniform(7), nothing)).norm(), 1e-11);
  // Two stages carry the optimal line 6 - 12t of the double integrator exactly.
  const tests::DoubleIntegrator integrator;
  const auto optimum = [](double t) { return 6.0 - 12.0 * t; };
  const Trajectory optimal = controls_alone(integrator, 2, tests::graded_grid(5), optimum);
  EXPECT_LT(replay_error(integrator, optimal).norm(), 1e-11);
}

TEST(ReplayError, IsTheDistanceFromThePrescribedEnd) {
  // Without control the double integrator rests at 0, one away from its end; with u = 1 it passes ½ with velocity 1.
  const tests::DoubleIntegrator problem;
  const auto replay = [&](double u) {
    return replay_error(problem, controls_alone(problem, 1, Grid::uniform(4), [u](double) { return u; }));
  };
  EXPECT_NEAR(replay(0.0).configuration, 1.0, 1e-12);
  EXPECT_NEAR(replay(0.0).velocity, 0.0, 1e-12);
  EXPECT_NEAR(replay(1.0).configuration, 0.5, 1e-12);
  EXPECT_NEAR(replay(1.0).velocity, 1.0, 1e-12);
  EXPECT_NEAR(replay(1.0).norm(), std::sqrt(1.25), 1e-12);
}

TEST(ReplayError, FallsAsTheOrderOfTheMethodPredicts) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    for (const std::string& method : paper_families()) {
      std::vector<GridError> errors;
      for (const int intervals : {64, 128, 256}) {
        const Trajectory trajectory =
            tests::solve(*problem, {method, 1}, Grid::uniform(intervals), tests::common_start(*problem)).trajectory;
        errors.push_back({1.0 / intervals, replay_error(*problem, trajectory).norm()});
      }
      EXPECT_NEAR(fit_order(errors)->order, 2.0, 0.2) << name << ", " << method;
    }
  }
}

TEST(ReplayError, KnowsTheTimeThatALagrangianDependsOn) {
  const tests::MovingFrame problem;
  for (const std::string& method : paper_families()) {
    std::vector<GridError> errors;
    for (const int intervals : {16, 32, 64}) {
      const Trajectory trajectory =
          tests::solve(problem, {method, 1}, Grid::uniform(intervals), tests::common_start(problem)).trajectory;
      errors.push_back({1.0 / intervals, replay_error(problem, trajectory).norm()});
    }
    EXPECT_NEAR(fit_order(errors)->order, 2.0, 0.2) << method;
  }
}

/// A free mass whose place costs: C = q².
class CostlyPlace final : public tests::SmallProblem {
 public:
  CostlyPlace() : SmallProblem("costly_place", at(0.0, 0.0), at(1.0, 0.0), 2.0, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.q[0] * x.q[0]; }
};

TEST(CostByIntervals, BeginsEveryIntervalAtItsOwnNode) {
  const CostlyPlace problem;
  Trajectory torn = controls_alone(problem, 1, Grid::uniform(4), [](double) { return 0.0; });
  torn.v.setZero();
  torn.q.col(0) << 1.0, -2.0, 3.0, 0.5, 7.0;  // each place is kept for half a second, the last for none
  EXPECT_NEAR(cost_by_intervals(problem, torn), 0.5 * (1.0 + 4.0 + 9.0 + 0.25), 1e-11);
}

TEST(ReplayError, ThrowsWhereTheMotionEndsBeforeTheHorizon) {
  const tests::BlowUp problem(2.0);
  tests::expect_error_naming({"exact motion", "between t = 0.5 and 0.625"}, [&] {
    static_cast<void>(replay_error(problem, controls_alone(problem, 1, Grid::uniform(8), [](double) { return 0.0; })));
  });
}

}  // namespace
}  // namespace dmocbench
