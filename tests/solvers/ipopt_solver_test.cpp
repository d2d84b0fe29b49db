#include "methods/solvers/ipopt_solver.hpp"

#include <chrono>
#include <map>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/sentence_of_error.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

Solution solve_by_ipopt(NonlinearProgram& program, const Eigen::VectorXd& start, const SolverOptions& options = {}) {
  return IpoptSolver(options).solve(program, start);
}

Solution solve_with(const NamedOptions& named, NonlinearProgram& program, const Eigen::VectorXd& start) {
  return IpoptSolver({}, named).solve(program, start);
}

TEST(Ipopt, IsNotBelievedWhereOurResidualIsLarger) {
  // Ipopt is told to stop early and says "solved"; we were asked for 1e-10.
  SmallProgram program = tests::rosenbrock();
  const Solution solution =
      solve_with({{"tol", "1e-2"}, {"dual_inf_tol", "1e-2"}, {"acceptable_iter", "0"}}, program, vector({-1.2, 1.0}));
  EXPECT_EQ(solution.status, Status::not_confirmed);
  EXPECT_GT(tests::value_of(solution.kkt_residual), 1e-9);
  EXPECT_EQ(solution.message, sentence_of(Status::not_confirmed));
}

/// A program whose k-th evaluation of objective or constraints takes longer than the solve may.
class SlowProgram final : public SmallProgram {
 public:
  SlowProgram(SmallProgram::Statement statement, int slow) : SmallProgram(std::move(statement)), slow_(slow) {}
  [[nodiscard]] double objective(const VectorIn& x) override {
    count();
    return SmallProgram::objective(x);
  }
  void constraints(const VectorIn& x, VectorOut result) override {
    count();
    SmallProgram::constraints(x, result);
  }

 private:
  void count() {
    if (++count_ == slow_) std::this_thread::sleep_for(std::chrono::milliseconds(60));
  }
  int slow_;
  int count_ = 0;
};

TEST(Ipopt, StopsAtTheTimeLimitWhereverTheTimeGoes) {
  for (const tests::KnownProgram& known : tests::hock_schittkowski()) {
    if (known.number != 71) continue;
    for (int slow = 1; slow <= 16; ++slow) {
      SCOPED_TRACE(slow);
      SlowProgram program(known.statement, slow);
      SolverOptions limited;
      limited.most_seconds = 0.05;
      const Solution solution = solve_by_ipopt(program, known.start, limited);
      EXPECT_TRUE(solution.status == Status::time_limit || is_solved(solution.status)) << solution.message;
      EXPECT_EQ(solution.primal.size(), known.start.size());
      EXPECT_TRUE(solution.primal.allFinite());
    }
  }
}

TEST(Ipopt, RefusesMoreRowsThanVariables) {
  SmallProgram program = tests::equality_program([](const HyperVector& x) { return x[0] * x[0]; },
                                                 [](const HyperVector& x) {
                                                   return HyperVector{x[0], 2.0 * x[0]};
                                                 },
                                                 1, vector({1.0, 2.0}));
  EXPECT_EQ(solve_by_ipopt(program, vector({0.0})).status, Status::invalid_program);
}

TEST(Ipopt, TakesItsOwnOptionsByNameAndRefusesUnknownOnes) {
  SmallProgram program = tests::rosenbrock();
  const NamedOptions named{{"max_iter", "2"},  // wins over most_iterations
                           {"mu_strategy", "adaptive"},
                           {"bound_push", "0.02"}};
  EXPECT_EQ(solve_with(named, program, vector({-1.2, 1.0})).status, Status::iteration_limit);
  for (const auto& [name, value] :
       std::map<std::string, std::string>{{"no_such_option", "1"}, {"mu_strategy", "sometimes"}, {"max_iter", "-3"}}) {
    tests::expect_error_naming({name, value}, [wrong = NamedOptions{{name, value}}] { IpoptSolver({}, wrong); });
  }
}

TEST(Ipopt, PrintsNothingUnlessVerbose) {
  SmallProgram program = tests::rosenbrock();
  const auto printed = [&](bool verbose) {
    SolverOptions options;
    options.verbose = verbose;
    testing::internal::CaptureStdout();
    static_cast<void>(solve_by_ipopt(program, vector({-1.2, 1.0}), options));
    return testing::internal::GetCapturedStdout();
  };
  EXPECT_EQ(printed(false), "");
  EXPECT_NE(printed(true).find("iter"), std::string::npos);
}

}  // namespace
}  // namespace dmocbench
