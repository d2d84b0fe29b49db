#include <string>

#include <gtest/gtest.h>

#include "methods/solvers/kkt/intervals/interval_kkt.hpp"
#include "methods/solvers/kkt/intervals/segment_kernel.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/registry.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/shifted_system.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench::kkt {
namespace {

void expect_same_steps(const Problem& problem, const tests::Scheme& scheme, Eigen::Index intervals) {
  SCOPED_TRACE(problem.name() + ", " + scheme.label() + ", N = " + std::to_string(intervals));
  Transcription program(problem, *make_element(scheme.method), scheme.tableau(), Grid::uniform(intervals));
  const tests::KktNumbers numbers = tests::shifted_system(program, sample(program, guessed_motion(problem)));
  Eigen::VectorXd baseline;
  for (const InstructionSet set : available_instruction_sets()) {
    const auto kkt = IntervalKkt::make(program, segment_kernels_of(set)).value();
    Eigen::VectorXd primal(numbers.gradient.size());
    Eigen::VectorXd multipliers(numbers.rows.size());
    ASSERT_EQ(kkt->solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers}),
              FactorisationStatus::solved);
    Eigen::VectorXd steps(primal.size() + multipliers.size());
    steps << primal, multipliers;
    if (set == InstructionSet::baseline) {
      baseline = steps;
      continue;
    }
    const Eigen::Index n = primal.size();
    EXPECT_LT((steps - baseline).head(n).lpNorm<Eigen::Infinity>(), 1e-9 * baseline.head(n).lpNorm<Eigen::Infinity>())
        << name_of(set);
    EXPECT_LT((steps - baseline).tail(steps.size() - n).lpNorm<Eigen::Infinity>(),
              1e-9 * baseline.tail(steps.size() - n).lpNorm<Eigen::Infinity>())
        << name_of(set);
  }
}

/// Shapes known to the compiler and shapes that are not; whole blocks of eight steps, and what is left of them.
TEST(SegmentKernels, AgreeOnEveryInstructionSet) {
  for (const char* name :
       {"double_integrator", "orbital_transfer", "two_link_manipulator", "hovercraft", "link_chain", "robot_arm"}) {
    const auto problem = make_problem(name);
    for (const tests::Scheme& scheme : tests::all_schemes(2)) {
      for (const Eigen::Index intervals : {16, 64, 77}) expect_same_steps(*problem, scheme, intervals);
    }
  }
}

/// Up to two stages: with three, what the elimination of DMOC loses to cancellation is more than the promise.
TEST(SegmentKernels, AgreeOnEveryInstructionSetWhereEverythingIsStated) {
  const tests::Everything everything;
  for (const tests::Scheme& scheme : tests::all_schemes(2)) expect_same_steps(everything.problem(), scheme, 69);
}

}  // namespace
}  // namespace dmocbench::kkt
