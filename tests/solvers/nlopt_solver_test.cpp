#include "methods/solvers/nlopt_solver.hpp"

#include <map>
#include <stdexcept>

#include <gtest/gtest.h>

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

TEST(Nlopt, SaysInfeasibleWhereRowsContradictEachOther) {
  SmallProgram program = tests::equality_program([](const HyperVector& x) { return x[0] * x[0] + x[1] * x[1]; },
                                                 [](const HyperVector& x) {
                                                   return HyperVector{x[0] + x[1], x[0] + x[1]};
                                                 },
                                                 2, vector({0.0, 2.0}));
  EXPECT_EQ(solve_by_nlopt(program, vector({1.0, 0.5})).status, Status::infeasible);
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

TEST(Nlopt, TurnsBackWhereAStepLeavesTheDomain) {
  // From 3 the gradient is 20/3, so the first step goes to 3 - 20/3, where the logarithm is not a number.
  SmallProgram program =
      tests::equality_program([](const HyperVector& x) { return 10.0 * (x[0] - log(x[0])); },
                              [](const HyperVector&) { return HyperVector(); }, 1, Eigen::VectorXd(0));
  const Solution solution = solve_by_nlopt(program, vector({3.0}));
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  EXPECT_NEAR(solution.primal[0], 1.0, 1e-6);
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
  const Solution solution = NloptSolver({}, {{"ftol_rel", "0.1"}}).solve(program, vector({-1.2, 1.0}));
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
  const Solution limited = NloptSolver({}, {{"maxeval", "2"}}).solve(program, vector({-1.2, 1.0}));
  EXPECT_EQ(limited.status, Status::iteration_limit);
  EXPECT_EQ(limited.evaluations->objective, 2);
  for (const auto& [name, value] : std::map<std::string, std::string>{{"no_such_option", "1"},
                                                                      {"ftol_rel", "small"},
                                                                      {"xtol_rel", "-1"},
                                                                      {"maxeval", "2.5"},
                                                                      {"maxtime", "nan"}}) {
    tests::expect_error_naming({name}, [wrong = NamedOptions{{name, value}}] { NloptSolver({}, wrong); });
  }
}

}  // namespace
}  // namespace dmocbench
