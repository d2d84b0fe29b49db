#include "methods/diagnostics/leading_errors.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "methods/diagnostics/replay_error.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

/// The exact optimum near the common start of a problem.
IndirectSolution exact_optimum(const Problem& problem) {
  const Motion& start = tests::common_start(problem);
  return solve_indirect(problem, tests::confirmed(problem, {"dmoc", 2}, 48, start, 1e-10).motion);
}

/// (q, v) of a replay's miss, and the error of the cost.
Eigen::VectorXd measured_errors(const Problem& problem, const Trajectory& discrete, double cost) {
  const ReplayError replay = replay_error(problem, discrete);
  Eigen::VectorXd errors(replay.q.size() + replay.v.size() + 1);
  errors << replay.q, replay.v, discrete.cost - cost;
  return errors;
}

Eigen::VectorXd predicted_errors(const Problem& problem, const std::string& method, const Trajectory& optimum) {
  const LeadingErrors leading = leading_errors(problem, *make_element(method), optimum);
  Eigen::VectorXd errors(leading.replay.size() + 1);
  errors << leading.replay, leading.cost;
  return errors;
}

TEST(LeadingErrors, AreThoseOfTheDiscreteOptimumUpToHigherOrdersForEveryComponent) {
  for (const char* name : {"spherical_pendulum", "two_link_manipulator"}) {
    const auto problem = make_problem(name);
    const IndirectSolution exact = exact_optimum(*problem);
    for (const auto& [method, stages] : {std::pair("dmoc", 1),
                                         {"tangent", 1},
                                         {"second_order", 1},
                                         {"dmoc", 2},
                                         {"tangent", 2},
                                         {"second_order", 2}}) {
      SCOPED_TRACE(std::string(name) + " " + method + " s = " + std::to_string(stages));
      const auto relative_difference = [&, method = method, stages = stages](Eigen::Index intervals) {
        const Trajectory discrete =
            tests::confirmed(*problem, {method, stages}, intervals, tests::common_start(*problem), 1e-10).motion;
        const Eigen::VectorXd measured = measured_errors(*problem, discrete, exact.cost());
        const Eigen::VectorXd predicted = predicted_errors(*problem, method, exact.sampled_like(discrete));
        return ((predicted - measured).array() / measured.array()).abs().maxCoeff();
      };
      const Eigen::Index finest = stages == 1 ? 512 : 128;
      EXPECT_GT(std::log2(relative_difference(finest / 2) / relative_difference(finest)), 1.5);
    }
  }
}

TEST(LeadingErrors, AreThoseOfTheFlowThatHamiltonianCollocationSharesWithDmoc) {
  const auto problem = make_problem("two_link_manipulator");
  const IndirectSolution exact = exact_optimum(*problem);
  const Trajectory grid = tests::confirmed(*problem, {"dmoc", 1}, 64, tests::common_start(*problem), 1e-10).motion;
  const Trajectory optimum = exact.sampled_like(grid);
  const Eigen::VectorXd dmoc = predicted_errors(*problem, "dmoc", optimum);
  EXPECT_LT((predicted_errors(*problem, "hamiltonian", optimum) - dmoc).norm(), 1e-9 * dmoc.norm());
  EXPECT_GT((predicted_errors(*problem, "tangent", optimum) - dmoc).norm(), 0.1 * dmoc.norm());
}

TEST(LeadingErrors, OfTheCostOfTheDoubleIntegratorHaveTheClosedForm) {
  // The least cost by the midpoint rule with N steps is 6 N^2 / (N^2 - 1), to second order 6 (1 + 1 / N^2).
  const auto problem = make_problem("double_integrator");
  const IndirectSolution exact = exact_optimum(*problem);
  for (const Eigen::Index n : {16, 32}) {
    const Trajectory discrete = tests::confirmed(*problem, {"dmoc", 1}, n, tests::common_start(*problem), 1e-12).motion;
    const double square = static_cast<double>(n * n);
    EXPECT_NEAR(discrete.cost, 6.0 * square / (square - 1.0), 1e-9);
    const double predicted = leading_errors(*problem, *make_element("dmoc"), exact.sampled_like(discrete)).cost;
    EXPECT_NEAR(predicted * square, 6.0, 10.0 / square);
  }
}

}  // namespace
}  // namespace dmocbench
