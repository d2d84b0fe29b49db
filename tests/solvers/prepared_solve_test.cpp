// A program that is solved again and again.

#include "methods/solvers/prepared_solve.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "methods/mechanics/parameter_scope.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

std::unique_ptr<Transcription> transcribe(const Problem& problem, const std::string& method, int intervals,
                                          const std::vector<std::string>& open = {}) {
  return std::make_unique<Transcription>(problem, *make_element(method), gauss_tableau(1), Grid::uniform(intervals),
                                         OpenParameters{open});
}

Solution solved_anew(Transcription& program, const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers = {},
                     const std::string& solver = "interior_point") {
  return make_solver(solver)->solve(program, start, multipliers);
}

void expect_same(const Solution& ours, const Solution& theirs, const std::string& label) {
  EXPECT_EQ(ours.status, theirs.status) << label;
  EXPECT_EQ(ours.message, theirs.message) << label;
  EXPECT_EQ(ours.solver, theirs.solver) << label;
  EXPECT_EQ(ours.major_iterations, theirs.major_iterations) << label;
  EXPECT_EQ(ours.linear_systems, theirs.linear_systems) << label;
  EXPECT_EQ(ours.total_evaluations(), theirs.total_evaluations()) << label;
  EXPECT_EQ(ours.objective, theirs.objective) << label;
  EXPECT_EQ(ours.primal, theirs.primal) << label;
  EXPECT_EQ(ours.multipliers, theirs.multipliers) << label;
  EXPECT_EQ(ours.kkt_residual, theirs.kkt_residual) << label;
  EXPECT_EQ(ours.constraint_violation, theirs.constraint_violation) << label;
}

/// On the paper's first problem.
class PreparedOrbit : public testing::Test {
 protected:
  std::unique_ptr<Problem> problem_ = make_problem("orbital_transfer");
  std::unique_ptr<Transcription> program_ = transcribe(*problem_, "dmoc", 16);
  Eigen::VectorXd start_ = sample(*program_, guessed_motion(*problem_));
  PreparedSolve prepared_{*program_};
};

TEST(PreparedSolve, GivesBitByBitWhatASolveOfItsOwnGivesHoweverOften) {
  for (const std::string name : {"orbital_transfer", "two_link_manipulator", "cart_pole", "brachistochrone",
                                 "two_link_with_motors", "spring_arm", "hanging_chain", "waypoints"}) {
    const auto problem = make_problem(name);
    for (const std::string& method : paper_families()) {
      const auto program = transcribe(*problem, method, 20);
      const Eigen::VectorXd start = sample(*program, guessed_motion(*problem));
      const Solution cold = solved_anew(*program, start);
      const Solution warm = solved_anew(*program, cold.primal, cold.multipliers);
      PreparedSolve prepared(*program);
      const std::string label = std::string(name).append(" ").append(method);
      expect_same(prepared.solve(start), cold, label + " first");
      expect_same(prepared.solve(cold.primal, cold.multipliers), warm, label + " warm");
      expect_same(prepared.solve(start), cold, label + " again");
    }
  }
}

TEST(PreparedSolve, FollowsTheValuesOfItsProgram) {
  const auto problem = make_problem("two_link_manipulator");
  const auto program = transcribe(*problem, "dmoc", 16, {"mass_1", "gravity"});
  PreparedSolve prepared(*program);
  const Eigen::VectorXd start = sample(*program, guessed_motion(*program));
  for (const double mass : {1.0, 1.1, 0.9}) {
    program->set_parameter("mass_1", mass);
    program->set_initial_state(BoundaryState::at_rest(Eigen::Vector2d(-1.5 * mass, -1.5)));
    const Solution& solution = prepared.solve(start);
    ASSERT_TRUE(is_solved(solution.status)) << solution.message;
    const auto other = make_problem("two_link_manipulator");
    other->set_parameter("mass_1", mass);
    const auto anew = transcribe(*other, "dmoc", 16);
    anew->set_initial_state(BoundaryState::at_rest(Eigen::Vector2d(-1.5 * mass, -1.5)));
    const Solution theirs = solved_anew(*anew, start);
    EXPECT_EQ(solution.major_iterations, theirs.major_iterations);
    EXPECT_NEAR(solution.objective, theirs.objective, 1e-10 * std::abs(theirs.objective));
    EXPECT_TRUE(solution.primal.isApprox(theirs.primal, 1e-8));
  }
}

TEST(PreparedSolve, FollowsTheBoundsOfItsProgram) {
  const auto problem = make_problem("cart_pole");
  const auto program = transcribe(*problem, "dmoc", 16);
  PreparedSolve prepared(*program);
  const Eigen::VectorXd start = sample(*program, guessed_motion(*program));
  static_cast<void>(prepared.solve(start));
  ProblemBounds bounds = program->bounds();
  bounds.u.lower *= 0.9;
  bounds.u.upper *= 0.9;
  program->set_bounds(bounds);
  expect_same(prepared.solve(start), solved_anew(*program, start), "narrower");
}

