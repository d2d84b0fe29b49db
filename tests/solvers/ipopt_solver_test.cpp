#include "methods/solvers/ipopt_solver.hpp"

#include <map>

#include <gtest/gtest.h>

#include "tests/support/sentence_of_error.hpp"
#include "tests/support/small_programs.hpp"

namespace dmocbench {
namespace {

using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

Solution solve_by_ipopt(NonlinearProgram& program, const Eigen::VectorXd& start, const SolverOptions& options = {}) {
  return IpoptSolver(options).solve(program, start);
}

TEST(Ipopt, IsNotBelievedWhereOurResidualIsLarger) {
  // Ipopt is told to stop early and says "solved"; we were asked for 1e-10.
  SmallProgram program = tests::rosenbrock();
  SolverOptions options;
  options.passed_on["tol"] = "1e-2";
  options.passed_on["dual_inf_tol"] = "1e-2";
  options.passed_on["acceptable_iter"] = "0";
  const Solution solution = solve_by_ipopt(program, vector({-1.2, 1.0}), options);
  EXPECT_EQ(solution.status, Status::not_confirmed);
  EXPECT_GT(solution.kkt_residual.value(), 1e-9);
  EXPECT_EQ(solution.message, sentence_of(Status::not_confirmed));
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
  SolverOptions options;
  options.passed_on["max_iter"] = "2";  // wins over most_iterations
  options.passed_on["mu_strategy"] = "adaptive";
  options.passed_on["bound_push"] = "0.02";
  EXPECT_EQ(solve_by_ipopt(program, vector({-1.2, 1.0}), options).status, Status::iteration_limit);
  for (const auto& [name, value] :
       std::map<std::string, std::string>{{"no_such_option", "1"}, {"mu_strategy", "sometimes"}, {"max_iter", "-3"}}) {
    SolverOptions wrong;
    wrong.passed_on[name] = value;
    tests::expect_error_naming(
        {name, value}, [&, start = vector({0.0, 0.0})] { static_cast<void>(solve_by_ipopt(program, start, wrong)); });
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
