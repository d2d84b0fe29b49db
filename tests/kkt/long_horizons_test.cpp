// Elimination of horizons so long that threads share them and records are made again, against a sparse factorisation.

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/kkt/intervals/elimination_plan.hpp"
#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/kkt/intervals/segment_group.hpp"
#include "methods/kkt/newton_residual.hpp"
#include "methods/kkt/sparse_kkt.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/registry.hpp"
#include "tests/support/dense_kkt.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/restored_settings.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench::kkt {
namespace {

using tests::KktNumbers;

struct Steps {
  explicit Steps(const KktNumbers& numbers)
      : primal(Eigen::VectorXd::Constant(numbers.gradient.size(), 1e300)),
        multipliers(Eigen::VectorXd::Constant(numbers.rows.size(), 1e300)) {}

  [[nodiscard]] FactorisationStatus solve_with(KktSystem& kkt, const KktNumbers& numbers) {
    return kkt.solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers});
  }
  /// Every bit.
  [[nodiscard]] bool operator==(const Steps& other) const {
    const auto same = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
      return a.size() == b.size() &&
             std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
    };
    return same(primal, other.primal) && same(multipliers, other.multipliers);
  }

  Eigen::VectorXd primal;
  Eigen::VectorXd multipliers;
};

/// Not equally long intervals, so that none has another's numbers.
std::unique_ptr<Transcription> long_program(const Problem& problem, const tests::Scheme& scheme,
                                            Eigen::Index intervals) {
  return tests::transcribe(problem, scheme, tests::graded_grid(intervals));
}

/// The gradient and the rows that steps leave of a system, with sums in long double.
KktNumbers left_by(const Steps& steps, const NonlinearProgram& program, const KktNumbers& numbers) {
  using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  const LongVector primal = steps.primal.cast<long double>();
  const LongVector multipliers = steps.multipliers.cast<long double>();
  LongVector gradient =
      numbers.diagonal.cast<long double>().cwiseProduct(primal) + numbers.gradient.cast<long double>();
  LongVector rows = numbers.rows.cast<long double>() - numbers.compliance.cast<long double>().cwiseProduct(multipliers);
  const SparsityPattern hessian = program.hessian_structure().expand();
  for (std::size_t e = 0; e < hessian.size(); ++e) {
    const auto value = static_cast<long double>(numbers.hessian[static_cast<Eigen::Index>(e)]);
    gradient[hessian.rows[e]] += value * primal[hessian.columns[e]];
    if (hessian.rows[e] != hessian.columns[e]) gradient[hessian.columns[e]] += value * primal[hessian.rows[e]];
  }
  const SparsityPattern jacobian = program.jacobian_structure().expand();
  for (std::size_t e = 0; e < jacobian.size(); ++e) {
    const auto value = static_cast<long double>(numbers.jacobian[static_cast<Eigen::Index>(e)]);
    rows[jacobian.rows[e]] += value * primal[jacobian.columns[e]];
    gradient[jacobian.columns[e]] += value * multipliers[jacobian.rows[e]];
  }
  KktNumbers left = numbers;
  left.gradient = gradient.cast<double>();
  left.rows = rows.cast<double>();
  return left;
}

/// The error of a step, relative to its largest entries, is what the sparse factorisation finds that it lacks. A step
/// of that factorisation itself may be wrong in its fourth digit here, and for `tangent` in its first, but a correction
/// need not be known better.
void expect_nothing_to_correct(const Problem& problem, const tests::Scheme& scheme, Eigen::Index intervals) {
  SCOPED_TRACE(problem.name() + ", " + scheme.label() + ", N = " + std::to_string(intervals));
  const auto program = long_program(problem, scheme, intervals);
  const KktNumbers numbers = tests::shifted_system(*program, sample(*program, guessed_motion(problem)));
  std::vector<Steps> found;
  for (const std::size_t threads : {1U, 2U, 3U}) {
    const tests::Threads there(threads);
    const auto kkt = IntervalKkt::make(*program).value();
    found.emplace_back(numbers);
    ASSERT_EQ(found.back().solve_with(*kkt, numbers), FactorisationStatus::solved);
    EXPECT_TRUE(found.back() == found.front()) << threads << " threads";
  }
  SparseKkt sparse(*program);
  Steps correction(numbers);
  ASSERT_EQ(correction.solve_with(sparse, left_by(found.front(), *program, numbers)), FactorisationStatus::solved);
  const auto relative = [](const Eigen::VectorXd& error, const Eigen::VectorXd& of) {
    return error.lpNorm<Eigen::Infinity>() / of.lpNorm<Eigen::Infinity>();
  };
  EXPECT_LT(relative(correction.primal, found.front().primal), 1e-10);
  EXPECT_LT(relative(correction.multipliers, found.front().multipliers), 1e-10);
}

