#include "methods/solvers/ipopt_solver.hpp"

#include <limits>
#include <map>
#include <utility>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "methods/program/kkt_residual.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/small_programs.hpp"

namespace dmocbench {
namespace {

using tests::everywhere;
using tests::HyperDual;
using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

Solution solve_by_ipopt(NonlinearProgram& program, const Eigen::VectorXd& start, const SolverOptions& options = {}) {
  return IpoptSolver(options).solve(program, start);
}

TEST(Ipopt, FindsTheKnownOptimaOfHockAndSchittkowski) {
  for (const tests::KnownProgram& known : tests::hock_schittkowski()) {
    SCOPED_TRACE("HS " + std::to_string(known.number));
    SmallProgram program(known.statement);
    const Solution solution = solve_by_ipopt(program, known.start);
    EXPECT_EQ(solution.status, Status::solved) << solution.message;
    EXPECT_NEAR(solution.objective, known.objective, 1e-8);
    EXPECT_LT((solution.primal - known.optimum).norm(), 2e-5);
    ASSERT_TRUE(solution.kkt_residual.has_value());
    EXPECT_LT(*solution.kkt_residual, 1e-9);
    EXPECT_LT(*solution.constraint_violation, 1e-9);
    EXPECT_GT(solution.major_iterations.value(), 0);
    EXPECT_GT(solution.evaluations.value().total(), 0);
    EXPECT_FALSE(solution.minor_iterations.has_value());
  }
}

TEST(Ipopt, GivesMultipliersOfOurSign) {
  // HS 7: ∇φ = (0, -1), ∂a = (0, 2√3) at the optimum, so ∇φ + λ∂a = 0 has λ = 1/(2√3).
  const tests::KnownProgram known = tests::hock_schittkowski()[1];
  SmallProgram program(known.statement);
  const Solution solution = solve_by_ipopt(program, known.start);
  ASSERT_EQ(solution.multipliers.size(), 1);
  EXPECT_NEAR(solution.multipliers[0], 0.5 / std::sqrt(3.0), 1e-8);
}

TEST(Ipopt, PushesAwayFromTheActiveSideOfAnInequality) {
  // HS 71: x₁x₂x₃x₄ >= 25 is active from below: more of it would cost more, so its multiplier is negative.
  const tests::KnownProgram known = tests::hock_schittkowski().back();
  SmallProgram program(known.statement);
  const Solution solution = solve_by_ipopt(program, known.start);
  EXPECT_NEAR(solution.multipliers[0], -0.5522936596, 1e-8);
  EXPECT_NEAR(solution.multipliers[1], 0.1614685642, 1e-8);
}

TEST(Ipopt, ReportsWhatWeComputeAtItsAnswer) {
  for (const tests::KnownProgram& known : tests::hock_schittkowski()) {
    SmallProgram program(known.statement);
    const Solution solution = solve_by_ipopt(program, known.start);
    EXPECT_EQ(solution.objective, program.objective(solution.primal));
    const KktResidual residual = kkt_residual(program, solution.primal, solution.multipliers);
    EXPECT_EQ(solution.kkt_residual, residual.stationarity);
    EXPECT_EQ(solution.constraint_violation, residual.constraint_violation);
    EXPECT_EQ(solution.message, sentence_of(solution.status));
  }
}

TEST(Ipopt, KeepsFixedVariablesAtTheirValues) {
  tests::KnownProgram known = tests::hock_schittkowski().back();
  known.statement.variable_lower[1] = known.statement.variable_upper[1] = 4.5;
  SmallProgram program(known.statement);
  const Solution solution = solve_by_ipopt(program, known.start);
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  EXPECT_EQ(solution.primal[1], 4.5);
  EXPECT_GT(solution.objective, known.objective);
}

TEST(Ipopt, SaysInfeasibleWhereTheRowsCannotBeMet) {
  SmallProgram program = tests::equality_program(
      [](const HyperVector& x) { return x[0] * x[0] + x[1] * x[1]; },
      [](const HyperVector& x) { return HyperVector{x[0] * x[0] + x[1] * x[1]}; }, 2, vector({-1.0}));
  const Solution solution = solve_by_ipopt(program, vector({1.0, 0.5}));
  EXPECT_EQ(solution.status, Status::infeasible);
  EXPECT_NEAR(solution.constraint_violation.value(), 1.0, 1e-4);
}

TEST(Ipopt, StopsAtTheIterationLimit) {
  SmallProgram program = tests::rosenbrock();
  SolverOptions options;
  options.most_iterations = 3;
  const Solution solution = solve_by_ipopt(program, vector({-1.2, 1.0}), options);
  EXPECT_EQ(solution.status, Status::iteration_limit);
  EXPECT_EQ(solution.major_iterations, 3);
  EXPECT_EQ(solution.primal.size(), 2);
  EXPECT_GT(solution.kkt_residual.value(), 1e-3);
}

TEST(Ipopt, StopsAtTheTimeLimit) {
  // Every iteration lasts until the clock that Ipopt reads has moved on, so the second begins too late.
  const auto user_time = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::pair(usage.ru_utime.tv_sec, usage.ru_utime.tv_usec);
  };
  SmallProgram program = tests::rosenbrock();
  SolverOptions options;
  options.most_seconds = 1e-12;
  options.stop_requested = [&] {
    const auto before = user_time();
    while (user_time() == before) {
    }
    return false;
  };
  EXPECT_EQ(solve_by_ipopt(program, vector({-1.2, 1.0}), options).status, Status::time_limit);
}

TEST(Ipopt, StopsWhenAskedTo) {
  SmallProgram program = tests::rosenbrock();
  SolverOptions options;
  int asked = 0;
  options.stop_requested = [&] { return ++asked == 4; };
  const Solution solution = solve_by_ipopt(program, vector({-1.2, 1.0}), options);
  EXPECT_EQ(solution.status, Status::interrupted);
  EXPECT_EQ(asked, 4);
}

TEST(Ipopt, SaysEvaluationFailedWhereTheObjectiveOrARowIsNotANumber) {
  SmallProgram objective =
      tests::equality_program([](const HyperVector& x) { return log(x[0]); },
                              [](const HyperVector& x) { return HyperVector{x[0]}; }, 1, vector({2.0}));
  EXPECT_EQ(solve_by_ipopt(objective, vector({-1.0})).status, Status::evaluation_failed);
  SmallProgram row =
      tests::equality_program([](const HyperVector& x) { return x[0] * x[0] + x[1]; },
                              [](const HyperVector& x) { return HyperVector{sqrt(x[0])}; }, 2, vector({2.0}));
  EXPECT_EQ(solve_by_ipopt(row, vector({-1.0, 0.0})).status, Status::evaluation_failed);
}

/// Values are right, one kind of derivative is not a number.
class BrokenDerivatives final : public SmallProgram {
 public:
  enum class Kind { gradient, jacobian, hessian };
  BrokenDerivatives(SmallProgram::Statement statement, Kind kind) : SmallProgram(std::move(statement)), kind_(kind) {}
  void gradient(const VectorIn& x, VectorOut result) override {
    SmallProgram::gradient(x, result);
    spoil(Kind::gradient, result);
  }
  void jacobian(const VectorIn& x, VectorOut values) override {
    SmallProgram::jacobian(x, values);
    spoil(Kind::jacobian, values);
  }
  void hessian(const VectorIn& x, double factor, const VectorIn& multipliers, VectorOut values) override {
    SmallProgram::hessian(x, factor, multipliers, values);
    spoil(Kind::hessian, values);
  }

 private:
  void spoil(Kind kind, VectorOut values) const {
    if (kind == kind_) values[0] = std::numeric_limits<double>::quiet_NaN();
  }
  Kind kind_;
};

TEST(Ipopt, NeverSaysSolvedWhereADerivativeIsNotANumber) {
  const tests::KnownProgram known = tests::hock_schittkowski().back();
  using Kind = BrokenDerivatives::Kind;
  for (const Kind kind : {Kind::gradient, Kind::jacobian, Kind::hessian}) {
    BrokenDerivatives program(known.statement, kind);
    const Solution solution = solve_by_ipopt(program, known.start);
    EXPECT_EQ(solution.status, Status::evaluation_failed) << static_cast<int>(kind) << ": " << solution.message;
  }
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

TEST(Ipopt, RefusesAStartOfTheWrongSize) {
  SmallProgram program = tests::rosenbrock();
  tests::expect_error_naming({"3", "2"}, [&] { static_cast<void>(solve_by_ipopt(program, everywhere(3, 0.0))); });
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
