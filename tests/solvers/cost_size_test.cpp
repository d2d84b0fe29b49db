// The cost times any number: an optimum stays one, and nothing else becomes one.
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "methods/judgement/confirm.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/batch/solve_batch.hpp"
#include "methods/solvers/iteration_scope.hpp"
#include "methods/solvers/prepared_solve.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/lane_transcription.hpp"
#include "problems/registry.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::HyperVector;
using tests::Restated;

Restated with_cost_times(double factor, const Problem& problem) {
  return Restated(problem, [&problem, factor](Restated::Statement& s) {
    s.running_cost = [&problem, factor](const ControlledState& x) { return factor * problem.running_cost(x); };
  });
}

/// From `start`, or from the guess where that is empty.
Solution solve(const Problem& problem, const std::string& solver, const Eigen::VectorXd& start = Eigen::VectorXd()) {
  const auto program = tests::transcribe(problem, {"dmoc", 1}, Grid::uniform(12));
  SolverOptions options;
  options.most_iterations = 200;
  return make_solver(solver, options)
      ->solve(*program, start.size() > 0 ? start : Eigen::VectorXd(sample(*program, guessed_motion(problem))));
}

class CostTimes : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

INSTANTIATE_TEST_SUITE_P(ProblemsAndSolvers, CostTimes,
                         testing::Combine(testing::Values("double_integrator", "cart_pole", "double_oscillator"),
                                          testing::Values("ipopt", "interior_point", "auto", "sqp")));

/// Of several local optima any will do: the cost itself, minimised from the answer, has to stay what it is.
TEST_P(CostTimes, APowerOfTenIsSolvedOnlyAtTheOptimalCost) {
  const auto& [name, solver] = GetParam();
  const auto problem = make_problem(name);
  for (int k = -40; k <= 40; k += 4) {
    SCOPED_TRACE(k);
    const double factor = std::pow(10.0, k);
    const Solution solution = solve(with_cost_times(factor, *problem), solver);
    if (is_solved(solution.status)) {
      const double optimum = solve(with_cost_times(1.0, *problem), "ipopt", solution.primal).objective;
      EXPECT_NEAR(solution.objective / factor, optimum, 1e-6 * optimum) << solution.message;
    }
    if (k < -12 && solver != std::string("sqp")) {  // below the tolerance: scaled; sqp may find no step before
      EXPECT_EQ(solution.status, Status::solved) << solution.message;
      EXPECT_NE(solution.message.find("cost_scale"), std::string::npos);
    }
  }
}

TEST(SmallCost, IsRefusedWhereTheProgramIsPrepared) {
  const auto problem = make_problem("double_integrator");
  const Restated tiny = with_cost_times(1e-20, *problem);
  const auto program = tests::transcribe(tiny, {"dmoc", 1}, Grid::uniform(12));
  PreparedSolve prepared(*program);
  const Solution& solution = prepared.solve(sample(*program, guessed_motion(tiny)));
  EXPECT_EQ(solution.status, Status::not_confirmed);
  EXPECT_NE(solution.message.find("cost_scale"), std::string::npos) << solution.message;
}

TEST(SmallCost, IsReportedToAWatchWithoutTheFactorOfASecondSolve) {
  const auto problem = make_problem("double_integrator");
  const Restated tiny = with_cost_times(1e-20, *problem);
  for (const char* solver : {"ipopt", "interior_point", "auto", "sqp"}) {
    double last = 0.0;
    const IterationScope watched([&](const Iteration& iteration) { last = iteration.objective; });
    const Solution solution = solve(tiny, solver);
    ASSERT_EQ(solution.status, Status::solved) << solver << ": " << solution.message;
    EXPECT_NEAR(last, solution.objective, 1e-6 * solution.objective) << solver;
  }
}

TEST(SmallCost, IsSolvedInABatchOnlyAtTheOptimum) {
  const auto problem = make_problem("double_integrator");
  const double optimum = solve(*problem, "interior_point").objective;
  const Restated tiny = with_cost_times(1e-20, *problem);
  const auto program = tests::transcribe(tiny, {"dmoc", 1}, Grid::uniform(12));
  const Eigen::VectorXd start = sample(*program, guessed_motion(tiny));
  for (const bool falls_back : {true, false}) {
    bool is_over = false;
    static_cast<void>(solve_batch(
        *program, lanes_of(*program), start,
        [&](std::size_t /*index*/, BatchInstance& instance) {
          instance.start = start;
          return !std::exchange(is_over, true);
        },
        [&](std::size_t /*index*/, const Solution& solution) {
          EXPECT_EQ(solution.status, falls_back ? Status::solved : Status::not_confirmed) << solution.message;
          EXPECT_NE(solution.message.find("cost_scale"), std::string::npos) << solution.message;
          if (!falls_back) return;
          EXPECT_NEAR(solution.objective * 1e20, optimum, 1e-6 * optimum);
        },
        {.falls_back = falls_back}));
    EXPECT_TRUE(is_over);
  }
}

TEST(CostOfNothing, AsksForAFeasiblePointOnly) {
  const auto problem = make_problem("double_integrator");
  for (const char* solver : {"ipopt", "interior_point", "auto", "sqp"}) {
    EXPECT_EQ(solve(with_cost_times(0.0, *problem), solver).status, Status::solved) << solver;
  }
}

/// Its matrix is so degenerate that MUMPS takes minutes to factorise it, if it can.
TEST(CostOfNothing, IsConfirmedOnALongGridUnlessALimitEndsThat) {
  const auto problem = make_problem("double_integrator");
  const Restated free = with_cost_times(0.0, *problem);
  const auto program = tests::transcribe(free, {"hamiltonian", 1}, Grid::uniform(1024));
  Solution solution = make_solver("interior_point")->solve(*program, sample(*program, guessed_motion(free)));
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  const StopScope scope([] { return true; }, 0.0);
  confirm(*program, 1e-10, solution);
  EXPECT_EQ(solution.status, Status::interrupted) << solution.message;
}

/// Its cost, gradient and every residual vanish at the optimum, from where the solve starts.
TEST(CostOfNothing, AtTheOptimumLeavesItSolvedAsItIs) {
  for (const char* solver : {"ipopt", "auto", "sqp"}) {
    tests::SmallProgram program =
        tests::equality_program([](const HyperVector& x) { return x[0] * x[0] + x[1] * x[1]; },
                                [](const HyperVector& x) { return HyperVector{x[0] + x[1]}; }, 2, tests::vector({0.0}));
    const Solution solution = make_solver(solver)->solve(program, tests::vector({0.0, 0.0}));
    EXPECT_EQ(solution.status, Status::solved) << solver;
    EXPECT_EQ(solution.message, sentence_of(Status::solved)) << solver;
  }
}

}  // namespace
}  // namespace dmocbench
