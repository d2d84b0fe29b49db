// Threads that solve at the same time: MUMPS and Ipopt have global state.
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "methods/kkt/symmetric_factorisation.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/registry.hpp"
#include "tests/support/restored_settings.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

struct Task {
  std::string problem;
  std::string solver;
  NamedOptions named;
};

const std::vector<Task> tasks{{"two_link_manipulator", "ipopt", {}},
                              {"cart_pole", "sqp", {}},
                              {"orbital_transfer", "interior_point", {{"factorisation", "sparse"}}},
                              {"robot_arm", "auto", {}},
                              {"acrobot", "ipopt", {}},
                              {"double_integrator", "sqp", {}},
                              {"planar_quadrotor", "interior_point", {}}};

/// The answer to a task, with the multipliers behind the unknowns.
Eigen::VectorXd answer(const Task& task) {
  const auto problem = make_problem(task.problem);
  const auto program = tests::transcribe(*problem, {"dmoc", 1}, Grid::uniform(24));
  const Solution solution =
      make_solver(task.solver, {}, task.named)->solve(*program, sample(*program, guessed_motion(*problem)));
  Eigen::VectorXd numbers(solution.primal.size() + solution.multipliers.size());
  numbers << solution.primal, solution.multipliers;
  return numbers;
}

/// By `auto`, which goes to Ipopt at once as these programs have no intervals.
std::vector<Eigen::VectorXd> small_answers() {
  std::vector<Eigen::VectorXd> answers;
  for (const tests::KnownProgram& known : tests::hock_schittkowski()) {
    tests::SmallProgram program(known.statement);
    answers.push_back(make_solver("auto")->solve(program, known.start).primal);
  }
  return answers;
}

TEST(SeveralThreads, FindWhatOneThreadFindsBitByBit) {
  const tests::EnvironmentVariable ordering("SCOTCH_PTHREAD_NUMBER");
  ordering.set("1");  // else Scotch itself gives answers of MUMPS other last digits from run to run
  std::vector<Eigen::VectorXd> expected;
  for (const Task& task : tasks) expected.push_back(answer(task));
  const std::vector<Eigen::VectorXd> expected_small = small_answers();

  constexpr std::size_t count = 4;
  std::vector<std::vector<Eigen::VectorXd>> found(count);
  std::vector<std::vector<Eigen::VectorXd>> found_small(count);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < count; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < tasks.size(); ++i) found[t].push_back(answer(tasks[(2 * t + i) % tasks.size()]));
      found_small[t] = small_answers();
    });
  }
  for (std::thread& thread : threads) thread.join();

  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const std::size_t which = (2 * t + i) % tasks.size();
      EXPECT_EQ(found[t][i], expected[which]) << tasks[which].problem << " by " << tasks[which].solver;
    }
    EXPECT_EQ(found_small[t], expected_small);
  }
}

class WaitingSolver : public testing::TestWithParam<const char*> {
 protected:
  /// The status of a solve while another thread has MUMPS, which it does not give back before the solve has ended.
  static Status status_with(const SolverOptions& options) {
    Status status = Status::not_run;
    const auto lock = lock_mumps();
    std::thread([&] {
      tests::SmallProgram program = tests::rosenbrock();
      const Solution solution = make_solver(GetParam(), options)->solve(program, tests::vector({-1.2, 1.0}));
      status = solution.status;
    }).join();
    return status;
  }
};

INSTANTIATE_TEST_SUITE_P(Solvers, WaitingSolver, testing::Values("ipopt", "sqp", "auto"));

TEST_P(WaitingSolver, HeedsItsLimitOfTime) {
  SolverOptions limited;
  limited.most_seconds = 0.02;
  EXPECT_EQ(status_with(limited), Status::time_limit);
}

TEST_P(WaitingSolver, HeedsAStopRequest) {
  SolverOptions stopped;
  int asked = 0;
  stopped.stop_requested = [&] { return ++asked > 3; };
  EXPECT_EQ(status_with(stopped), Status::interrupted);
}

}  // namespace
}  // namespace dmocbench
