#include "problems/forced_oscillator.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/transcription/elements/families.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

using std::numbers::pi;

TEST(ForcedOscillator, AcceleratesByTheSpringAndTheControl) {
  const ForcedOscillator problem;
  EquationsOfMotion motion{TracedProblem(problem)};
  for (const double q : {-1.0, 0.3}) {
    for (const double u : {-0.5, 2.0}) {
      const auto one = [](double value) { return Eigen::VectorXd::Constant(1, value); };
      EXPECT_NEAR(motion.acceleration(one(q), one(0.7), one(u), 0.0)[0], u - q, 1e-15);
    }
  }
}

TEST(ForcedOscillator, HasAConstantMass) {
  const ForcedOscillator problem;
  const TracedProblem traced(problem);
  const TracedProblem::Values values = traced.at(State{input_vector(0, 1), input_vector(1, 1), Expression::input(2)});
  EXPECT_TRUE(values.mass(0, 0).is_same(Expression(1.0)));
  EXPECT_TRUE(values.momentum_by_configuration(0, 0).is_zero());
}

TEST(ForcedOscillator, ApproachesItsOptimumWithTwiceTheNumberOfStages) {
  const ForcedOscillator problem;
  for (const std::string& method : paper_families()) {
    for (const int stages : {1, 2, 3}) {
      std::vector<GridError> errors;
      for (const Eigen::Index intervals : {4, 6, 8, 12}) {
        const Trajectory motion =
            tests::solve(problem, {method, stages}, Grid::uniform(intervals), guessed_motion(problem)).trajectory;
        errors.push_back({pi / static_cast<double>(intervals), std::abs(motion.cost - 1.0 / pi)});
      }
      const auto order = tests::value_of(fit_order(errors));
      EXPECT_NEAR(order.order, 2.0 * stages, 0.25) << method << ", s = " << stages;
    }
  }
}

TEST(ForcedOscillator, MovesAndIsDrivenAsTheClosedFormSays) {
  const ForcedOscillator problem;
  const Trajectory motion = tests::solve(problem, {"dmoc", 4}, Grid::uniform(16), guessed_motion(problem)).trajectory;
  for (Eigen::Index k = 0; k <= motion.intervals(); ++k) {
    const double t = motion.node_times[k];
    EXPECT_NEAR(motion.q(k, 0), (std::sin(t) - t * std::cos(t)) / pi, 1e-9);
    // H_u = u + ψ_p = 0, and ψ̇_p = -ψ_q.
    EXPECT_NEAR(motion.psi_p(k, 0), -2.0 / pi * std::sin(t), 1e-8);
    EXPECT_NEAR(motion.psi_q(k, 0), 2.0 / pi * std::cos(t), 1e-8);
  }
}

}  // namespace
}  // namespace dmocbench
