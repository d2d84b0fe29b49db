// Infeasible is said where no motion near the start meets the constraints, by every solver in the same way.
#include "methods/judgement/least_violation.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/judgement/kkt_residual.hpp"
#include "methods/transcription/describe_violation.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/cart_pole.hpp"
#include "problems/hovercraft.hpp"
#include "problems/orbital_transfer.hpp"
#include "problems/planar_quadrotor.hpp"
#include "problems/spherical_pendulum.hpp"
#include "problems/two_link_manipulator.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::all_between;
using tests::everywhere;
using tests::HyperVector;
using tests::Restated;
using tests::SmallProgram;
using tests::vector;
using Statement = Restated::Statement;

/// x₁ - 3 x₂ = values₁ and x₁² + x₂ = values₂ within |x| <= 2.
SmallProgram bounded_rows(double first, double second) {
  return SmallProgram({[](const HyperVector& x) { return x[0]; },
                       [](const HyperVector& x) {
                         return HyperVector{x[0] - 3.0 * x[1], x[0] * x[0] + x[1]};
                       },
                       everywhere(2, -2.0), everywhere(2, 2.0), vector({first, second}), vector({first, second})});
}

/// Half the squared violation on a fine lattice within the bounds.
double least_on_a_lattice(SmallProgram& program) {
  double least = unbounded;
  Eigen::VectorXd rows(2);
  constexpr int cells = 800;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      program.constraints(vector({-2.0 + 4.0 * i / cells, -2.0 + 4.0 * j / cells}), rows);
      least = std::min(least, 0.5 * (rows - program.constraint_lower()).squaredNorm());
    }
  }
  return least;
}

TEST(ViolationDescent, EndsAtTheLeastViolationThatALatticeFinds) {
  for (const auto& [first, second] : {std::pair{12.0, 1.0}, std::pair{0.5, 9.0}, std::pair{-3.0, -6.0}}) {
    SmallProgram program = bounded_rows(first, second);
    ViolationDescent descent(program, vector({0.7, 0.1}));
    for (int i = 0; i < 100 && !descent.is_at_least_violation(); ++i) static_cast<void>(descent.step());
    EXPECT_TRUE(is_point_of_least_violation(program, descent.point()));
    Eigen::VectorXd rows(2);
    program.constraints(descent.point(), rows);
    EXPECT_NEAR(0.5 * (rows - program.constraint_lower()).squaredNorm(), least_on_a_lattice(program), 1e-2);
  }
}

TEST(ViolationDescent, MeetsRowsThatCanBeMetAndLeavesBoundsOnTheWay) {
  SmallProgram program = bounded_rows(1.0, 2.0);
  ViolationDescent descent(program, vector({-2.0, 2.0}));
  for (int i = 0; i < 100 && descent.violation() > 1e-12; ++i) {
    static_cast<void>(descent.step());
    EXPECT_LT(descent.point().lpNorm<Eigen::Infinity>(), 2.0);
  }
  EXPECT_LT(constraint_violation(program, descent.point()), 1e-12);
}

Solution ended(Status status, const Eigen::VectorXd& point) {
  Solution solution;
  solution.status = status;
  solution.primal = point;
  return solution;
}

TEST(Infeasibility, IsNotBelievedWhereTheViolationCanBeReducedToNothing) {
  SmallProgram program = bounded_rows(1.0, 2.0);
  Solution solution = ended(Status::infeasible, vector({-1.0, 1.0}));
  judge_infeasibility(CountedProgram(program), {}, solution.primal, solution);
  EXPECT_EQ(solution.status, Status::step_failed);
  EXPECT_EQ(solution.primal, vector({-1.0, 1.0}));
  EXPECT_NE(solution.message, "");
}

