#include "methods/indirect/solve_indirect.hpp"

#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "methods/diagnostics/replay_error.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::SmallProblem;

/// L = ½(v² - q²), f = u, C = u², from rest to v = 1 in one period. Optimum: u = cos t/π, q = t sin t/(2π), J = 1/π.
class ForcedOscillator final : public SmallProblem {
 public:
  ForcedOscillator() : SmallProblem("forced_oscillator", at(0.0, 0.0), at(0.0, 1.0), 2.0 * std::numbers::pi, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * (x.v[0] * x.v[0] - x.q[0] * x.q[0]);
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }
};

/// The double integrator with another running cost.
class WithCost final : public SmallProblem {
 public:
  explicit WithCost(std::function<Expression(const Expression&)> cost)
      : SmallProblem("with_cost", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1), cost_(std::move(cost)) {}
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return cost_(x.u[0]); }

 private:
  std::function<Expression(const Expression&)> cost_;
};

/// Another problem with twice its running cost.
class WithDoubleCost final : public ForwardingProblem {
 public:
  explicit WithDoubleCost(const Problem& base) : ForwardingProblem(base) {}
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 2.0 * original().running_cost(x);
  }
};

Trajectory direct_solution(const Problem& problem) {
  return tests::solve(problem, {"dmoc", 1}, Grid::uniform(48), tests::common_start(problem)).trajectory;
}

TEST(SolveIndirect, FindsTheClosedFormOfTheDoubleIntegrator) {
  const tests::DoubleIntegrator problem;
  const IndirectSolution solution = solve_indirect(problem, direct_solution(problem));
  EXPECT_NEAR(solution.cost(), 6.0, 1e-13);
  for (const double t : {0.0, 0.123, 0.5, 0.777, 1.0}) {
    const IndirectPoint point = solution.at(t);
    EXPECT_NEAR(point.u[0], 6.0 - 12.0 * t, 1e-12);
    EXPECT_NEAR(point.q[0], t * t * (3.0 - 2.0 * t), 1e-13);
    EXPECT_NEAR(point.psi_p[0], 12.0 * t - 6.0, 1e-12);
    EXPECT_NEAR(point.psi_q[0], -12.0, 1e-12);
  }
}

TEST(SolveIndirect, FindsTheClosedFormOfTheForcedOscillator) {
  const ForcedOscillator problem;
  const IndirectSolution solution = solve_indirect(problem, direct_solution(problem));
  using std::numbers::pi;
  EXPECT_NEAR(solution.cost(), 1.0 / pi, 1e-14);
  for (const double t : {0.0, 0.6, 2.5, 4.0, 2.0 * pi}) {
    const IndirectPoint point = solution.at(t);
    EXPECT_NEAR(point.u[0], std::cos(t) / pi, 1e-13);
    EXPECT_NEAR(point.q[0], t * std::sin(t) / (2.0 * pi), 1e-13);
    EXPECT_NEAR(point.v[0], (std::sin(t) + t * std::cos(t)) / (2.0 * pi), 1e-13);
    EXPECT_NEAR(point.psi_p[0], -2.0 * std::cos(t) / pi, 1e-13);
    EXPECT_NEAR(point.psi_q[0], -2.0 * std::sin(t) / pi, 1e-13);
  }
}

TEST(SolveIndirect, AFreeMotionNeedsNoControl) {
  const tests::HarmonicOscillator problem;
  const IndirectSolution solution = solve_indirect(problem, direct_solution(problem));
  EXPECT_LT(std::abs(solution.cost()), 1e-20);
  EXPECT_NEAR(solution.at(0.4).q[0], std::cos(0.8), 1e-13);
  EXPECT_GE(solution.certified_digits(), 11.0);
}

class IndirectSolutionOf : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Problem> problem_ = tests::problem_named(GetParam());
  IndirectSolution solution_ = solve_indirect(*problem_, direct_solution(*problem_));
};

TEST_P(IndirectSolutionOf, TheProblemIsCertifiedToElevenDigits) {
  EXPECT_GE(solution_.certified_digits(), 11.0) << solution_.agreement().worst();
}

