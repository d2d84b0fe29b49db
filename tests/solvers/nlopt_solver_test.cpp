#include "methods/solvers/nlopt_solver.hpp"

#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

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

/// Far enough above rounding for SLSQP's line search to reach it on every machine.
SolverOptions within_reach() {
  SolverOptions options;
  options.tolerance = 1e-8;
  return options;
}

Solution solve_by_nlopt(NonlinearProgram& program, const Eigen::VectorXd& start,
                        const SolverOptions& options = within_reach()) {
  return NloptSolver(options).solve(program, start);
}

SolverOptions passing_on(const std::string& name, const std::string& value) {
  SolverOptions options;
  options.passed_on[name] = value;
  return options;
}

TEST(Nlopt, FindsTheKnownOptimaOfHockAndSchittkowski) {
  for (const tests::KnownProgram& known : tests::hock_schittkowski()) {
    SCOPED_TRACE("HS " + std::to_string(known.number));
    SmallProgram program(known.statement);
    const Solution solution = solve_by_nlopt(program, known.start);
    EXPECT_EQ(solution.status, Status::solved) << solution.message;
    EXPECT_NEAR(solution.objective, known.objective, 1e-7);
    EXPECT_LT((solution.primal - known.optimum).norm(), 2e-4);
    EXPECT_LT(solution.kkt_residual.value_or(unbounded), 1e-7);
    EXPECT_LT(solution.constraint_violation.value_or(unbounded), 1e-7);
    EXPECT_GT(solution.total_evaluations().value_or(0), 0);
    EXPECT_FALSE(solution.major_iterations.has_value());
    EXPECT_FALSE(solution.minor_iterations.has_value());
    EXPECT_TRUE(solution.multipliers_are_estimated);
  }
}

TEST(Nlopt, ReportsWhatWeComputeAtItsAnswer) {
  for (const tests::KnownProgram& known : tests::hock_schittkowski()) {
    SmallProgram program(known.statement);
    const Solution solution = solve_by_nlopt(program, known.start);
    EXPECT_EQ(solution.objective, program.objective(solution.primal));
    const KktResidual residual = kkt_residual(program, solution.primal, solution.multipliers);
    EXPECT_EQ(solution.kkt_residual, residual.stationarity);
    EXPECT_EQ(solution.constraint_violation, residual.constraint_violation);
    EXPECT_EQ(solution.message, sentence_of(solution.status));
  }
}

TEST(Nlopt, MinimisesWithoutRows) {
  SmallProgram program = tests::rosenbrock();
  const Solution solution = solve_by_nlopt(program, vector({-1.2, 1.0}));
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  EXPECT_LT((solution.primal - vector({1.0, 1.0})).norm(), 1e-5);
}

TEST(Nlopt, KeepsFixedVariablesAtTheirValues) {
  tests::KnownProgram known = tests::hock_schittkowski().back();
  known.statement.variable_lower[1] = known.statement.variable_upper[1] = 4.5;
  SmallProgram program(known.statement);
  const Solution solution = solve_by_nlopt(program, known.start);
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  EXPECT_EQ(solution.primal[1], 4.5);
  EXPECT_GT(solution.objective, known.objective);
}

TEST(Nlopt, StartsWithinTheBounds) {
  const tests::KnownProgram known = tests::hock_schittkowski().back();
  SmallProgram program(known.statement);
  const Solution solution = solve_by_nlopt(program, vector({-3.0, 9.0, 5.0, 1.0}));
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  EXPECT_NEAR(solution.objective, known.objective, 1e-7);
}

TEST(Nlopt, HoldsARowBetweenTwoBounds) {
  // min (x - 3)² + y² with 1 <= x + y <= 2: at (2.5, -0.5), λ = 1; with 4 <= x + y <= 5 at (3.5, 0.5), λ = -1.
  for (const auto& [lower, upper, x, multiplier] : {std::array{1.0, 2.0, 2.5, 1.0}, std::array{4.0, 5.0, 3.5, -1.0}}) {
    SmallProgram program({[](const HyperVector& z) {
                            const HyperDual a = z[0] - 3.0;
                            return a * a + z[1] * z[1];
                          },
                          [](const HyperVector& z) { return HyperVector{z[0] + z[1]}; }, everywhere(2, -unbounded),
                          everywhere(2, unbounded), vector({lower}), vector({upper})});
    const Solution solution = solve_by_nlopt(program, vector({0.0, 0.0}));
    EXPECT_EQ(solution.status, Status::solved) << solution.message;
    EXPECT_NEAR(solution.primal[0], x, 1e-6);
    EXPECT_NEAR(solution.multipliers[0], multiplier, 1e-6);
  }
}

