// Optimal control problems with a solution in closed form, through every transcription.

#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/elements/families.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

TEST(DoubleIntegrator, HasTheDiscreteOptimumOfTheMidpointRuleInClosedForm) {
  // min ½hΣu² with hΣu = 0 and hΣu_k(1 - t_{k+½}) = 1: u ∝ ½ - t and J = ½ / (hΣ(½ - t)²) = 6 / (1 - h²).
  const tests::DoubleIntegrator problem;
  for (const std::string& method : paper_families()) {
    std::vector<GridError> errors;
    for (const int intervals : {2, 4, 8, 16, 32}) {
      const Trajectory trajectory =
          tests::solve(problem, {method, 1}, Grid::uniform(intervals), guessed_motion(problem)).trajectory;
      const double h = 1.0 / intervals;
      EXPECT_NEAR(trajectory.cost, 6.0 / (1.0 - h * h), 1e-8) << method << ", N = " << intervals;
      if (intervals >= 8) errors.push_back({h, trajectory.cost - 6.0});
    }
    EXPECT_NEAR(fit_order(errors)->order, 2.0, 0.02) << method;
  }
}

TEST(DoubleIntegrator, IsSolvedExactlyByMoreStages) {
  // u is linear in t, q cubic: Gauss with two stages has both at its points.
  const tests::DoubleIntegrator problem;
  for (const std::string& method : paper_families()) {
    for (const int s : {2, 3}) {
      const Trajectory trajectory =
          tests::solve(problem, {method, s}, tests::graded_grid(5), guessed_motion(problem)).trajectory;
      EXPECT_NEAR(trajectory.cost, 6.0, 1e-8) << method << ", s = " << s;
      for (Eigen::Index k = 0; k <= 5; ++k) {
        const double t = trajectory.node_times[k];
        EXPECT_NEAR(trajectory.q(k, 0), 3.0 * t * t - 2.0 * t * t * t, 1e-9);
        EXPECT_NEAR(trajectory.v(k, 0), 6.0 * t - 6.0 * t * t, 1e-9);
      }
      for (Eigen::Index row = 0; row < trajectory.stage_times.size(); ++row) {
        EXPECT_NEAR(trajectory.stage_u(row, 0), 6.0 - 12.0 * trajectory.stage_times[row], 1e-8);
      }
    }
  }
}

TEST(HarmonicOscillator, NeedsNoControlBetweenTheEndsOfAFreeMotion) {
  // The discrete free motion misses the end by O(h^{2s}); so does the control, and the cost by its square.
  const tests::HarmonicOscillator problem;
  for (const std::string& method : paper_families()) {
    std::vector<GridError> errors;
    for (const int intervals : {8, 16, 32}) {
      const Trajectory trajectory =
          tests::solve(problem, {method, 1}, Grid::uniform(intervals), guessed_motion(problem), 1e-12).trajectory;
      errors.push_back({1.0 / intervals, trajectory.stage_u.lpNorm<Eigen::Infinity>()});
    }
    EXPECT_NEAR(fit_order(errors)->order, 2.0, 0.1) << method;
  }
}

/// Rounding in the narrow interval is 4e-8, and a hundred times less would be a failure elsewhere.
TEST(NarrowInterval, IsSolvedAndExcusesNoErrorInOtherIntervals) {
  const tests::DoubleIntegrator problem;
  for (const std::string& method : paper_families()) {
    const auto program = tests::transcribe(problem, {method, 1}, tests::grid_with_a_narrow_interval());
    ASSERT_LT(program->rounding_floors().smallest, 1e-12);
    for (const char* solver : {"ipopt", "interior_point", "sqp"}) {
      SCOPED_TRACE(method + " by " + solver);
      const Solution solution = make_solver(solver)->solve(*program, sample(*program, guessed_motion(problem)));
      ASSERT_EQ(solution.status, Status::solved) << solution.message;
      EXPECT_NEAR(solution.objective, 6.0 / (1.0 - 1.0 / 256.0), 1e-4);
      Solution spoilt = solution;
      spoilt.primal[3] += 1e-8;  // q of a node elsewhere
      confirm(*program, 1e-10, spoilt);
      EXPECT_EQ(spoilt.status, Status::not_confirmed);
    }
  }
}

}  // namespace
}  // namespace dmocbench