TEST_P(IndirectSolutionOf, TheProblemHasAConstantHamiltonianUnlessTimeEnters) {
  const auto drift = solution_.hamiltonian_drift();
  EXPECT_EQ(drift.has_value(), GetParam() != "moving_frame");
  if (drift) {
    EXPECT_LT(*drift, 1e-13);
  }
}

TEST_P(IndirectSolutionOf, TheProblemEndsWhereItShouldWhenItsControlIsReplayed) {
  EXPECT_LT(replay_error(*problem_, solution_.trajectory(), 1e-13).norm(), 1e-10);
}

TEST_P(IndirectSolutionOf, TheProblemGoesFromNodeToNodeWhenItsStateAndCostateAreIntegrated) {
  EXPECT_LT(shooting_defect(*problem_, solution_), 1e-12);
  CollocatedExtremal disturbed = solution_.extremal();
  disturbed.nodes(disturbed.nodes.rows() - 1, 1) *= 1.0 + 1e-6;  // one costate at one node
  EXPECT_GT(shooting_defect(*problem_, IndirectSolution(*problem_, disturbed, {})), 1e-8);
}

TEST_P(IndirectSolutionOf, TheProblemDoesNotDependOnTheDirectSolutionItStartedFrom) {
  const Trajectory other =
      tests::solve(*problem_, {"tangent", 2}, Grid::uniform(64), tests::common_start(*problem_)).trajectory;
  const IndirectSolution again = solve_indirect(*problem_, other);
  EXPECT_LT(compare(solution_, again, problem_->cost_scale()).worst(), 1e-12);
}

