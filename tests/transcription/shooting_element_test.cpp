// Shooting against an integration written out here, and its orders against those that theory gives.

#include "methods/transcription/elements/shooting_element.hpp"

#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/diagnostics/trajectory_error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

/// Steps of an explicit Runge-Kutta method on numbers, along a control that is a polynomial through its stages.
class SteppedByHand {
 public:
  SteppedByHand(const Problem& problem, ExplicitIntegrator method, Tableau tableau)
      : motion_(TracedProblem(problem)), method_(std::move(method)), tableau_(std::move(tableau)) {}

  /// (q, v) after `substeps` steps over an interval of width h from time t; row i of `controls` is U_i.
  Eigen::VectorXd across(Eigen::VectorXd x, const Eigen::MatrixXd& controls, double t, double h, int substeps) {
    const double step = h / substeps;
    for (int k = 0; k < substeps; ++k) {
      Eigen::MatrixXd rates(x.size(), method_.stages());
      for (Eigen::Index i = 0; i < method_.stages(); ++i) {
        const Eigen::VectorXd stage = x + step * rates.leftCols(i) * method_.a.row(i).head(i).transpose();
        const double tau = (k + method_.c[i]) / substeps;
        rates.col(i) = rate(stage, controls.transpose() * lagrange_basis(tableau_.c, tau), t + tau * h);
      }
      x += step * rates * method_.b;
    }
    return x;
  }

 private:
  Eigen::VectorXd rate(const Eigen::VectorXd& x, const Eigen::VectorXd& u, double t) {
    const Eigen::Index n = x.size() / 2;
    Eigen::VectorXd result(2 * n);
    result << x.tail(n), motion_.acceleration(x.head(n), x.tail(n), u, t);
    return result;
  }
  EquationsOfMotion motion_;
  ExplicitIntegrator method_;
  Tableau tableau_;
};

class ShootingRows : public testing::TestWithParam<std::tuple<std::string, std::string, int, int>> {};

TEST_P(ShootingRows, AreTheRatesThatAnIntegrationByHandMisses) {
  const auto& [name, integrator, substeps, stages] = GetParam();
  const auto problem = tests::problem_named(name);
  const Tableau tableau = gauss_tableau(stages);
  Transcription program(*problem,
                        *make_element(shooting_name(shooting_family(Shooting::multiple), integrator, substeps)),
                        tableau, tests::graded_grid(64));
  const auto size = static_cast<Eigen::Index>(program.variable_count());
  const Eigen::VectorXd x = tests::RandomPoints(5).vector(size, 0.5, 1.5);
  Eigen::VectorXd rows(static_cast<Eigen::Index>(program.constraint_count()));
  program.constraints(x, rows);
  const ProgramBlocks& blocks = program.blocks();
  const Eigen::Index n = problem->configuration_size();
  const auto node = [&](Eigen::Index k) {
    Eigen::VectorXd state(2 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      state[i] = x[blocks.unknown(Quantity::configuration).index(i) + k];
      state[n + i] = x[blocks.unknown(Quantity::second).index(i) + k];
    }
    return state;
  };
  SteppedByHand by_hand(*problem, explicit_integrator(integrator), tableau);
  const Eigen::VectorXd times = program.node_times(x);
  for (Eigen::Index k = 0; k < 4; ++k) {
    Eigen::MatrixXd controls(stages, problem->control_size());
    for (Eigen::Index s = 0; s < stages; ++s) {
      for (Eigen::Index i = 0; i < controls.cols(); ++i) {
        controls(s, i) = x[blocks.unknown(Quantity::control, s).index(i) + k];
      }
    }
    const double h = times[k + 1] - times[k];
    const Eigen::VectorXd missed = (node(k + 1) - by_hand.across(node(k), controls, times[k], h, substeps)) / h;
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
      const double row = rows[blocks.row(i < n ? Equation::motion : Equation::second_motion).index(i % n) + k];
      EXPECT_NEAR(row, missed[i], 1e-12 * (1.0 + missed.lpNorm<Eigen::Infinity>() + 1.0 / h));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShootingRows,
                         testing::Combine(testing::Values("orbital_transfer", "two_link_manipulator", "moving_frame"),
                                          testing::ValuesIn(explicit_integrator_names()), testing::Values(1, 3),
                                          testing::Values(1, 2)));

/// The order of the state at the nodes, against the same method on a fine grid.
double order_of_state(const std::string& method, int stages, const std::vector<long long>& grids, long long finest) {
  const tests::MovingFrame problem;
  const Motion& start = tests::common_start(problem);
  const auto motion_on = [&](long long intervals) {
    return tests::solve(problem, {method, stages}, Grid::uniform(intervals), start, 1e-11).trajectory;
  };
  const Trajectory reference = motion_on(finest);
  std::vector<GridError> errors;
  errors.reserve(grids.size());
  for (const long long intervals : grids) {
    errors.push_back({1.0 / static_cast<double>(intervals), trajectory_error(motion_on(intervals), reference).state});
  }
  return fit_order(errors)->order;
}

TEST(Shooting, HasTheSmallerOneOfTheOrdersOfControlAndIntegrator) {
  const auto expect_order = [](double order, double expected) {
    EXPECT_GT(order, expected - 0.25);
    EXPECT_LT(order, expected + 0.25);
  };
  expect_order(order_of_state("multiple_shooting_rk4_1", 1, {16, 32, 64, 128}, 512), 2.0);
  expect_order(order_of_state("multiple_shooting_midpoint_1", 1, {16, 32, 64, 128}, 512), 2.0);
  expect_order(order_of_state("multiple_shooting_midpoint_2", 2, {16, 32, 64, 128}, 512), 2.0);
  expect_order(order_of_state("multiple_shooting_rk4_1", 2, {8, 16, 32, 64}, 256), 4.0);
}

TEST(Shooting, IsSolvedByIntervalsAsByIpopt) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    Transcription program(*problem, *make_element("multiple_shooting_rk4_2"), gauss_tableau(2), Grid::uniform(32));
    const Eigen::VectorXd start = sample(program, tests::common_start(*problem));
    const Solution ours = make_solver("interior_point")->solve(program, start);
    const Solution theirs = make_solver("ipopt")->solve(program, start);
    ASSERT_TRUE(is_solved(ours.status) && is_solved(theirs.status)) << ours.message << theirs.message;
    EXPECT_NEAR(ours.objective, theirs.objective, 1e-9 * std::abs(theirs.objective));
    EXPECT_EQ(read_trajectory(program, ours.primal, ours.multipliers).has_stage_costates(), false);
  }
}

TEST(Shooting, RefusesANameWithoutSubstepsOrWithTooManyInASentence) {
  using tests::sentence_of_error;
  EXPECT_PRED2(tests::says, sentence_of_error([] { static_cast<void>(make_element("multiple_shooting_rk4")); }),
               "multiple_shooting_rk4_1");
  EXPECT_PRED2(tests::says, sentence_of_error([] { static_cast<void>(make_element("multiple_shooting_rk4_0")); }),
               "1 to 64");
  EXPECT_PRED2(tests::says, sentence_of_error([] { static_cast<void>(make_element("multiple_shooting_rk4_65")); }),
               "1 to 64");
  EXPECT_PRED2(tests::says, sentence_of_error([] { static_cast<void>(make_element("multiple_shooting_euler_1")); }),
               "rk4, midpoint");
}

}  // namespace
}  // namespace dmocbench
