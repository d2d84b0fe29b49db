#include <gtest/gtest.h>

#include "bench/experiments/kkt_eigenvalues.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

using tests::HyperDual;
using tests::HyperVector;

/// minimise ½(x² + (y/unit)²) such that x + y/unit = 1, with y at most `most`.
tests::SmallProgram half_of_squares(double unit, double most = unbounded) {
  return tests::SmallProgram({
      .objective =
          [unit](const HyperVector& x) {
            const HyperDual y = x[1] * HyperDual(1.0 / unit);
            return HyperDual(0.5) * (x[0] * x[0] + y * y);
          },
      .rows = [unit](const HyperVector& x) { return HyperVector{x[0] + x[1] * HyperDual(1.0 / unit)}; },
      .variable_lower = Eigen::Vector2d(-unbounded, -unbounded),
      .variable_upper = Eigen::Vector2d(unbounded, most),
      .row_lower = Eigen::VectorXd::Ones(1),
      .row_upper = Eigen::VectorXd::Ones(1),
  });
}

Solution optimum_of(double unit) {
  Solution solution;
  solution.primal = Eigen::Vector2d(0.5, 0.5 * unit);
  solution.multipliers = Eigen::VectorXd::Constant(1, -0.5);
  return solution;
}

TEST(KktCondition, IsThatOfTheMatrixInAnyUnits) {
  // (1, 0, 1; 0, 1, 1; 1, 1, 0) has the eigenvalues 2, 1 and -1.
  for (const double unit : {1.0, 1e3, 1e-5}) {
    tests::SmallProgram program = half_of_squares(unit);
    EXPECT_NEAR(tests::value_of(kkt_condition(program, optimum_of(unit))), 2.0, 1e-6) << unit;
  }
}

TEST(KktCondition, RefusesAnActiveBoundInASentence) {
  tests::SmallProgram program = half_of_squares(1.0, 0.5);
  tests::expect_error_naming({"a bound is active"},
                             [&] { static_cast<void>(kkt_condition(program, optimum_of(1.0))); });
}

}  // namespace
}  // namespace dmocbench
