#include "methods/diagnostics/steps_of_intervals.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/motions/grid.hpp"
#include "tests/support/problems_for_tests.hpp"

namespace dmocbench {
namespace {

/// Intervals of the double integrator whose controls grow linearly within each, from states that do not fit together.
Trajectory torn_motion(Eigen::Index intervals, double horizon) {
  Trajectory motion;
  motion.tableau = gauss_tableau(2);
  motion.node_times = Eigen::VectorXd::LinSpaced(intervals + 1, 0.0, horizon);
  motion.q = motion.node_times.array().sin();
  motion.v = motion.node_times.array().cos();
  motion.y.resize(intervals + 1, 0);
  motion.stage_u.resize(2 * intervals, 1);
  for (Eigen::Index k = 0; k < intervals; ++k) {
    for (Eigen::Index i = 0; i < 2; ++i)
      motion.stage_u(2 * k + i, 0) = 1.0 + static_cast<double>(k) * motion.tableau.c[i];
  }
  return motion;
}

TEST(StepsOfIntervals, AreExactUnderALinearForce) {
  const tests::DoubleIntegrator problem;
  const StepsOfIntervals steps{TracedProblem(problem)};
  const Trajectory motion = torn_motion(7, 3.5);
  constexpr double h = 0.5;
  const Eigen::MatrixXd ends = steps.ends(motion, 2, 4, 1e-12);
  ASSERT_EQ(ends.cols(), 4);
  for (Eigen::Index i = 0; i < 4; ++i) {
    const Eigen::Index k = 2 + i;
    const double slope = static_cast<double>(k) / h;  // u = 1 + slope (t - t_k)
    const double v = motion.v(k, 0);
    EXPECT_NEAR(ends(0, i), motion.q(k, 0) + h * (v + h * (0.5 + slope * h / 6.0)), 1e-14);
    EXPECT_NEAR(ends(1, i), v + h * (1.0 + 0.5 * slope * h), 1e-14);
  }
}

/// q̈ = q̇² leads from q̇ = 4 to infinity within the interval, and nowhere from rest.
TEST(StepsOfIntervals, AreNotNumbersWhereOneStepIsTooFewAndOnlyThere) {
  const tests::BlowUp problem(4.0);
  const StepsOfIntervals steps{TracedProblem(problem)};
  Trajectory motion = torn_motion(2, 4.0);
  motion.stage_u.setZero();
  motion.q.setZero();
  motion.v << 0.0, 4.0, 0.0;
  const Eigen::MatrixXd ends = steps.ends(motion, 0, 2, 1e-12);
  EXPECT_EQ(ends.col(0).norm(), 0.0);
  EXPECT_TRUE(std::isnan(ends(0, 1)));
}

}  // namespace
}  // namespace dmocbench
