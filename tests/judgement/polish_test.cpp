#include "methods/judgement/polish.hpp"

#include <gtest/gtest.h>

#include "methods/judgement/confirm.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

TEST(Polish, CarriesALooseSolutionToRounding) {
  // A solver's first step solves a linear problem like the forced oscillator to rounding.
  for (const std::string& name : paper_problem_names()) {
    for (const std::string& method : paper_families()) {
      SCOPED_TRACE(testing::Message() << name << ' ' << method);
      const auto problem = make_problem(name);
      tests::Solved loose = tests::solve(*problem, {method, 2}, Grid::uniform(48), tests::common_start(*problem), 1e-6);
      const tests::Solved tight =
          tests::solve(*problem, {method, 2}, Grid::uniform(48), tests::common_start(*problem), 1e-11);
      constexpr int sufficient = 2;  // Newton's method doubles digits; steps behind these move what rounding left
      EXPECT_GE(polish(*loose.transcription, loose.solution, sufficient), 1);
      EXPECT_LT(tests::value_of(loose.solution.kkt_residual), 1e-9);
      EXPECT_LT(tests::value_of(loose.solution.constraint_violation), 1e-11);
      EXPECT_LT((loose.solution.primal - tight.solution.primal).lpNorm<Eigen::Infinity>(), 1e-7);
      EXPECT_NEAR(loose.solution.objective / tight.solution.objective, 1.0, 1e-11);
    }
  }
}

TEST(Polish, NeverMakesASolutionWorseThanRounding) {
  const auto problem = make_problem("two_link_manipulator");
  tests::Solved solved = tests::solve(*problem, {"dmoc", 1}, Grid::uniform(64), tests::common_start(*problem), 1e-11);
  polish(*solved.transcription, solved.solution);
  const double residual =
      std::max(tests::value_of(solved.solution.kkt_residual), tests::value_of(solved.solution.constraint_violation));
  polish(*solved.transcription, solved.solution);
  const double rounding =
      solved.transcription->rounding_floors().largest * solved.solution.multipliers.lpNorm<Eigen::Infinity>();
  EXPECT_LE(
      std::max(tests::value_of(solved.solution.kkt_residual), tests::value_of(solved.solution.constraint_violation)),
      std::max(residual, rounding));
}

TEST(Polish, KeepsActiveBoundsAndInequalities) {
  const tests::KnownProgram known = tests::hock_schittkowski().back();  // HS 71 has both
  tests::SmallProgram program(known.statement);
  SolverOptions loose;
  loose.tolerance = 1e-6;
  Solution solution = make_solver("ipopt", loose)->solve(program, known.start);
  ASSERT_EQ(solution.status, Status::solved);
  EXPECT_GE(polish(program, solution), 1);
  EXPECT_LT((solution.primal - known.optimum).lpNorm<Eigen::Infinity>(), 1e-8);
  EXPECT_LT(tests::value_of(solution.constraint_violation), 1e-12);
}

TEST(Polish, LeavesAloneWhatIsNotSolved) {
  const tests::KnownProgram known = tests::hock_schittkowski().back();
  tests::SmallProgram program(known.statement);
  Solution failed;
  failed.status = Status::iteration_limit;
  EXPECT_EQ(polish(program, failed), 0);
  EXPECT_EQ(settle(program, 1e-10, failed), 0);
}

/// The double integrator with a second control that pushes nothing and costs 1e-9 times ½ (u₂ - 1)²: where it is wrong
/// no residual shows it.
class IdleControl final : public tests::SmallProblem {
 public:
  IdleControl() : SmallProblem("idle_control", at(0.0, 0.0), at(1.0, 0.0), 1.0, 2) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return one(x.u[0]); }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    const Expression off = x.u[1] - 1.0;
    return 0.5 * x.u[0] * x.u[0] + 0.5e-9 * off * off;
  }
  [[nodiscard]] double cost_scale() const override { return 1.0; }
};

/// A transcription with its answer, tight.
tests::Solved solved_tightly(const Problem& problem, const std::string& method, Eigen::Index intervals) {
  return tests::solve(problem, {method, 1}, Grid::uniform(intervals), guessed_motion(problem), 1e-12);
}

TEST(Settle, ConfirmsCostAndStateWhereAControlAloneIsNotDetermined) {
  const IdleControl problem;
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    tests::Solved solved = solved_tightly(problem, method, 16);
    const auto idle = solved.transcription->blocks().unknown(Quantity::control, 0).index(1);
    Solution wrong = solved.solution;
    wrong.primal[idle + 3] = 0.5;
    confirm(*solved.transcription, 1e-10, wrong);
    EXPECT_EQ(wrong.status, Status::control_not_determined) << wrong.message;
    EXPECT_TRUE(is_solved(wrong.status));
    EXPECT_GE(settle(*solved.transcription, 1e-10, wrong), 1);
    EXPECT_EQ(wrong.status, Status::solved) << wrong.message;
    EXPECT_NEAR(wrong.primal[idle + 3], 1.0, 1e-6);
  }
}

TEST(Settle, AnswersWhatASolverLeftShortOfTheToleranceWhateverItCallsThat) {
  const tests::Pendulum problem;
  for (const Status status : {Status::step_failed, Status::not_confirmed, Status::acceptable}) {
    SCOPED_TRACE(name_of(status));
    tests::Solved solved = solved_tightly(problem, "dmoc", 16);
    Solution stopped = solved.solution;
    stopped.primal[5] += 1e-9;
    stopped.status = status;
    confirm(*solved.transcription, 1e-10, stopped);
    ASSERT_FALSE(is_solved(stopped.status));
    ASSERT_GT(tests::value_of(stopped.constraint_violation), 1e-9);
    EXPECT_GE(settle(*solved.transcription, 1e-10, stopped), 1);
    EXPECT_EQ(stopped.status, Status::solved) << stopped.message;
    EXPECT_LT((stopped.primal - solved.solution.primal).lpNorm<Eigen::Infinity>(), 1e-9);
  }
}

TEST(Settle, LeavesAloneWhatIsFarFromAnyAnswer) {
  const tests::Pendulum problem;
  tests::Solved solved = solved_tightly(problem, "dmoc", 16);
  Solution stopped = solved.solution;
  stopped.primal[5] += 1e-3;
  stopped.status = Status::step_failed;
  confirm(*solved.transcription, 1e-10, stopped);
  EXPECT_EQ(settle(*solved.transcription, 1e-10, stopped), 0);
  EXPECT_EQ(stopped.status, Status::step_failed);
}

/// A residual that the allowance for rounding covers is rounding only if a Newton step cannot reduce it.
TEST(Settle, LeavesNoMoreThanRoundingOfWhatIsAllowedAsRounding) {
  const tests::Pendulum problem;
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    constexpr double tolerance = 1e-13;
    tests::Solved solved = solved_tightly(problem, method, 512);
    Transcription& program = *solved.transcription;
    polish(program, solved.solution);
    Solution allowed = solved.solution;
    allowed.primal[100] += 2.0 * program.rounding_floors().largest / 512.0;
    judge_residuals(program, allowed);
    const double before = tests::value_of(allowed.constraint_violation);
    ASSERT_GT(before, confirmation_factor * tolerance);
    ASSERT_LE(scaled_residual(program, tolerance, allowed), confirmation_factor) << "the allowance covers it";
    EXPECT_GE(settle(program, tolerance, allowed), 1);
    EXPECT_LT(tests::value_of(allowed.constraint_violation), 0.5 * before);
    EXPECT_EQ(settle(program, tolerance, allowed), 0) << "no step reduces what is left";
  }
}

}  // namespace
}  // namespace dmocbench
