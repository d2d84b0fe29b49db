// Products by runs and what a step leaves of a Newton system, against dense matrices.

#include "methods/kkt/newton_residual.hpp"

#include <cstddef>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "methods/kkt/matrix_product.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/orbital_transfer.hpp"
#include "tests/support/restored_settings.hpp"
#include "tests/support/system_choice.hpp"

namespace dmocbench::kkt {
namespace {

using tests::KktNumbers;
using tests::RandomPoints;
using tests::RandomShape;
using tests::RandomStructuredProgram;
using tests::SystemChoice;

/// A matrix of a pattern; `mirrored`: of which the lower triangle is there.
Eigen::MatrixXd written_as_dense(const BlockPattern& pattern, const Eigen::VectorXd& values, Eigen::Index rows,
                                 Eigen::Index columns, bool mirrored) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, columns);
  pattern.for_each([&](Eigen::Index e, int row, int column) {
    matrix(row, column) = values[e];
    if (mirrored) matrix(column, row) = values[e];  // NOLINT(readability-suspicious-call-argument): mirrored
  });
  return matrix;
}

/// Runs in all directions, in the order of chance, with no position twice. `triangle`: on the diagonal, or below it.
BlockPattern random_pattern(Eigen::Index rows, Eigen::Index columns, bool triangle, RandomPoints& random) {
  BlockPattern pattern;
  const auto up_to = [&](Eigen::Index end) {
    return static_cast<Eigen::Index>(random.number(0.0, 1.0) * static_cast<double>(end));
  };
  const int tries = 4 + static_cast<int>(up_to(rows + columns));
  for (int i = 0; i < tries; ++i) {
    PatternRun run{.row = up_to(rows), .column = up_to(columns), .row_step = up_to(2), .column_step = up_to(2)};
    run.length = run.row_step + run.column_step > 0 ? 1 + up_to(rows + columns) : 1;
    const bool on_diagonal = run.row == run.column && run.row_step == run.column_step;
    Eigen::Index length = 0;
    for (; length < run.length; ++length) {
      const Eigen::Index row = run.row + length * run.row_step;
      const Eigen::Index column = run.column + length * run.column_step;
      if (row >= rows || column >= columns) break;
      if (triangle && (row < column || (row == column && !on_diagonal))) break;
      if (pattern.find(static_cast<std::size_t>(row), static_cast<std::size_t>(column))) break;
    }
    run.length = length;
    if (length > 0) pattern.append(run);
  }
  return pattern;
}

TEST(Products, AreThoseOfDenseMatrices) {
  RandomPoints random;
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE("pattern " + std::to_string(i));
    const Eigen::Index rows = 1 + i % 7;
    const Eigen::Index columns = 1 + i % 9;
    const BlockPattern pattern = random_pattern(rows, columns, false, random);
    const Eigen::VectorXd values = random.vector(static_cast<Eigen::Index>(pattern.size()));
    const Eigen::MatrixXd matrix = written_as_dense(pattern, values, rows, columns, false);
    const Eigen::VectorXd x = random.vector(columns);
    const Eigen::VectorXd multipliers = random.vector(rows);
    Eigen::VectorXd product = multipliers;
    set_to_sum_of_products(product, product, {{MatrixProduct::plain(pattern), values, x}});
    EXPECT_LT((product - multipliers - matrix * x).lpNorm<Eigen::Infinity>(), 1e-13);
    Eigen::VectorXd transposed = x;
    set_to_sum_of_products(transposed, transposed, {{MatrixProduct::transposed(pattern), values, multipliers}});
    EXPECT_LT((transposed - x - matrix.transpose() * multipliers).lpNorm<Eigen::Infinity>(), 1e-13);
  }
}

