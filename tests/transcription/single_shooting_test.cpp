// The condensed program against the one that it condenses.

#include "methods/transcription/single_shooting.hpp"

#include <gtest/gtest.h>

#include "methods/judgement/kkt_residual.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

/// A program of shooting with what condenses it.
struct Condensed {
  std::unique_ptr<Problem> problem;
  Transcription full;
  SingleShooting program;

  explicit Condensed(const std::string& name, int stages = 2, long long intervals = 12)
      : problem(tests::problem_named(name)),
        full(*problem, *make_element("single_shooting_rk4_1"), gauss_tableau(stages), Grid::uniform(intervals)),
        program(full) {}

  /// Unknowns near those of the guess.
  [[nodiscard]] Eigen::VectorXd point() {
    Eigen::VectorXd x = program.reduced(sample(full, guessed_motion(*problem)));
    return x + 0.01 * tests::RandomPoints(3).vector(x.size(), -1.0, 1.0);
  }
};

/// Φ + λᵀa of a program.
double lagrangian(NonlinearProgram& program, const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers) {
  Eigen::VectorXd rows(static_cast<Eigen::Index>(program.constraint_count()));
  program.constraints(x, rows);
  return program.objective(x) + multipliers.dot(rows);
}

class SingleShootingOf : public testing::TestWithParam<std::string> {};

TEST_P(SingleShootingOf, HasTheDerivativesThatDifferencesShow) {
  Condensed condensed(GetParam());
  SingleShooting& program = condensed.program;
  const Eigen::VectorXd x = condensed.point();
  const auto count = static_cast<Eigen::Index>(program.constraint_count());
  const Eigen::VectorXd multipliers = tests::RandomPoints(7).vector(count, -1.0, 1.0);
  const auto gradient_at = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd gradient(at.size());
    program.gradient(at, gradient);
    Eigen::VectorXd entries(static_cast<Eigen::Index>(program.jacobian_structure().size()));
    program.jacobian(at, entries);
    program.jacobian_structure().for_each(
        [&](Eigen::Index entry, int row, int column) { gradient[column] += multipliers[row] * entries[entry]; });
    return gradient;
  };
  const Eigen::VectorXd gradient = gradient_at(x);
  ASSERT_TRUE(gradient.allFinite());
  Eigen::VectorXd entries(static_cast<Eigen::Index>(program.hessian_structure().size()));
  program.hessian(x, 1.0, multipliers, entries);
  Eigen::MatrixXd hessian(x.size(), x.size());
  program.hessian_structure().for_each([&](Eigen::Index entry, int row, int column) {
    hessian(row, column) = entries[entry];
    hessian(column, row) = entries[entry];  // NOLINT(readability-suspicious-call-argument): mirrored
  });
  constexpr double step = 1e-5;
  const double scale = 1.0 + gradient.lpNorm<Eigen::Infinity>();
  const double curvature = 1.0 + hessian.lpNorm<Eigen::Infinity>();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::VectorXd move = step * Eigen::VectorXd::Unit(x.size(), i);
    const double difference =
        (lagrangian(program, x + move, multipliers) - lagrangian(program, x - move, multipliers)) / (2.0 * step);
    EXPECT_NEAR(difference, gradient[i], 1e-6 * scale);
    const Eigen::VectorXd column = (gradient_at(x + move) - gradient_at(x - move)) / (2.0 * step);
    EXPECT_LT((column - hessian.col(i)).lpNorm<Eigen::Infinity>(), 1e-6 * curvature);
  }
}

TEST_P(SingleShootingOf, ExpandsItsSolutionToThatOfMultipleShooting) {
  Condensed condensed(GetParam(), 2, 32);
  const Motion& start = tests::common_start(*condensed.problem);
  const Eigen::VectorXd full_start = sample(condensed.full, start);
  const auto solver = make_solver("ipopt");
  const Solution single =
      condensed.program.expanded(solver->solve(condensed.program, condensed.program.reduced(full_start)));
  ASSERT_TRUE(is_solved(single.status)) << single.message;
  const Solution multiple = solver->solve(condensed.full, full_start);
  ASSERT_TRUE(is_solved(multiple.status)) << multiple.message;
  EXPECT_NEAR(single.objective, multiple.objective, 1e-9 * std::abs(multiple.objective));
  EXPECT_LT((single.primal - multiple.primal).lpNorm<Eigen::Infinity>(),
            1e-6 * multiple.primal.lpNorm<Eigen::Infinity>());
  const KktResidual residual = kkt_residual(condensed.full, single.primal, single.multipliers);
  EXPECT_LT(residual.stationarity, 1e-7);
  EXPECT_LT(residual.constraint_violation, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, SingleShootingOf,
                         testing::Values("orbital_transfer", "two_link_manipulator", "moving_frame"));

TEST(SingleShooting, HasTheControlsAsUnknownsAndTheFinalStateAsConstraints) {
  const Condensed condensed("two_link_manipulator", 1, 16);
  EXPECT_EQ(free_variable_count(condensed.program), 2U * 16U);
  EXPECT_EQ(condensed.program.constraint_count(), 4U);
}

TEST(SingleShooting, SaysThatItIsUndefinedWhereTheSimulationLeavesTheDomain) {
  // Large controls drive the relativistic particle beyond the speed of light.
  Condensed condensed("relativistic_spring", 1, 8);
  const Eigen::VectorXd x =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(condensed.program.variable_count()), 1e3);
  EXPECT_TRUE(std::isnan(condensed.program.objective(x)));
}

TEST(SingleShooting, RefusesProgramsWithUnknownStagesInASentence) {
  const auto problem = make_problem("two_link_manipulator");
  Transcription program(*problem, *make_element("dmoc"), gauss_tableau(1), Grid::uniform(8));
  EXPECT_NE(tests::sentence_of_error([&] { const SingleShooting condensed(program); }).find("multiple shooting"),
            std::string::npos);
}

}  // namespace
}  // namespace dmocbench
