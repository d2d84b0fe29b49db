#include "methods/judgement/polish.hpp"

#include <gtest/gtest.h>

#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
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

}  // namespace
}  // namespace dmocbench