TEST(Products, OfSymmetricMatricesAreThoseOfDenseOnes) {
  RandomPoints random;
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE("pattern " + std::to_string(i));
    const Eigen::Index size = 1 + i % 9;
    const BlockPattern pattern = random_pattern(size, size, true, random);
    const Eigen::VectorXd values = random.vector(static_cast<Eigen::Index>(pattern.size()));
    const Eigen::VectorXd x = random.vector(size);
    const Eigen::VectorXd before = random.vector(size);
    Eigen::VectorXd sum = before;
    set_to_sum_of_products(sum, sum, {{MatrixProduct::symmetric(pattern), values, x}});
    const Eigen::VectorXd wanted = before + written_as_dense(pattern, values, size, size, true) * x;
    EXPECT_LT((sum - wanted).lpNorm<Eigen::Infinity>(), 1e-13);
  }
}

/// A diagonal and its neighbour of whole numbers, of which sums are exact, longer than several stretches.
TEST(Products, OfLongVectorsHaveEveryEntry) {
  constexpr Eigen::Index size = 5 * 65536 + 37;
  BlockPattern pattern;
  pattern.append({.row_step = 1, .column_step = 1, .length = size});
  pattern.append({.entry = size, .row = 1, .row_step = 1, .column_step = 1, .length = size - 1});
  Eigen::VectorXd values(2 * size - 1);
  for (Eigen::Index e = 0; e < values.size(); ++e) values[e] = static_cast<double>(1 + e % 7);
  Eigen::VectorXd x(size);
  for (Eigen::Index i = 0; i < size; ++i) x[i] = static_cast<double>(1 + i % 11);
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(size, 100.0);
  Eigen::VectorXd wanted = start + values.head(size).cwiseProduct(x);
  wanted.tail(size - 1) += values.tail(size - 1).cwiseProduct(x.head(size - 1));
  const MatrixProduct matrix = MatrixProduct::plain(pattern);
  for (const std::size_t threads : {1U, 2U, 3U}) {
    const tests::Threads there(threads);
    Eigen::VectorXd sum;
    EXPECT_TRUE(set_to_sum_of_products(sum, start, {{matrix, values, x}}));
    EXPECT_EQ(sum, wanted) << threads << " threads";
  }
  for (const Eigen::Index i : {Eigen::Index{0}, size / 2, size - 1}) {
    Eigen::VectorXd with_gap = x;
    with_gap[i] = std::numeric_limits<double>::quiet_NaN();
    Eigen::VectorXd sum;
    EXPECT_FALSE(set_to_sum_of_products(sum, start, {{matrix, values, with_gap}})) << "entry " << i;
  }
}

/// What a step leaves, by dense matrices.
struct DenseResidual {
  DenseResidual(const NonlinearProgram& program, const KktNumbers& numbers, const Eigen::VectorXd& primal,
                const Eigen::VectorXd& multipliers) {
    const auto n = static_cast<Eigen::Index>(program.variable_count());
    const auto m = static_cast<Eigen::Index>(program.constraint_count());
    const Eigen::MatrixXd H = written_as_dense(program.hessian_structure(), numbers.hessian, n, n, true);
    const Eigen::MatrixXd J = written_as_dense(program.jacobian_structure(), numbers.jacobian, m, n, false);
    gradient = numbers.gradient + H * primal + numbers.diagonal.cwiseProduct(primal) + J.transpose() * multipliers;
    rows = numbers.rows + J * primal - numbers.compliance.cwiseProduct(multipliers);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (program.variable_lower()[i] == program.variable_upper()[i]) gradient[i] = 0.0;
    }
  }
  Eigen::VectorXd gradient;
  Eigen::VectorXd rows;
};