/// x² (x - 3) + 5 = 0 has one root, at x < 0; at x = 2 its left-hand side has a local minimum, of 1.
TEST(Infeasibility, IsNotSaidWhereDescentFromTheStartMeetsTheRows) {
  SmallProgram program = tests::equality_program(
      [](const HyperVector& x) { return 0.0 * x[0]; },
      [](const HyperVector& x) { return HyperVector{x[0] * x[0] * (x[0] - 3.0) + 5.0}; }, 1, vector({0.0}));
  Solution solution = ended(Status::infeasible, vector({2.0}));  // the violation is 1 there, and least nearby
  judge_infeasibility(CountedProgram(program), {}, vector({2.0}), solution);
  EXPECT_EQ(solution.status, Status::infeasible);
  solution = ended(Status::infeasible, vector({2.0}));
  judge_infeasibility(CountedProgram(program), {}, vector({-2.0}), solution);
  EXPECT_EQ(solution.status, Status::step_failed);
  EXPECT_NE(solution.message.find("feasible"), std::string::npos) << solution.message;
}

TEST(Infeasibility, IsSaidAtThePointWhereAFailedStepLeadsToLeastViolation) {
  SmallProgram program = bounded_rows(12.0, 1.0);
  Solution solution = ended(Status::step_failed, vector({0.0, 0.0}));
  judge_infeasibility(CountedProgram(program), {}, solution.primal, solution);
  EXPECT_EQ(solution.status, Status::infeasible);
  EXPECT_TRUE(is_point_of_least_violation(program, solution.primal));
}

/// A damped oscillator to rest in the least time, |u| <= 1: feasible from T = 7.03 on, closed form.
class DampedOscillator final : public tests::SmallProblem {
 public:
  DampedOscillator() : SmallProblem("damped_oscillator", at(6.0, 0.0), at(0.0, 0.0), 6.0, 1) {}
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = SmallProblem::bounds();
    bounds.u = all_between(1, -1.0, 1.0);
    bounds.horizon = {.lower = 0.5, .upper = 50.0};
    return bounds;
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v[0] * x.v[0] - 0.5 * x.q[0] * x.q[0];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0] - 0.2 * x.v[0]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& /*x*/) const override { return 0.0; }
  [[nodiscard]] Expression final_cost(const State& last) const override { return last.t; }
};

TEST(Infeasibility, IsNotSaidOfLinearDynamicsWhereOnlyTheHorizonIsTooShort) {
  const DampedOscillator problem;
  for (const long long intervals : {224, 256, 320}) {
    for (const std::string& method : paper_families()) {
      Transcription program(problem, *make_element(method), make_tableau("gauss", 1), Grid::uniform(intervals));
      const Solution solution = make_solver("auto")->solve(program, sample(program, guessed_motion(problem)));
      EXPECT_TRUE(is_solved(solution.status)) << method << ' ' << intervals << ": " << solution.message;
      EXPECT_NEAR(solution.objective / program.cost_scale(), 7.0258595, 2e-3) << method << ' ' << intervals;
    }
  }
}

TEST(Infeasibility, IsNeverSaidWhereRowsHoldOrALimitEndedTheSolve) {
  SmallProgram reachable = bounded_rows(1.0, 2.0);
  Solution failed = ended(Status::step_failed, vector({1.0, 0.0}));  // violated by 1
  judge_infeasibility(CountedProgram(reachable), {}, failed.primal, failed);
  EXPECT_EQ(failed.status, Status::step_failed);

  SmallProgram program = bounded_rows(12.0, 1.0);
  for (const Status limit : {Status::iteration_limit, Status::time_limit, Status::interrupted}) {
    Solution solution = ended(limit, vector({0.0, 0.0}));
    judge_infeasibility(CountedProgram(program), {}, solution.primal, solution);
    EXPECT_EQ(solution.status, limit);
  }
}

/// A problem that nothing near its guess meets, and words of the row that is to be named.
struct Unreachable {
  std::string label;
  std::function<std::unique_ptr<Problem>()> problem;
  std::string names;
  bool has_affine_constraints = false;  ///< a certificate
};

const tests::DoubleIntegrator double_integrator;
const tests::Pendulum pendulum;
const TwoLinkManipulator manipulator;
const SphericalPendulum spherical_pendulum;
const Hovercraft hovercraft;
const OrbitalTransfer orbit;