TEST(Nlopt, SaysInfeasibleWhereTheRowsCannotBeMet) {
  SmallProgram program = tests::equality_program(
      [](const HyperVector& x) { return x[0] * x[0] + x[1] * x[1]; },
      [](const HyperVector& x) { return HyperVector{x[0] * x[0] + x[1] * x[1]}; }, 2, vector({-1.0}));
  const Solution solution = solve_by_nlopt(program, vector({1.0, 0.5}));
  EXPECT_EQ(solution.status, Status::infeasible);
  EXPECT_NEAR(solution.constraint_violation.value_or(unbounded), 1.0, 1e-4);
}

TEST(Nlopt, NeverSaysSolvedWhereRowsContradictEachOther) {
  SmallProgram program = tests::equality_program([](const HyperVector& x) { return x[0] * x[0] + x[1] * x[1]; },
                                                 [](const HyperVector& x) {
                                                   return HyperVector{x[0] + x[1], x[0] + x[1]};
                                                 },
                                                 2, vector({0.0, 2.0}));
  EXPECT_EQ(solve_by_nlopt(program, vector({1.0, 0.5})).status, Status::step_failed);
  EXPECT_EQ(solve_by_nlopt(program, vector({0.5, 0.5})).status, Status::infeasible);
}

TEST(Nlopt, TakesAFeasiblePointOfAProgramWithoutFreedom) {
  const auto fixed_at = [](double value) {
    return SmallProgram({[](const HyperVector& x) { return x[0]; }, [](const HyperVector& x) { return x; },
                         vector({value}), vector({value}), vector({1.0}), vector({2.0})});
  };
  SmallProgram feasible = fixed_at(1.5);
  EXPECT_EQ(solve_by_nlopt(feasible, vector({1.5})).status, Status::solved);
  SmallProgram infeasible = fixed_at(3.0);
  EXPECT_FALSE(is_solved(solve_by_nlopt(infeasible, vector({3.0})).status));
}

TEST(Nlopt, StopsAtTheEvaluationLimit) {
  SmallProgram program = tests::rosenbrock();
  SolverOptions options;
  options.most_iterations = 3;
  const Solution solution = solve_by_nlopt(program, vector({-1.2, 1.0}), options);
  EXPECT_EQ(solution.status, Status::iteration_limit);
  EXPECT_EQ(solution.evaluations->objective, 3);
  EXPECT_EQ(solution.primal.size(), 2);
  EXPECT_GT(solution.kkt_residual.value_or(0.0), 1e-3);
}

TEST(Nlopt, StopsAtTheTimeLimit) {
  SmallProgram program = tests::rosenbrock();
  SolverOptions options;
  options.most_seconds = 1e-12;
  EXPECT_EQ(solve_by_nlopt(program, vector({-1.2, 1.0}), options).status, Status::time_limit);
}

TEST(Nlopt, StopsWhenAskedTo) {
  SmallProgram program = tests::rosenbrock();
  SolverOptions options;
  int asked = 0;
  options.stop_requested = [&] { return ++asked == 4; };
  const Solution solution = solve_by_nlopt(program, vector({-1.2, 1.0}), options);
  EXPECT_EQ(solution.status, Status::interrupted);
  EXPECT_EQ(asked, 4);
  EXPECT_EQ(solution.evaluations->objective, 3);
}

TEST(Nlopt, SaysEvaluationFailedWhereTheStartIsNotANumber) {
  SmallProgram objective =
      tests::equality_program([](const HyperVector& x) { return log(x[0]); },
                              [](const HyperVector& x) { return HyperVector{x[0]}; }, 1, vector({2.0}));
  EXPECT_EQ(solve_by_nlopt(objective, vector({-1.0})).status, Status::evaluation_failed);
  SmallProgram row =
      tests::equality_program([](const HyperVector& x) { return x[0] * x[0] + x[1]; },
                              [](const HyperVector& x) { return HyperVector{sqrt(x[0])}; }, 2, vector({2.0}));
  EXPECT_EQ(solve_by_nlopt(row, vector({-1.0, 0.0})).status, Status::evaluation_failed);
}

TEST(Nlopt, TurnsBackWhereAStepLeavesTheDomain) {
  // From 3 the slope is 20/3, so the first step goes to 3 - 20/3, where the logarithm is not a number.
  SmallProgram program =
      tests::equality_program([](const HyperVector& x) { return 10.0 * (x[0] - log(x[0])); },
                              [](const HyperVector&) { return HyperVector(); }, 1, Eigen::VectorXd(0));
  const Solution solution = solve_by_nlopt(program, vector({3.0}));
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  EXPECT_NEAR(solution.primal[0], 1.0, 1e-6);
}

/// Values are right, one kind of derivative is not a number.
class BrokenFirstDerivatives final : public SmallProgram {
 public:
  BrokenFirstDerivatives(SmallProgram::Statement statement, bool in_gradient)
      : SmallProgram(std::move(statement)), in_gradient_(in_gradient) {}
  void gradient(const VectorIn& x, VectorOut result) override {
    SmallProgram::gradient(x, result);
    if (in_gradient_) result[0] = std::numeric_limits<double>::quiet_NaN();
  }
  void jacobian(const VectorIn& x, VectorOut values) override {
    SmallProgram::jacobian(x, values);
    if (!in_gradient_) values[0] = std::numeric_limits<double>::quiet_NaN();
  }