TEST_P(IndirectSolutionOf, TheProblemHasTheSlopeOfTheOptimalCostAsCostate) {
  // ∂J/∂p⁰ = ψ_p(0), by central differences of the problem with another initial velocity.
  LegendreTransform legendre{TracedProblem(*problem_)};
  const BoundaryState first = problem_->initial_state();
  const Eigen::VectorXd p = legendre.momentum(first.q, first.v, 0.0);
  const IndirectPoint start = solution_.at(0.0);
  const Trajectory near = solution_.trajectory();
  const auto cost_from = [&](Eigen::Index i, double moved) {
    Eigen::VectorXd momentum = p;
    momentum[i] += moved;
    const tests::WithEnds neighbour(*problem_, {first.q, legendre.velocity(first.q, momentum, 0.0, first.v)},
                                    problem_->final_state());
    constexpr IndirectOptions enough_for_the_cost{.tolerance = 1e-12, .most_intervals = 32};
    return solve_indirect(neighbour, near, enough_for_the_cost).cost();
  };
  for (Eigen::Index i = 0; i < p.size(); ++i) {
    constexpr double step = 1e-3;
    const auto central = [&](double e) { return (cost_from(i, e) - cost_from(i, -e)) / (2.0 * e); };
    const double slope = (4.0 * central(step / 2.0) - central(step)) / 3.0;
    EXPECT_NEAR(slope, start.psi_p[i], 1e-7 * start.psi_p.norm()) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Every, IndirectSolutionOf,
                         testing::Values("orbital_transfer", "two_link_manipulator", "moving_frame",
                                         "relativistic_spring"),
                         [](const auto& instance) { return instance.param; });

TEST(SolveIndirect, ACostLinearInTheControlIsRefused) {
  const Trajectory start = direct_solution(tests::DoubleIntegrator());
  const WithCost problem([](const Expression& u) { return u; });
  tests::expect_error_naming({"convex"}, [&] { static_cast<void>(solve_indirect(problem, start)); });
}

TEST(SolveIndirect, AMaximumOfTheHamiltonianIsRefused) {
  const Trajectory start = direct_solution(tests::DoubleIntegrator());
  const WithCost problem([](const Expression& u) { return -0.5 * u * u; });
  tests::expect_error_naming({"minimise", "convex"}, [&] { static_cast<void>(solve_indirect(problem, start)); });
}

TEST(SolveIndirect, WhatTheMaximumPrincipleHereDoesNotCoverIsRefusedByName) {
  using Statement = tests::Restated::Statement;
  const tests::DoubleIntegrator base;
  const auto refuses = [&](const std::string& named, const std::function<void(Statement&)>& change) {
    tests::expect_error_naming({named, base.name()},
                               [&] { static_cast<void>(solve_indirect(tests::Restated(base, change), Trajectory())); });
  };
  refuses("free or bounded ends", [](Statement& s) { s.last.free_velocity(0); });
  refuses("a free horizon", [](Statement& s) { s.horizon = {0.5, 2.0}; });
  refuses("bounds on the controls", [](Statement& s) { s.u = tests::all_between(1, -5.0, 5.0); });
  refuses("bounds on the state", [](Statement& s) { s.v = tests::all_between(1, -5.0, 5.0); });
  refuses("path constraints", [](Statement& s) { s.path_constraints = [](const ControlledState& x) { return x.q; }; });
  refuses("boundary conditions",
          [](Statement& s) { s.conditions = [](const State&, const State& last) { return last.v; }; });
  refuses("a final cost", [](Statement& s) { s.final_cost = [](const State& last) { return last.q[0]; }; });
}

TEST(SolveIndirect, AStartWithoutCostatesOrOfAnotherProblemIsRefused) {
  const tests::DoubleIntegrator problem;
  Trajectory start = direct_solution(problem);
  const ForcedOscillator other;
  tests::expect_error_naming({"does not match the sizes or the horizon", "forced_oscillator"},
                             [&] { static_cast<void>(solve_indirect(other, start)); });
  start.psi_q.resize(0, 0);
  tests::expect_error_naming({"costates"}, [&] { static_cast<void>(solve_indirect(problem, start)); });
}

TEST(SolveIndirect, TooFewIntervalsAreSaidToReachWhatTheyReach) {
  const auto problem = make_problem("two_link_manipulator");
  const Trajectory start = direct_solution(*problem);
  const IndirectSolution coarse = solve_indirect(*problem, start, {.tolerance = 1e-12, .most_intervals = 16});
  const IndirectSolution fine = solve_indirect(*problem, start);
  EXPECT_LT(coarse.certified_digits(), 9.0);
  // What is certified is true: the distance to a finer solution is not larger.
  EXPECT_LT(compare(coarse, fine, 1.0).worst(), coarse.agreement().worst());
  tests::expect_error_naming({"at least"},
                             [&] { static_cast<void>(solve_indirect(*problem, start, {.most_intervals = 8})); });
}

TEST(IndirectSolution, SolvesItsOwnProblemAndNoOther) {
  for (const std::string name : {"orbital_transfer", "two_link_manipulator"}) {
    const auto problem = make_problem(name);
    const IndirectSolution solution = solve_indirect(*problem, direct_solution(*problem));
    EXPECT_LT(boundary_value_residual(*problem, solution), 1e-12) << name;
    const auto other = make_problem(name);
    const Parameter& last = other->parameters().back();
    other->set_parameter(last.name, last.value * (1.0 + 1e-6));
    if (name == "orbital_transfer") other->set_parameter("target_altitude", 330.01);  // its last one is a unit only
    EXPECT_GT(boundary_value_residual(*other, solution), 1e-8) << name;
    // Another cost leaves state equations and ends as they are.
    EXPECT_GT(boundary_value_residual(WithDoubleCost(*problem), solution), 1e-2) << name;
  }
  const auto orbit = make_problem("orbital_transfer");
  const tests::DoubleIntegrator small;
  const IndirectSolution solution = solve_indirect(small, direct_solution(small));
  tests::expect_error_naming({"does not belong to"},
                             [&] { static_cast<void>(boundary_value_residual(*orbit, solution)); });
}

TEST(IndirectSolution, IsTheSameFromItsNumbers) {
  const tests::DoubleIntegrator problem;
  const IndirectSolution solution = solve_indirect(problem, direct_solution(problem));
  const IndirectSolution again(problem, solution.extremal(), solution.agreement());
  EXPECT_EQ(compare(solution, again, 1.0).worst(), 0.0);
  EXPECT_EQ(again.certified_digits(), solution.certified_digits());
  CollocatedExtremal cut = solution.extremal();
  cut.rates.conservativeResize(cut.rates.rows(), cut.rates.cols() - 1);
  tests::expect_error_naming({"wrong size"}, [&] { IndirectSolution(problem, cut, {}); });
}

}  // namespace
}  // namespace dmocbench
