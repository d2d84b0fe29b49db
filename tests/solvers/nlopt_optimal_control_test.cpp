// SLSQP and Ipopt on the problems of the paper.

#include <cmath>

#include <gtest/gtest.h>

#include "methods/judgement/kkt_residual.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

class SlsqpAndIpopt : public testing::TestWithParam<std::string> {};

TEST_P(SlsqpAndIpopt, FindTheSameOptimumFromTheCommonStart) {
  const auto problem = make_problem(GetParam());
  const Motion& start = tests::common_start(*problem);
  for (const std::string& method : paper_families()) {
    for (const int intervals : {8, 16, 32}) {
      SCOPED_TRACE(method + ", N = " + std::to_string(intervals));
      const tests::Solved reference = tests::solve(*problem, {method, 1}, Grid::uniform(intervals), start);
      const Solution solution =
          make_solver("nlopt")->solve(*reference.transcription, sample(*reference.transcription, start));
      EXPECT_NEAR(solution.objective, reference.solution.objective, 1e-6 * std::abs(reference.solution.objective));
      EXPECT_LT(solution.constraint_violation.value_or(unbounded), 1e-9);
      EXPECT_LT((solution.primal - reference.solution.primal).lpNorm<Eigen::Infinity>(), 1e-5);
      EXPECT_TRUE(solution.multipliers_are_estimated);
      // Rounding may stop it before the tolerance (see its header), which it must then admit.
      EXPECT_LT(solution.kkt_residual.value_or(unbounded), is_solved(solution.status) ? 1e-8 : 1e-3);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Problems, SlsqpAndIpopt, testing::ValuesIn(paper_problem_names()),
                         [](const auto& problem) { return problem.param; });

TEST(LeastSquaresMultipliers, AreThoseOfIpoptAtItsAnswer) {
  const auto problem = make_problem("orbital_transfer");
  tests::Solved solved = tests::solve(*problem, {"dmoc", 1}, Grid::uniform(16), tests::common_start(*problem));
  const Solution& solution = solved.solution;
  const Eigen::VectorXd estimated = least_squares_multipliers(*solved.transcription, solution.primal);
  EXPECT_LT((estimated - solution.multipliers).norm(), 1e-8 * solution.multipliers.norm());
  // Least in the sum of squares, so at most √n times Ipopt's in the largest entry.
  const double residual = kkt_residual(*solved.transcription, solution.primal, estimated).stationarity;
  const double size = std::sqrt(static_cast<double>(solution.primal.size()));
  EXPECT_LT(residual, size * solution.kkt_residual.value_or(unbounded) + 1e-11);
}

TEST(EstimatedMultipliers, GiveTheCostates) {
  const auto problem = make_problem("orbital_transfer");
  const Motion& start = tests::common_start(*problem);
  tests::Solved reference = tests::solve(*problem, {"dmoc", 1}, Grid::uniform(16), start);
  Transcription& transcription = *reference.transcription;
  const Solution solution = make_solver("nlopt")->solve(transcription, sample(transcription, start));
  const Trajectory trajectory = read_trajectory(transcription, solution.primal, solution.multipliers);
  ASSERT_TRUE(trajectory.has_costates());
  EXPECT_LT((trajectory.psi_p - reference.trajectory.psi_p).norm(), 1e-5 * reference.trajectory.psi_p.norm());
  EXPECT_LT((trajectory.psi_q - reference.trajectory.psi_q).norm(), 1e-5 * reference.trajectory.psi_q.norm());
}

}  // namespace
}  // namespace dmocbench