 private:
  bool in_gradient_;
};

TEST(Nlopt, SaysEvaluationFailedWhereADerivativeIsNotANumber) {
  const tests::KnownProgram known = tests::hock_schittkowski().back();
  for (const bool in_gradient : {true, false}) {
    BrokenFirstDerivatives program(known.statement, in_gradient);
    EXPECT_EQ(solve_by_nlopt(program, known.start).status, Status::evaluation_failed);
  }
}

TEST(Nlopt, LetsExceptionsOfAProgramThrough) {
  SmallProgram program = tests::equality_program(
      [](const HyperVector& x) -> HyperDual {
        if (x[0].x != 0.0) throw std::domain_error("only at the start");
        return (x[0] - 1.0) * (x[0] - 1.0);
      },
      [](const HyperVector&) { return HyperVector(); }, 1, Eigen::VectorXd(0));
  EXPECT_THROW(static_cast<void>(solve_by_nlopt(program, vector({0.0}))), std::domain_error);
}

TEST(Nlopt, IsNotBelievedWhereOurResidualIsLarger) {
  SmallProgram program = tests::rosenbrock();
  const Solution solution = solve_by_nlopt(program, vector({-1.2, 1.0}), passing_on("ftol_rel", "0.1"));
  EXPECT_EQ(solution.status, Status::not_confirmed);
  EXPECT_GT(solution.kkt_residual.value_or(0.0), 1e-7);
  EXPECT_EQ(solution.message, sentence_of(Status::not_confirmed));
}

TEST(Nlopt, RefusesMoreEqualitiesThanFreeVariables) {
  SmallProgram program = tests::equality_program([](const HyperVector& x) { return x[0] * x[0]; },
                                                 [](const HyperVector& x) {
                                                   return HyperVector{x[0], 2.0 * x[0]};
                                                 },
                                                 1, vector({1.0, 2.0}));
  const Solution solution = solve_by_nlopt(program, vector({0.0}));
  EXPECT_EQ(solution.status, Status::invalid_program);
  EXPECT_NE(solution.message.find("2 and 1"), std::string::npos) << solution.message;
}

/// Many variables, no rows; evaluated nowhere.
SmallProgram large(std::size_t free_count) {
  const auto n = static_cast<Eigen::Index>(free_count) + 1;
  Eigen::VectorXd lower = everywhere(n, -unbounded);
  Eigen::VectorXd upper = everywhere(n, unbounded);
  lower[0] = upper[0] = 0.0;
  return SmallProgram({[](const HyperVector& x) { return x[1] * x[1]; },
                       [](const HyperVector&) { return HyperVector(); }, lower, upper, Eigen::VectorXd(0),
                       Eigen::VectorXd(0)});
}

TEST(Nlopt, RefusesMoreFreeVariablesThanItCanBearAndNamesBothNumbers) {
  constexpr std::size_t most = NloptSolver::most_free_variables;
  SmallProgram too_large = large(most + 1);
  const Solution solution = solve_by_nlopt(too_large, everywhere(static_cast<Eigen::Index>(most) + 2, 0.0));
  EXPECT_EQ(solution.status, Status::too_large);
  EXPECT_EQ(solution.primal.size(), 0);
  EXPECT_NE(solution.message.find(std::to_string(most)), std::string::npos) << solution.message;
  EXPECT_NE(solution.message.find(std::to_string(most + 1)), std::string::npos) << solution.message;
  SmallProgram fits = large(most);
  EXPECT_EQ(solve_by_nlopt(fits, everywhere(static_cast<Eigen::Index>(most) + 1, 0.0)).status, Status::solved);
}

TEST(Nlopt, TakesItsOwnOptionsByNameAndRefusesUnknownOnes) {
  SmallProgram program = tests::rosenbrock();
  const Solution limited = solve_by_nlopt(program, vector({-1.2, 1.0}), passing_on("maxeval", "2"));
  EXPECT_EQ(limited.status, Status::iteration_limit);
  EXPECT_EQ(limited.evaluations->objective, 2);
  for (const auto& [name, value] : std::map<std::string, std::string>{{"no_such_option", "1"},
                                                                      {"ftol_rel", "small"},
                                                                      {"xtol_rel", "-1"},
                                                                      {"maxeval", "2.5"},
                                                                      {"maxtime", "nan"}}) {
    tests::expect_error_naming({name}, [&, options = passing_on(name, value)] {
      static_cast<void>(solve_by_nlopt(program, vector({0.0, 0.0}), options));
    });
  }
}

TEST(Nlopt, RefusesAStartOfTheWrongSize) {
  SmallProgram program = tests::rosenbrock();
  tests::expect_error_naming({"3", "2"}, [&] { static_cast<void>(solve_by_nlopt(program, everywhere(3, 0.0))); });
}

}  // namespace
}  // namespace dmocbench
