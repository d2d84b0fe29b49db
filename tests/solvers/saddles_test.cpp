// Symmetric guesses lead to saddle points; answers are minima all the same.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/judgement/polish.hpp"
#include "methods/solvers/batch/solve_batch.hpp"
#include "methods/solvers/prepared_solve.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/lane_transcription.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::SmallProblem;

/// L = ½|v|² - V(q), f = u, C = ½|u|² + C_q(q, v), Φ(q, v), from rest; a guess to one side.
class Crest : public SmallProblem {
 public:
  struct Statement {
    std::string name;
    std::vector<double> first;
    std::vector<double> last;  ///< of the guess where the end is free
    std::function<Expression(const ExpressionVector& q)> potential = {};
    std::function<Expression(const ControlledState&)> running_cost = {};
    std::function<Expression(const State&)> final_cost = {};
    bool has_free_end = true;
    double horizon = 2.0;
    double longest = 0.0;          ///< of a free horizon
    double largest_control = 0.0;  ///< none if 0
  };

  explicit Crest(Statement statement, double side = 0.0)
      : SmallProblem(statement.name, at_rest(statement.first), at_rest(statement.last), statement.horizon,
                     static_cast<Eigen::Index>(statement.first.size())),
        statement_(std::move(statement)),
        side_(side) {}

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression kinetic = 0.5 * x.v.dot(x.v);
    return statement_.potential ? kinetic - statement_.potential(x.q) : kinetic;
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    const Expression effort = 0.5 * x.u.dot(x.u);
    return statement_.running_cost ? effort + statement_.running_cost(x) : effort;
  }
  [[nodiscard]] Expression final_cost(const State& last) const override {
    return statement_.final_cost ? statement_.final_cost(last) : Expression(0.0);
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = SmallProblem::bounds();
    for (Eigen::Index i = 0; statement_.has_free_end && i < bounds.last.q.lower.size(); ++i) {
      bounds.last.free_configuration(i).free_velocity(i);
    }
    if (statement_.longest > 0.0) bounds.horizon = {0.5, statement_.longest};
    if (statement_.largest_control > 0.0) {
      const Eigen::VectorXd largest = Eigen::VectorXd::Constant(bounds.last.q.lower.size(), statement_.largest_control);
      bounds.u = {-largest, largest};
    }
    return bounds;
  }
  /// A bulge of the last coordinate, up to `side`.
  [[nodiscard]] MotionPoint guess(double t) const override {
    MotionPoint point = SmallProblem::guess(t);
    const double tau = t / statement_.horizon;
    point.q[point.q.size() - 1] += side_ * tau * (statement_.has_free_end ? tau : 4.0 * (1.0 - tau));
    return point;
  }

 private:
  static BoundaryState at_rest(const std::vector<double>& q) {
    return BoundaryState::at_rest(Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size())));
  }

  Statement statement_;
  double side_;
};

Expression well(const Expression& x) { return -2.0 * x * x + 0.25 * x * x * x * x; }

/// A hill that a straight line from (-1, 0) to (1, 0) crosses at its top.
Expression hill(const ExpressionVector& q) { return 4.0 * exp(-4.0 * q.dot(q)); }

/// Statements whose symmetric guess is stationary and not a minimum.
std::vector<Crest::Statement> statements() {
  const auto of_end = [](const State& x) { return well(x.q[0]); };
  const auto over_hill = [](const ControlledState& x) { return hill(x.q); };
  const auto from_circle = [](const ControlledState& x) { return x.q.dot(x.q) - 1.0; };
  using Points = std::vector<double>;
  const Points left{-1.0, 0.0};
  const Points right{1.0, 0.0};
  return {{.name = "crest", .first = {0.0}, .last = {0.0}, .final_cost = of_end},
          {.name = "bounded_crest", .first = {0.0}, .last = {0.0}, .final_cost = of_end, .largest_control = 0.8},
          {.name = "upright_pendulum",
           .first = {0.0},
           .last = {0.0},
           .potential = [](const ExpressionVector& q) { return cos(q[0]); },
           .final_cost = [](const State& x) { return 2.0 * cos(x.q[0]) + 0.5 * x.v[0] * x.v[0]; }},
          {.name = "two_masses_that_part",
           .first = {0.0, 0.0},
           .last = {0.0, 0.0},
           .final_cost = [](const State& x) { return well(x.q[0] - x.q[1]) + 0.5 * x.q[0] * x.q[0]; }},
          {.name = "run_from_a_crest",
           .first = {0.0},
           .last = {0.0},
           .running_cost = [](const ControlledState& x) { return well(x.q[0]); }},
          {.name = "hill_on_the_way", .first = left, .last = right, .running_cost = over_hill, .has_free_end = false},
          {.name = "bounded_hill_on_the_way",
           .first = left,
           .last = right,
           .running_cost = over_hill,
           .has_free_end = false,
           .largest_control = 3.0},
          {.name = "hill_in_any_time",
           .first = left,
           .last = right,
           .running_cost = [](const ControlledState& x) { return 1.0 + hill(x.q); },
           .has_free_end = false,
           .longest = 6.0},
          {.name = "two_ways_round",
           .first = left,
           .last = right,
           .running_cost = [from_circle](const ControlledState& x) { return 8.0 * from_circle(x) * from_circle(x); },
           .has_free_end = false}};
}

