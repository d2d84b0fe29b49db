// Shooting by the map of DMOC against DMOC itself, and its derivatives against differences.

#include "methods/transcription/elements/dmoc_shooting_element.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "methods/judgement/polish.hpp"
#include "methods/transcription/single_shooting.hpp"
#include "problems/registry.hpp"
#include "tests/support/all_problems.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

constexpr const char* by_nodes = "multiple_shooting_dmoc_1";
constexpr const char* by_controls = "single_shooting_dmoc_1";

/// The largest difference of two tables, relative to the second.
double difference_of(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

struct DmocScheme {
  const char* problem;
  int stages;
  long long intervals;
};

class ShootingByDmoc : public testing::TestWithParam<DmocScheme> {
 protected:
  std::unique_ptr<Problem> problem_ = tests::problem_named(GetParam().problem);
  Grid grid_ = tests::graded_grid(GetParam().intervals);

  [[nodiscard]] tests::Solved solved(const std::string& method) const {
    tests::Solved answer =
        tests::solve(*problem_, tests::Scheme{method, GetParam().stages}, grid_, tests::common_start(*problem_), 1e-9);
    refine(answer);
    return answer;
  }
  /// Newton steps to rounding.
  static void refine(tests::Solved& answer) {
    static_cast<void>(polish(*answer.transcription, answer.solution));
    answer.trajectory = read_trajectory(*answer.transcription, answer.solution.primal, answer.solution.multipliers);
  }
};

TEST_P(ShootingByDmoc, HasTheSolutionOfDmocInOtherUnknowns) {
  const tests::Solved dmoc = solved("dmoc");
  const tests::Solved shooting = solved(by_nodes);
  EXPECT_NEAR(shooting.trajectory.cost, dmoc.trajectory.cost, 1e-12 * std::abs(dmoc.trajectory.cost));
  EXPECT_LT(difference_of(shooting.trajectory.stage_u, dmoc.trajectory.stage_u), 1e-9);
  EXPECT_LT(difference_of(shooting.trajectory.q, dmoc.trajectory.q), 1e-11);
  EXPECT_LT(difference_of(shooting.trajectory.p, dmoc.trajectory.p), 1e-10);
  EXPECT_LT(difference_of(shooting.trajectory.psi_p, dmoc.trajectory.psi_p), 1e-8);
}

TEST_P(ShootingByDmoc, HasItByItsControlsAloneToo) {
  const tests::Solved dmoc = solved("dmoc");
  tests::Solved answer{tests::transcribe(*problem_, tests::Scheme{by_controls, GetParam().stages}, grid_), {}, {}};
  SingleShooting condensed(*answer.transcription);
  const Eigen::VectorXd start = sample(*answer.transcription, tests::common_start(*problem_));
  SolverOptions options;
  options.tolerance = 1e-9;
  answer.solution = condensed.expanded(make_solver("ipopt", options)->solve(condensed, condensed.reduced(start)));
  ASSERT_TRUE(is_solved(answer.solution.status)) << answer.solution.message;
  refine(answer);
  EXPECT_NEAR(answer.trajectory.cost, dmoc.trajectory.cost, 1e-12 * std::abs(dmoc.trajectory.cost));
  EXPECT_LT(difference_of(answer.trajectory.stage_u, dmoc.trajectory.stage_u), 1e-9);
}

/// First and second derivatives of the implicit function: Newton steps that were too few would leave them wrong.
TEST_P(ShootingByDmoc, HasTheDerivativesThatDifferencesShow) {
  const auto program = tests::transcribe(*problem_, tests::Scheme{by_nodes, GetParam().stages}, grid_);
  Eigen::VectorXd x = sample(*program, tests::common_start(*problem_));
  x += 1e-3 * tests::RandomPoints(3).vector(x.size(), -1.0, 1.0);
  const auto rows = static_cast<Eigen::Index>(program->constraint_count());
  const Eigen::VectorXd multipliers = tests::RandomPoints(7).vector(rows, -1.0, 1.0);
  const auto slope_at = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd gradient(at.size());
    program->gradient(at, gradient);
    Eigen::VectorXd entries(static_cast<Eigen::Index>(program->jacobian_structure().size()));
    program->jacobian(at, entries);
    program->jacobian_structure().for_each(
        [&](Eigen::Index entry, int row, int column) { gradient[column] += multipliers[row] * entries[entry]; });
    return gradient;
  };
  const auto lagrangian_at = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd values(rows);
    program->constraints(at, values);
    return program->objective(at) + multipliers.dot(values);
  };
  const Eigen::VectorXd direction = tests::RandomPoints(11).vector(x.size(), -1.0, 1.0);
  const auto along = [&]<class Value>(const std::function<Value(const Eigen::VectorXd&)>& function) -> Value {
    const auto central = [&](double e) -> Value {
      return (function(x + e * direction) - function(x - e * direction)) / (2.0 * e);
    };
    constexpr double step = 1e-4;
    return (4.0 * central(step / 2.0) - central(step)) / 3.0;
  };
  const Eigen::VectorXd slope = slope_at(x);
  ASSERT_TRUE(slope.allFinite());
  EXPECT_NEAR(along(std::function<double(const Eigen::VectorXd&)>(lagrangian_at)), slope.dot(direction),
              1e-8 * slope.norm() * direction.norm());
  Eigen::VectorXd entries(static_cast<Eigen::Index>(program->hessian_structure().size()));
  program->hessian(x, 1.0, multipliers, entries);
  Eigen::VectorXd curvature = Eigen::VectorXd::Zero(x.size());
  program->hessian_structure().for_each([&](Eigen::Index entry, int row, int column) {
    curvature[row] += entries[entry] * direction[column];
    if (row != column) curvature[column] += entries[entry] * direction[row];
  });
  const Eigen::VectorXd difference = along(std::function<Eigen::VectorXd(const Eigen::VectorXd&)>(slope_at));
  EXPECT_LT((difference - curvature).norm(), 1e-7 * curvature.norm());
}

