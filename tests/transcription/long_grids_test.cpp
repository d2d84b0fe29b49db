// Grids so long that threads share them: as short ones, and the same whatever the number of threads.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "methods/runtime/parallel.hpp"
#include "methods/transcription/derivatives/series_assembly.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/registry.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/restored_settings.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Threads;

bool is_the_same(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

/// All numbers of a program at a point.
struct ProgramNumbers {
  ProgramNumbers(NonlinearProgram& program, const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers)
      : gradient(unwritten(program.variable_count())),
        constraints(unwritten(program.constraint_count())),
        jacobian(unwritten(program.jacobian_structure().size())),
        hessian(unwritten(program.hessian_structure().size())) {
    program.gradient(x, gradient);
    program.constraints(x, constraints);
    program.jacobian(x, jacobian);
    program.hessian(x, 0.7, multipliers, hessian);
  }
  /// Whatever stood there before must not matter.
  static Eigen::VectorXd unwritten(std::size_t size) {
    return Eigen::VectorXd::Constant(static_cast<Eigen::Index>(size), 1e300);
  }

  Eigen::VectorXd gradient;
  Eigen::VectorXd constraints;
  Eigen::VectorXd jacobian;
  Eigen::VectorXd hessian;
};

void expect_same_numbers_by_any_number_of_threads(const Problem& problem, const tests::Scheme& scheme) {
  SCOPED_TRACE(problem.name() + ", " + scheme.label());
  constexpr Eigen::Index intervals = 20000;
  ASSERT_GT(part_count(intervals), 3U);
  const auto program = tests::transcribe(problem, scheme, tests::graded_grid(intervals));
  tests::RandomPoints random;
  const Eigen::VectorXd start = sample(*program, guessed_motion(problem));
  const Eigen::VectorXd x = start + random.vector(start.size(), -1e-2, 1e-2);
  const Eigen::VectorXd multipliers = random.vector(static_cast<Eigen::Index>(program->constraint_count()));
  const Threads one(1);
  const ProgramNumbers wanted(*program, x, multipliers);
  EXPECT_TRUE(wanted.hessian.allFinite() && wanted.hessian.lpNorm<Eigen::Infinity>() < 1e300);
  for (const std::size_t threads : {2U, 3U}) {
    const Threads there(threads);
    for (int repetition = 0; repetition < 3; ++repetition) {
      const ProgramNumbers found(*program, x, multipliers);
      EXPECT_TRUE(is_the_same(found.gradient, wanted.gradient)) << threads << " threads";
      EXPECT_TRUE(is_the_same(found.constraints, wanted.constraints)) << threads << " threads";
      EXPECT_TRUE(is_the_same(found.jacobian, wanted.jacobian)) << threads << " threads";
      EXPECT_TRUE(is_the_same(found.hessian, wanted.hessian)) << threads << " threads";
    }
  }
}

TEST(LongGrids, HaveTheSameDerivativesWhateverTheNumberOfThreads) {
  const auto problem = make_problem("orbital_transfer");
  for (const char* method : {"dmoc", "hamiltonian"})
    expect_same_numbers_by_any_number_of_threads(*problem, {method, 1});
}

TEST(LongGrids, HaveTheSameDerivativesWhateverTheNumberOfThreadsWhereTheHorizonIsFree) {
  const tests::Everything everything;
  for (const char* method : {"dmoc", "hamiltonian"}) {
    expect_same_numbers_by_any_number_of_threads(everything.problem(), {method, 2});
  }
}

/// Columns (x, 10 x, 100 x) of small whole numbers, whose sums are exact: the first two overlap but for one entry, the
/// third is summed up.
TEST(LongGrids, AreAssembledFromPartsWithoutGap) {
  for (const Eigen::Index intervals : {8191, 8192, 12289, 12289 + 37, 20000}) {
    const auto count = static_cast<std::size_t>(intervals);
    Eigen::VectorXd x(intervals);
    for (Eigen::Index k = 0; k < intervals; ++k) x[k] = static_cast<double>(1 + k % 97);
    const Expression input = Expression::input(0);
    AssembledTape tape(Schedule(std::vector<Expression>{1.0 * input, 10.0 * input, 100.0 * input}),
                       {{0, 1, {count + 1, true}}, count + 2, count});
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(intervals + 2);
    wanted.head(intervals) += x;
    wanted.segment(1, intervals) += 10.0 * x;
    wanted[intervals + 1] = 100.0 * x.sum();
    const std::vector<Tape::Input> inputs{{x.data(), false}};
    for (const std::size_t threads : {1U, 2U, 3U}) {
      const Threads there(threads);
      Eigen::VectorXd found = ProgramNumbers::unwritten(count + 2);
      tape.evaluate(inputs, found);
      EXPECT_EQ(found, wanted) << "N = " << intervals << ", " << threads << " threads";
    }
  }
}

/// So many intervals that even additions are shared. The last column begins where the others do, so that all add to the
/// same entries.
TEST(LongGrids, AreAddedUpByPartsWithoutGap) {
  constexpr std::size_t intervals = 3 * 65536 + 37;
  constexpr std::size_t gap = 2 * 65536 + 5;  // entries that no column reaches
  constexpr std::size_t size = gap + intervals + 2;
  const std::vector<SeriesPlace> places{gap, gap + 1, gap + 2, gap + 1};
  SeriesAssembly assembly({places, size, intervals});
  std::array<Eigen::VectorXd, 4> columns;
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(size));
  tests::RandomPoints random;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    columns[c].resize(static_cast<Eigen::Index>(intervals));
    for (double& entry : columns[c]) entry = std::floor(random.number(-1e6, 1e6));  // sums are exact
    wanted.segment(static_cast<Eigen::Index>(places[c].first), columns[c].size()) += columns[c];
  }
  for (const std::size_t threads : {1U, 2U, 3U}) {
    const Threads there(threads);
    Eigen::VectorXd found = ProgramNumbers::unwritten(size);
    VectorOut out(found);
    const auto targets = assembly.open(out);
    for (std::size_t c = 0; c < columns.size(); ++c) std::copy_n(columns[c].data(), intervals, targets[c]);
    assembly.close(out);
    EXPECT_EQ(found, wanted) << threads << " threads";
  }
}

}  // namespace
}  // namespace dmocbench