/// 20,000: four groups, whose records are made again. 12,326: three groups, of unequal segments, with a last chunk of
/// two steps.
TEST(LongHorizons, AreSolvedWithTheSameStepWhateverTheNumberOfThreads) {
  const auto orbit = make_problem("orbital_transfer");
  expect_nothing_to_correct(*orbit, {"dmoc", 1}, 20000);
  expect_nothing_to_correct(*orbit, {"hamiltonian", 1}, 20000);
  expect_nothing_to_correct(*orbit, {"tangent", 1}, 12289 + 37);
  const auto arm = make_problem("two_link_manipulator");
  expect_nothing_to_correct(*arm, {"dmoc", 2}, 12289 + 37);
}

TEST(LongHorizons, AreSolvedWithTheSameStepWhateverTheNumberOfThreadsWhereEverythingIsStated) {
  const tests::Everything everything;
  expect_nothing_to_correct(everything.problem(), {"dmoc", 1}, 12289 + 37);
}

template <class Thing>
Thing that_is_there(std::optional<Thing> thing) {
  if (!thing) throw Error("a program of these tests cannot be eliminated by intervals");
  return *std::move(thing);
}

/// What the two sweeps over a group make of a system, with records of all steps or of a chunk.
class GroupSweeps {
 public:
  GroupSweeps(const Transcription& program, const KktNumbers& numbers) : numbers_(numbers) {
    entries_ = interval_entries(program).value();
    padded_.setZero(static_cast<Eigen::Index>(entries_.padded.size()) * entries_.intervals);
    const auto give = [&](Source source, const Eigen::VectorXd& values) {
      arrays_.arrays[static_cast<std::size_t>(source)] = values.data();
    };
    give(Source::jacobian, numbers_.jacobian);
    give(Source::hessian, numbers_.hessian);
    give(Source::diagonal, numbers_.diagonal);
    give(Source::compliance, numbers_.compliance);
    give(Source::gradient, numbers_.gradient);
    give(Source::rows, numbers_.rows);
    give(Source::padded, padded_);
    for (const PaddedRun& run : entries_.padded) {
      const double* from = arrays_.of(run.source) + run.entry;
      std::copy_n(from, run.length, padded_.data() + run.padded_first + run.begin);
    }
    weights_.setConstant(state_size(entries_.shape), 1e3);
    arrays_.terminal_weights = weights_.data();
    plan_ = that_is_there(elimination_plan(entries_, arrays_, {entries_.intervals / 2}));
  }

  struct Result {
    explicit Result(const KktNumbers& numbers) : steps(numbers) {}
    Steps steps;
    std::vector<double> value;  // and reachability
    int steps_of_group = 0;
    int recorded_steps = 0;
  };
  /// `end` intervals, all of them or the first ones.
  [[nodiscard]] Result sweep(SegmentKernelChoice choose, std::size_t end, bool keeps_records) const {
    const SegmentKernel kernel = choose(plan_.shape);
    GroupMemory memory(plan_.shape, 0, end, keeps_records);
    memory.make_workspace(kernel.workspace_size(plan_));
    SegmentGroup& group = memory.group();
    kernel.backward(plan_, arrays_, group);
    EXPECT_EQ(group.pivots, FreePivots::positive);
    Result result(numbers_);
    const std::ptrdiff_t X = state_size(plan_.shape);
    result.value.assign(group.value, group.value + X * (2 * X + 1) * lane_count);
    result.value.insert(result.value.end(), group.reachability, group.reachability + X * (X + 1) * lane_count);
    tests::RandomPoints random;
    for (std::ptrdiff_t i = 0; i < X * lane_count; ++i) {
      group.state[i] = random.number();
      group.multiplier[i] = random.number();
    }
    kernel.forward(plan_, arrays_, group, result.steps.primal.data(), result.steps.multipliers.data());
    result.steps_of_group = group.steps;
    result.recorded_steps = group.recorded_steps;
    return result;
  }

 private:
  const KktNumbers& numbers_;
  IntervalEntries entries_;
  Eigen::VectorXd padded_;
  Eigen::VectorXd weights_;
  NewtonArrays arrays_;
  EliminationPlan plan_;
};