Solution solve(const Problem& problem, const tests::Scheme& scheme, const std::string& solver) {
  const auto program = tests::transcribe(problem, scheme, Grid::uniform(16));
  return make_solver(solver)->solve(*program, sample(*program, guessed_motion(problem)));
}

class SaddlesOf : public testing::TestWithParam<std::tuple<const char*, int>> {};

INSTANTIATE_TEST_SUITE_P(All, SaddlesOf,
                         testing::Combine(testing::Values("dmoc", "hamiltonian", "tangent"), testing::Values(1, 2)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param)) + std::to_string(std::get<1>(test.param));
                         });

/// From the symmetric guess the cost is that of the minimum to which an asymmetric guess leads. The quadratic programs
/// of `sqp` may fail next to a saddle; then it does not report "solved".
TEST_P(SaddlesOf, ASymmetricGuessAreLeftForAMinimumWhateverTheSolver) {
  const auto& [method, stages] = GetParam();
  const tests::Scheme scheme{method, stages};
  for (const Crest::Statement& statement : statements()) {
    SCOPED_TRACE(statement.name);
    const Solution aside = solve(Crest(statement, 0.5), scheme, "ipopt");
    ASSERT_EQ(aside.status, Status::solved) << aside.message;
    for (const char* solver : {"auto", "interior_point", "ipopt", "sqp"}) {
      SCOPED_TRACE(solver);
      const Solution solution = solve(Crest(statement), scheme, solver);
      if (solver == std::string("sqp") && !is_solved(solution.status)) continue;
      EXPECT_TRUE(is_solved(solution.status)) << solution.message;
      EXPECT_NEAR(solution.objective, aside.objective, 1e-6 * std::abs(aside.objective)) << solution.message;
      EXPECT_FALSE(solution.curvature);
    }
  }
}

/// Next to the saddle of the first statement the cost falls on every grid, whatever round-off makes of its matrix.
TEST_P(SaddlesOf, ACrestAreLeftOnEveryGrid) {
  const auto& [method, stages] = GetParam();
  const Crest crest(statements().front());
  for (Eigen::Index intervals = 4; intervals <= 80; ++intervals) {
    const auto program = tests::transcribe(crest, {method, stages}, Grid::uniform(intervals));
    const Solution solution = make_solver("interior_point")->solve(*program, sample(*program, guessed_motion(crest)));
    EXPECT_TRUE(is_solved(solution.status)) << intervals << ": " << solution.message;
    EXPECT_LT(solution.objective / program->cost_scale(), -3.2) << intervals << ": " << solution.message;
  }
}

/// A direction without curvature next to the one with negative curvature: two motors that turn the same.
class TwoMotors final : public SmallProblem {
 public:
  TwoMotors() : SmallProblem("two_motors", at(0.0, 0.0), at(0.0, 0.0), 2.0, 2) {}
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return one(x.u[0] + x.u[1]); }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * (x.u[0] + x.u[1]) * (x.u[0] + x.u[1]);
  }
  [[nodiscard]] Expression final_cost(const State& last) const override { return well(last.q[0]); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = SmallProblem::bounds();
    bounds.last.free_configuration(0).free_velocity(0);
    bounds.u = Bounds::all(2, -9.0, 9.0);
    return bounds;
  }
};

TEST_P(SaddlesOf, ASystemWithRedundantMotorsAreLeft) {
  const auto& [method, stages] = GetParam();
  const Solution solution = solve(TwoMotors(), {method, stages}, "interior_point");
  EXPECT_TRUE(is_solved(solution.status)) << solution.message;
  EXPECT_LT(solution.objective, 0.0) << solution.message;
}

