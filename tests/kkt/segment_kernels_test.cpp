#include <string>

#include <gtest/gtest.h>

#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/kkt/intervals/segment_kernel.hpp"
#include "methods/kkt/sparse_kkt.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/registry.hpp"
#include "tests/support/dense_kkt.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench::kkt {
namespace {

Eigen::VectorXd step_of(KktSystem& kkt, const tests::KktNumbers& numbers) {
  Eigen::VectorXd primal(numbers.gradient.size());
  Eigen::VectorXd multipliers(numbers.rows.size());
  EXPECT_EQ(kkt.solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers}),
            FactorisationStatus::solved);
  Eigen::VectorXd step(primal.size() + multipliers.size());
  step << primal, multipliers;
  return step;
}

void expect_same_steps(const Problem& problem, const tests::Scheme& scheme, Eigen::Index intervals) {
  SCOPED_TRACE(problem.name() + ", " + scheme.label() + ", N = " + std::to_string(intervals));
  Transcription program(problem, *make_element(scheme.method), scheme.tableau(), Grid::uniform(intervals));
  const tests::KktNumbers numbers = tests::shifted_system(program, sample(program, guessed_motion(problem)));
  Eigen::VectorXd baseline;
  for (const InstructionSet set : available_instruction_sets()) {
    const auto kkt = IntervalKkt::make(program, set).value();
    const Eigen::VectorXd steps = step_of(*kkt, numbers);
    if (set == InstructionSet::baseline) {
      baseline = steps;
      continue;
    }
    const Eigen::Index n = numbers.gradient.size();
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

/// Segments of less than a block, of one block and a few steps, of two blocks; some lanes with a step less than others.
TEST(SegmentKernels, TakeTheStepOfTheSparseFactorisationWhereverABlockOfStepsEnds) {
  const auto problem = make_problem("orbital_transfer");
  for (const tests::Scheme& scheme : tests::all_schemes(1)) {
    for (Eigen::Index intervals = 56; intervals <= 136; ++intervals) {
      SCOPED_TRACE(scheme.label() + ", N = " + std::to_string(intervals));
      Transcription program(*problem, *make_element(scheme.method), scheme.tableau(), Grid::uniform(intervals));
      const tests::KktNumbers numbers = tests::shifted_system(program, sample(program, guessed_motion(*problem)));
      SparseKkt sparse(program);
      const Eigen::VectorXd wanted = step_of(sparse, numbers);
      for (const InstructionSet set : available_instruction_sets()) {
        const auto by_intervals = IntervalKkt::make(program, set).value();
        for (int again = 0; again < 2; ++again) {  // what a sweep leaves in its memory changes no later one
          const Eigen::VectorXd found = step_of(*by_intervals, numbers);
          EXPECT_LT((found - wanted).lpNorm<Eigen::Infinity>(), 1e-7 * wanted.lpNorm<Eigen::Infinity>())
              << name_of(set);
        }
      }
    }
  }
}

}  // namespace
}  // namespace dmocbench::kkt