TEST_F(PreparedOrbit, TakesItsOwnSolutionAsAStart) {
  const Solution cold = prepared_.solve(start_);
  const Solution& warm = prepared_.solve(prepared_.solution().primal, prepared_.solution().multipliers);
  EXPECT_TRUE(is_solved(warm.status)) << warm.message;
  EXPECT_LE(*warm.major_iterations, 2);
  EXPECT_NEAR(warm.objective, cold.objective, 1e-12);
}

TEST(PreparedSolve, BeginsWithTheBarrierParameterThatItIsGiven) {
  const auto problem = make_problem("cart_pole");
  const auto program = transcribe(*problem, "dmoc", 16);
  const Eigen::VectorXd start = sample(*program, guessed_motion(*problem));
  PreparedSolve prepared(*program);
  const Solution cold = prepared.solve(start);
  ASSERT_TRUE(cold.barrier_parameter.has_value());
  EXPECT_LE(*cold.barrier_parameter, 1e-9);
  const Solution far = make_solver("interior_point")->solve(*program, cold.primal, cold.multipliers, 1e-3);
  expect_same(prepared.solve(cold.primal, cold.multipliers, 1e-3), far, "1e-3");
  const Solution& warm = prepared.solve(cold.primal, cold.multipliers, cold.barrier_parameter);
  EXPECT_TRUE(is_solved(warm.status)) << warm.message;
  EXPECT_LT(warm.major_iterations, far.major_iterations);
}

TEST_F(PreparedOrbit, HasNoBarrierParameterWithoutBounds) {
  const Solution cold = prepared_.solve(start_);
  EXPECT_FALSE(cold.barrier_parameter.has_value());
  const Solution plain = prepared_.solve(cold.primal, cold.multipliers);
  expect_same(prepared_.solve(cold.primal, cold.multipliers, 1e-3), plain, "without meaning");
}

TEST_F(PreparedOrbit, JudgesLikeEverySolveOrByResidualsAlone) {
  PreparedSolve by_residuals(*program_, "interior_point", {}, PreparedSolve::Judgement::residuals_only);
  EXPECT_TRUE(prepared_.solve(start_).correction.has_value());
  EXPECT_FALSE(by_residuals.solve(start_).correction.has_value());
  EXPECT_EQ(by_residuals.solution().kkt_residual, prepared_.solution().kkt_residual);
  EXPECT_TRUE(is_solved(by_residuals.solution().status));
}

TEST_F(PreparedOrbit, CallsOtherSolversAsTheyAre) {
  for (const std::string solver : {"ipopt", "sqp", "auto"}) {
    PreparedSolve prepared(*program_, solver);
    const Solution theirs = solved_anew(*program_, start_, {}, solver);
    for (int i = 0; i < 2; ++i) EXPECT_EQ(prepared.solve(start_).primal, theirs.primal) << solver;
    EXPECT_TRUE(is_solved(prepared.solve(theirs.primal, theirs.multipliers).status)) << solver;
  }
}

TEST_F(PreparedOrbit, GoesOnAfterASolveThatFails) {
  const Eigen::VectorXd nowhere = Eigen::VectorXd::Constant(start_.size(), std::nan(""));
  const Solution theirs = solved_anew(*program_, start_);
  EXPECT_EQ(prepared_.solve(nowhere).status, Status::evaluation_failed);
  expect_same(prepared_.solve(start_), theirs, "after NaN");
}

TEST_F(PreparedOrbit, RefusesWrongSizesInASentence) {
  tests::expect_error_naming({"start", "3", "variables"},
                             [&] { static_cast<void>(prepared_.solve(Eigen::VectorXd::Zero(3))); });
  tests::expect_error_naming({"multipliers", "2", "constraints"},
                             [&] { static_cast<void>(prepared_.solve(start_, Eigen::VectorXd::Zero(2))); });
  for (const double mu : {0.0, -1.0, std::nan("")}) {
    tests::expect_error_naming({"barrier parameter", "positive"},
                               [&] { static_cast<void>(prepared_.solve(start_, Eigen::VectorXd(), mu)); });
  }
  tests::expect_error_naming({"no solver", "simplex"},
                             [&] { const PreparedSolve none(*program_, std::string_view("simplex")); });
}

TEST(PreparedSolves, OfOneProblemSolveInSeveralThreads) {
  const auto problem = make_problem("two_link_manipulator");
  const std::vector<double> masses{0.9, 1.0, 1.1};
  const auto costs_from = [&](std::size_t first) {
    const auto program = transcribe(*problem, "dmoc", 16, {"mass_1"});
    PreparedSolve prepared(*program);
    const Eigen::VectorXd start = sample(*program, guessed_motion(*program));
    std::vector<double> costs(masses.size());
    for (std::size_t i = 0; i < masses.size(); ++i) {
      const std::size_t which = (first + i) % masses.size();
      program->set_parameter("mass_1", masses[which]);
      costs[which] = prepared.solve(start).objective;
    }
    return costs;
  };
  const std::vector<double> expected = costs_from(0);
  std::vector<std::vector<double>> found(3);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < found.size(); ++t) threads.emplace_back([&, t] { found[t] = costs_from(t); });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<double>& costs : found) EXPECT_EQ(costs, expected);
}

}  // namespace
}  // namespace dmocbench