/// A second coordinate whose effort costs `stiffness` times as much, and which stays where it is.
class StiffNeighbour final : public SmallProblem {
 public:
  explicit StiffNeighbour(double stiffness)
      : SmallProblem("stiff_neighbour", still(), still(), 2.0, 2), stiffness_(stiffness) {}
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * (x.u[0] * x.u[0] + stiffness_ * x.u[1] * x.u[1]);
  }
  [[nodiscard]] Expression final_cost(const State& last) const override { return well(last.q[0]); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = SmallProblem::bounds();
    bounds.last.free_configuration(0).free_velocity(0);
    return bounds;
  }

 private:
  static BoundaryState still() { return BoundaryState::at_rest(Eigen::VectorXd::Zero(2)); }

  double stiffness_;
};

TEST_P(SaddlesOf, ASystemWithAStiffCoordinateAreLeft) {
  const auto& [method, stages] = GetParam();
  const double minimum = solve(StiffNeighbour(1.0), {method, stages}, "interior_point").objective;
  EXPECT_LT(minimum, -1.0);
  for (const double stiffness : {1e7, 1e8, 1e10, 1e12}) {
    const Solution solution = solve(StiffNeighbour(stiffness), {method, stages}, "interior_point");
    EXPECT_TRUE(is_solved(solution.status)) << stiffness << ": " << solution.message;
    EXPECT_NEAR(solution.objective, minimum, 1e-6) << stiffness << ": " << solution.message;
  }
}

TEST(Saddles, OfAQuadrotorsFlipAreLeft) {
  const auto problem = make_problem("planar_quadrotor_flip");
  for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
    const auto program = tests::transcribe(*problem, {method, 1}, Grid::uniform(16));
    const Solution solution =
        make_solver("interior_point")->solve(*program, sample(*program, guessed_motion(*problem)));
    EXPECT_EQ(solution.status, Status::solved) << solution.message;
    EXPECT_LT(solution.objective / program->cost_scale(), 14.3702) << solution.message;
    EXPECT_FALSE(solution.curvature);
  }
}

TEST(Saddles, AreLeftByPreparedSolvesAndBatches) {
  const std::vector<Crest::Statement> all = statements();
  const auto statement = *std::ranges::find(all, "hill_on_the_way", &Crest::Statement::name);
  const Crest crest(statement);
  const auto program = tests::transcribe(crest, {"dmoc", 1}, Grid::uniform(16));
  const Eigen::VectorXd start = sample(*program, guessed_motion(crest));
  const double minimum = solve(Crest(statement, 0.5), {"dmoc", 1}, "ipopt").objective;
  PreparedSolve prepared(*program);
  EXPECT_NEAR(prepared.solve(start).objective, minimum, 1e-6 * std::abs(minimum));
  int begun = 0;
  static_cast<void>(solve_batch(
      *program, lanes_of(*program), start,
      [&](std::size_t /*index*/, BatchInstance& instance) {
        instance.start = start;
        return begun++ < 3;
      },
      [&](std::size_t /*index*/, const Solution& solution) {
        EXPECT_NEAR(solution.objective, minimum, 1e-6 * std::abs(minimum)) << solution.message;
      }));
}

/// Weak controls: on fine grids the solver stops near the saddle, and Newton steps would lead there.
TEST(Saddles, AreNoAnswersAfterNewtonStepsEither) {
  Crest::Statement statement = statements().front();
  statement.largest_control = 0.3;
  const Crest weak(statement, 0.6);
  for (const Eigen::Index intervals : {1000, 1500, 3000}) {
    const auto program = tests::transcribe(weak, {"dmoc", 1}, Grid::uniform(intervals));
    const auto solver = make_solver("auto");
    Solution solution = solver->solve(*program, sample(*program, guessed_motion(weak)));
    settle(*program, solver->options().tolerance, solution);
    const bool is_low = solution.objective / program->cost_scale() < -0.5;
    EXPECT_TRUE(is_low || !is_solved(solution.status)) << intervals << ": " << solution.message;
  }
}

/// Without a lower end of the cost no solve next to the saddle ends.
TEST(Saddles, NextToWhichTheCostHasNoEndAreNoMinima) {
  Crest::Statement statement = statements().front();
  statement.final_cost = [](const State& x) { return -2.0 * x.q[0] * x.q[0]; };
  const Solution solution = solve(Crest(statement), {"dmoc", 1}, "interior_point");
  EXPECT_EQ(solution.status, Status::stationary) << solution.message;
  EXPECT_TRUE(solution.curvature);
  EXPECT_FALSE(is_solved(solution.status));
}

}  // namespace
}  // namespace dmocbench