void expect_same_sweeps_by_chunks(const Problem& problem, const tests::Scheme& scheme, Eigen::Index intervals) {
  SCOPED_TRACE(problem.name() + ", " + scheme.label() + ", N = " + std::to_string(intervals));
  const auto program = long_program(problem, scheme, intervals);
  const KktNumbers numbers = tests::shifted_system(*program, sample(*program, guessed_motion(problem)));
  const GroupSweeps sweeps(*program, numbers);
  for (const InstructionSet set : available_instruction_sets()) {
    const auto whole = sweeps.sweep(segment_kernels_of(set), static_cast<std::size_t>(intervals), true);
    const auto chunks = sweeps.sweep(segment_kernels_of(set), static_cast<std::size_t>(intervals), false);
    EXPECT_EQ(whole.recorded_steps, whole.steps_of_group);
    EXPECT_EQ(chunks.recorded_steps<chunks.steps_of_group, intervals> 128);
    EXPECT_EQ(whole.value, chunks.value) << name_of(set);
    EXPECT_TRUE(whole.steps == chunks.steps) << name_of(set);
  }
}

/// One chunk, two, three and more; whole ones and such of one step; segments of unequal lengths. Shapes that are known
/// to the compiler (midpoint rules of one and two degrees of freedom) and others.
TEST(LongHorizons, AreSweptByChunksAsWithAllRecords) {
  for (const char* name : {"double_integrator", "orbital_transfer", "two_link_manipulator", "hovercraft"}) {
    const auto problem = make_problem(name);
    for (const tests::Scheme& scheme : tests::all_schemes(2)) {
      for (const Eigen::Index intervals : {100, 128, 129, 256, 257, 261, 300, 384}) {
        expect_same_sweeps_by_chunks(*problem, scheme, intervals);
      }
    }
  }
}

TEST(LongHorizons, AreSweptByChunksAsWithAllRecordsWhereEverythingIsStated) {
  const tests::Everything everything;
  for (const tests::Scheme& scheme : tests::all_schemes(3)) {
    for (const Eigen::Index intervals : {127, 300}) {
      expect_same_sweeps_by_chunks(everything.problem(), scheme, intervals);
    }
  }
}

/// Newton's system at the guess, nearly without regularisation.
KktNumbers system_at_guess(Transcription& program, const Eigen::VectorXd& guess) {
  KktNumbers numbers = tests::shifted_system(program, guess);
  numbers.diagonal.setConstant(1e-2);
  program.hessian(guess, 1.0, Eigen::VectorXd::Zero(numbers.rows.size()), numbers.hessian);
  program.jacobian(guess, numbers.jacobian);
  program.gradient(guess, numbers.gradient);
  program.constraints(guess, numbers.rows);
  numbers.rows -= program.constraint_lower();
  return numbers;
}

/// What one elimination leaves of the gradient, relative to the terms Jᵀ δλ that cancel in it.
double relative_rest_of_gradient(Transcription& program, const KktNumbers& numbers) {
  const auto kkt = IntervalKkt::make(program).value();
  Steps found(numbers);
  EXPECT_EQ(found.solve_with(*kkt, numbers), FactorisationStatus::solved);
  NewtonResidual residual(program);
  residual.compute(numbers.matrix(), {numbers.gradient, numbers.rows}, {found.primal, found.multipliers});
  return residual.value().gradient.lpNorm<Eigen::Infinity>() /
         (numbers.jacobian.lpNorm<Eigen::Infinity>() * found.multipliers.lpNorm<Eigen::Infinity>());
}

/// DMOC's rows are differences of momenta, M/h times differences of q. A recursion in q instead of the momentum leaves
/// 9e-12, 2e-10 and 9e-9 of the guess's system, and 2e-12, 5e-11 and 2e-10 of the other; by momenta it is 2e-13 and
/// 5e-14 on all grids.
TEST(LongHorizons, KeepTheDigitsOfDmocStepsWhenIntervalsBecomeShort) {
  const auto problem = make_problem("orbital_transfer");
  for (const Eigen::Index intervals : {64, 512, 4096}) {
    Transcription program(*problem, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(intervals));
    const Eigen::VectorXd guess = sample(program, guessed_motion(*problem));
    EXPECT_LT(relative_rest_of_gradient(program, system_at_guess(program, guess)), 2e-12) << "N = " << intervals;
    EXPECT_LT(relative_rest_of_gradient(program, tests::shifted_system(program, guess)), 5e-13) << "N = " << intervals;
  }
}

}  // namespace
}  // namespace dmocbench::kkt