INSTANTIATE_TEST_SUITE_P(All, ShootingByDmoc,
                         testing::Values(DmocScheme{"orbital_transfer", 1, 16}, DmocScheme{"orbital_transfer", 1, 32},
                                         DmocScheme{"two_link_manipulator", 1, 16},
                                         DmocScheme{"two_link_manipulator", 1, 32},
                                         DmocScheme{"two_link_manipulator", 2, 16}, DmocScheme{"moving_frame", 1, 16}));

TEST(ShootingByDmocElement, IsNotANumberWhereItsStepIsNotSolved) {
  // The arms turn by several revolutions within an interval: no step of Newton's method leads there.
  const auto problem = make_problem("two_link_manipulator");
  const auto program = tests::transcribe(*problem, tests::Scheme{by_nodes, 1}, Grid::uniform(16));
  Eigen::VectorXd x = sample(*program, guessed_motion(*problem));
  Eigen::VectorXd rows(static_cast<Eigen::Index>(program->constraint_count()));
  program->constraints(x, rows);
  EXPECT_TRUE(rows.allFinite());
  for (const Eigen::Index i : {0, 1}) {
    x.segment(static_cast<Eigen::Index>(program->layout().second_head(i)), 17).setConstant(i == 0 ? 300.0 : -200.0);
  }
  program->constraints(x, rows);
  EXPECT_TRUE(rows.hasNaN());
}

TEST(ShootingByDmocElement, TakesOneStepPerInterval) {
  tests::expect_error_naming({"dmoc", "one step"}, [] { static_cast<void>(make_element("multiple_shooting_dmoc_2")); });
  EXPECT_EQ(make_element(by_controls)->name(), by_controls);
}

}  // namespace
}  // namespace dmocbench