std::function<std::unique_ptr<Problem>()> restated(const Problem& base, const std::function<void(Statement&)>& state) {
  return [&base, state] { return std::make_unique<Restated>(base, state); };
}

std::unique_ptr<Problem> hurried_quadrotor() {
  auto problem = std::make_unique<PlanarQuadrotor>();
  problem->set_parameter("bounded", 1.0);
  problem->set_parameter("horizon", 0.2);
  return problem;
}

std::unique_ptr<Problem> hurried_cart_pole() {
  auto problem = std::make_unique<CartPole>();
  problem->set_parameter("horizon", 0.3);
  return problem;
}

/// v >= 1 and v <= -1, also at the ends, whose velocity is free.
void contradict(Statement& s) {
  s.first.free_velocity(0);
  s.last.free_velocity(0);
  s.path_constraints = [](const ControlledState& x) {
    ExpressionVector h(2);
    h << x.v[0] - 1.0, -1.0 - x.v[0];
    return h;
  };
}

const std::vector<Unreachable>& unreachable_problems() {
  static const std::vector<Unreachable> problems{
      {"cart_pole_in_too_little_time", hurried_cart_pole, "q["},
      {"double_integrator_with_a_weak_control",
       restated(double_integrator, [](Statement& s) { s.u = all_between(1, -3.0, 3.0); }), "q[0]", true},
      {"double_integrator_below_its_target",
       restated(double_integrator, [](Statement& s) { s.v = all_between(1, -0.5, 0.5); }), "q[0]", true},
      {"double_integrator_with_contradicting_rows", restated(double_integrator, contradict), "path_constraints[", true},
      {"pendulum_with_a_weak_torque", restated(pendulum, [](Statement& s) { s.u = all_between(1, -0.5, 0.5); }),
       "q[0]"},
      {"manipulator_with_weak_torques", restated(manipulator, [](Statement& s) { s.u = all_between(2, -1e-2, 1e-2); }),
       "q["},
      {"manipulator_with_contradicting_rows", restated(manipulator, contradict), "path_constraints["},
      {"quadrotor_in_too_little_time", hurried_quadrotor, "q["},
      {"spherical_pendulum_with_weak_forces",
       restated(spherical_pendulum, [](Statement& s) { s.u = all_between(2, -0.1, 0.1); }), "q["},
      {"hovercraft_with_weak_forces", restated(hovercraft, [](Statement& s) { s.u = all_between(2, -0.01, 0.01); }),
       "q["},
      {"orbit_with_a_weak_thrust", restated(orbit, [](Statement& s) { s.u = all_between(1, -1e-4, 1e-4); }), "q["},
  };
  return problems;
}

class UnreachableProblems : public testing::TestWithParam<Unreachable> {};

TEST_P(UnreachableProblems, EndWithoutAMotionAndWithTheRowNamedWhateverTheSolver) {
  const std::unique_ptr<Problem> problem = GetParam().problem();
  for (const char* solver : {"ipopt", "interior_point", "auto"}) {
    for (const std::string& method : paper_families()) {
      SCOPED_TRACE(std::string(solver) + " " + method);
      Transcription program(*problem, *make_element(method), make_tableau("gauss", 1), Grid::uniform(24));
      const Solution solution = make_solver(solver)->solve(program, sample(program, guessed_motion(*problem)));
      EXPECT_EQ(solution.status, Status::infeasible) << solution.message;
      EXPECT_TRUE(is_point_of_least_violation(program, solution.primal));
      EXPECT_EQ(solution.message.find(GetParam().has_affine_constraints ? "The program " : "No trajectory was "), 0U)
          << solution.message;
      const std::string words = describe_violation(*problem, program, solution);
      EXPECT_NE(words.find("The largest violation is "), std::string::npos) << words;
      EXPECT_NE(words.find(GetParam().names), std::string::npos) << words;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, UnreachableProblems, testing::ValuesIn(unreachable_problems()),
                         [](const auto& tested) { return tested.param.label; });

}  // namespace
}  // namespace dmocbench