/// Programs with rows of nodes and of intervals, inequalities, fixed unknowns, conditions of both ends, and an unknown
/// of the whole horizon, which is a full row of the Hessian and a full column of the Jacobian.
TEST(NewtonResidual, IsThatOfDenseMatrices) {
  int horizons = 0;
  int fixed = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SystemChoice choice(seed);
    const RandomShape shape = choice.shape();
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + shape.label());
    RandomStructuredProgram program(shape, seed);
    const KktNumbers numbers = choice.numbers(program, shape.hessian);
    RandomPoints random(seed);
    Eigen::VectorXd primal = random.vector(numbers.gradient.size());
    Eigen::VectorXd multipliers = random.vector(numbers.rows.size());
    NewtonResidual residual(program);
    for (int repetition = 0; repetition < 2; ++repetition) {
      residual.compute(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers});
      const DenseResidual wanted(program, numbers, primal, multipliers);
      ASSERT_LT((residual.value().gradient - wanted.gradient).lpNorm<Eigen::Infinity>(),
                1e-13 * (1.0 + wanted.gradient.lpNorm<Eigen::Infinity>()));
      ASSERT_LT((residual.value().constraints - wanted.rows).lpNorm<Eigen::Infinity>(),
                1e-13 * (1.0 + wanted.rows.lpNorm<Eigen::Infinity>()));
    }
    horizons += shape.horizon ? 1 : 0;
    fixed += shape.fixed[0] + shape.fixed[1] > 0 ? 1 : 0;
  }
  EXPECT_GT(horizons, 50);
  EXPECT_GT(fixed, 100);
}

TEST(NewtonResidual, ExceedsByHowMuchMoreItIsThanItMayBe) {
  SystemChoice choice(3);
  RandomShape shape;
  shape.intervals = 4;
  RandomStructuredProgram program(shape, 3);
  KktNumbers numbers = choice.numbers(program, shape.hessian);
  Eigen::VectorXd primal = Eigen::VectorXd::Zero(numbers.gradient.size());
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(numbers.rows.size());
  NewtonResidual residual(program);
  const auto excess = [&](double accuracy) {
    residual.compute(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers});
    return residual.excess(numbers.matrix(), {primal, multipliers}, accuracy);
  };
  // No step leaves all of the right-hand side.
  EXPECT_NEAR(excess(1e-3), 1e3, 1e-6);
  EXPECT_NEAR(excess(1.0), 1.0, 1e-12);
  // Gradients and rows count by their own sizes.
  numbers.gradient *= 1e-8;
  EXPECT_NEAR(excess(1e-3), 1e3, 1e-6);
  numbers.rows *= 1e-12;
  EXPECT_NEAR(excess(1e-3), 1e3, 1e-6);
  numbers.rows.setZero();
  numbers.gradient.setZero();
  EXPECT_EQ(excess(1e-3), 0.0);
  primal[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(excess(1e-3), std::numeric_limits<double>::infinity());
}

/// Without rows to correct, what a step leaves of them cannot be judged by their right-hand side; the program's own
/// rounding does.
TEST(NewtonResidual, MayBeAsLargeAsTheRoundingOfTheProgram) {
  const OrbitalTransfer problem;
  Transcription program(problem, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(8));
  const double floor = program.rounding_floors().largest;
  ASSERT_GT(floor, 0.0);
  const auto variables = static_cast<Eigen::Index>(program.variable_count());
  const auto rows = static_cast<Eigen::Index>(program.constraint_count());
  const Eigen::VectorXd hessian = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.hessian_structure().size()));
  const Eigen::VectorXd jacobian =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Ones(variables);
  const Eigen::VectorXd compliance = Eigen::VectorXd::Zero(rows);
  const Eigen::VectorXd gradient = Eigen::VectorXd::Zero(variables);
  Eigen::VectorXd no_step = Eigen::VectorXd::Zero(variables);
  Eigen::VectorXd no_multipliers = Eigen::VectorXd::Zero(rows);
  NewtonResidual residual(program);
  const KktMatrix matrix{hessian, jacobian, diagonal, compliance};
  for (const double left : {0.5 * floor, 2.0 * floor}) {
    residual.compute(matrix, {gradient, Eigen::VectorXd::Constant(rows, left)}, {no_step, no_multipliers});
    EXPECT_NEAR(residual.excess(matrix, {no_step, no_multipliers}, 1e-9), left / floor, 1e-6);
  }
}

}  // namespace
}  // namespace dmocbench::kkt
