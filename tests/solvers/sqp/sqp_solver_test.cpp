#include "methods/solvers/sqp/sqp_solver.hpp"

#include <gtest/gtest.h>

#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/solvers/sqp/control_bounds.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

Solution solve_by_sqp(NonlinearProgram& program, const Eigen::VectorXd& start, const SolverOptions& options = {}) {
  return SqpSolver(options).solve(program, start);
}

TEST(Sqp, FindsIpoptsOptimaToEightDigits) {
  for (const std::string& name : paper_problem_names()) {
    for (const std::string& method : paper_families()) {
      for (const Eigen::Index intervals : {16, 32, 64}) {
        SCOPED_TRACE(testing::Message() << name << " " << method << " N = " << intervals);
        const auto problem = make_problem(name);
        const tests::Solved by_ipopt =
            tests::solve(*problem, {method, 1}, Grid::uniform(intervals), tests::common_start(*problem));
        Transcription program(*problem, *make_element(method), gauss_tableau(1), Grid::uniform(intervals));
        const Solution solution = solve_by_sqp(program, sample(program, tests::common_start(*problem)));
        EXPECT_EQ(solution.status, Status::solved) << solution.message;
        EXPECT_NEAR(solution.objective / by_ipopt.solution.objective, 1.0, 1e-10);
        EXPECT_LT((solution.primal - by_ipopt.solution.primal).lpNorm<Eigen::Infinity>(), 1e-6);
        const double largest = by_ipopt.solution.multipliers.lpNorm<Eigen::Infinity>();
        EXPECT_LT((solution.multipliers - by_ipopt.solution.multipliers).lpNorm<Eigen::Infinity>(), 1e-6 * largest);
      }
    }
  }
}

/// 2 kg over 1 m by at most 50 N in the least time, 0.4 s: a linear cost and an optimum at a vertex.
class FastestMass final : public tests::SmallProblem {
 public:
  FastestMass() : SmallProblem("fastest_mass", at(0.0, 0.0), at(1.0, 0.0), 2.5, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return x.v[0] * x.v[0]; }
  [[nodiscard]] Expression running_cost(const ControlledState&) const override { return 0.0; }
  [[nodiscard]] Expression final_cost(const State& last) const override { return last.t; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.v = Bounds::all(1, -50.0, 50.0);
    bounds.u = Bounds::all(1, -50.0, 50.0);
    bounds.horizon = {0.01, 5.0};
    return bounds;
  }
};

TEST(Sqp, FindsAVertexOfALinearCostInFewIterationsByEveryFamily) {
  const FastestMass problem;
  for (const std::string& method : paper_families()) {
    for (const Eigen::Index intervals : {20, 100}) {
      SCOPED_TRACE(testing::Message() << method << " N = " << intervals);
      Transcription program(problem, *make_element(method), gauss_tableau(1), Grid::uniform(intervals));
      const Solution solution = solve_by_sqp(program, sample(program, guessed_motion(problem)));
      ASSERT_EQ(solution.status, Status::solved) << solution.message;
      EXPECT_NEAR(solution.objective, 0.4, 1e-9);
      EXPECT_LT(solution.major_iterations, 40);
    }
  }
}

TEST(Sqp, SolvesWithActiveControlBoundsToAPointWhereIpoptStays) {
  const auto problem = make_problem("two_link_manipulator");
  for (const std::string& method : paper_families()) {
    for (const double bound : {20.0, 16.0}) {
      SCOPED_TRACE(method + " " + std::to_string(bound));
      Transcription program(*problem, *make_element(method), gauss_tableau(1), Grid::uniform(32));
      auto bounded = sqp::tests::with_control_bound(program, bound);
      SolverOptions options;
      options.tolerance = 1e-8;
      const Solution solution = solve_by_sqp(bounded, sample(program, guessed_motion(*problem)), options);
      ASSERT_EQ(solution.status, Status::solved) << solution.message;
      const Solution by_ipopt = make_solver("ipopt")->solve(bounded, solution.primal);
      EXPECT_NEAR(by_ipopt.objective / solution.objective, 1.0, 1e-8);
      EXPECT_LT((by_ipopt.primal - solution.primal).lpNorm<Eigen::Infinity>(), 1e-3);  // Ipopt stays off its bounds
    }
  }
}

TEST(Sqp, UpdatesOfTheCurvaturesOfTheCostTakeFarFewerIterationsThanUpdatesOfTheIdentity) {
  const auto problem = make_problem("orbital_transfer");
  for (const std::string& method : paper_families()) {
    Transcription program(*problem, *make_element(method), gauss_tableau(1), Grid::uniform(64));
    const auto majors = [&](SecondDerivatives hessian) {
      SolverOptions options;
      options.tolerance = 1e-8;
      const Solution solution =
          SqpSolver(options, {.hessian = hessian}).solve(program, sample(program, guessed_motion(*problem)));
      EXPECT_EQ(solution.status, Status::solved) << method << ": " << solution.message;
      return solution.major_iterations.value_or(0);
    };
    EXPECT_LT(3 * majors(SecondDerivatives::limited_memory_by_cost), majors(SecondDerivatives::limited_memory))
        << method;
  }
}

TEST(Sqp, GivesUpWithAWordWhereTheObjectiveFallsForever) {
  SmallProgram program =
      tests::equality_program([](const HyperVector& x) { return x[0]; },
                              [](const HyperVector&) { return HyperVector(); }, 1, Eigen::VectorXd(0));
  SolverOptions options;
  options.most_iterations = 100;
  const Solution solution = solve_by_sqp(program, vector({0.0}), options);
  EXPECT_FALSE(is_solved(solution.status));
  EXPECT_FALSE(solution.message.empty());
}

TEST(Sqp, StepsBackFromPlacesWhereAFormulaGivesNoNumber) {
  // x - log x has its minimum 1 at 1; the first full step from 3 leaves the domain.
  SmallProgram program =
      tests::equality_program([](const HyperVector& x) { return x[0] - log(x[0]); },
                              [](const HyperVector&) { return HyperVector(); }, 1, Eigen::VectorXd(0));
  const Solution solution = solve_by_sqp(program, vector({3.0}));
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  EXPECT_NEAR(solution.primal[0], 1.0, 1e-8);
}

TEST(Sqp, RefusesWhatItDoesNotKnow) {
  const auto refusal_of = [](const std::string& option, const std::string& value) {
    return tests::sentence_of_error([&] { static_cast<void>(make_solver("sqp", {}, {{option, value}})); });
  };
  EXPECT_EQ(refusal_of("crush", "basis"),
            "the solver sqp has no option crush; it has crash, hessian, pricing and seed");
  EXPECT_EQ(refusal_of("crash", "all"), "the solver sqp: crash must be none or basis, not all");
  EXPECT_EQ(refusal_of("pricing", "steepest"),
            "the solver sqp: pricing must be largest, lowest, last or random, not steepest");
  EXPECT_EQ(refusal_of("seed", "1.5"), "the solver sqp: seed must be a whole number, not 1.5");
}

}  // namespace
}  // namespace dmocbench
