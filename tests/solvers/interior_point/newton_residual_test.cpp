// Products by runs and what a step leaves of a Newton system, against dense matrices.

#include "methods/solvers/interior_point/newton_residual.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "methods/solvers/interior_point/matrix_product.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/orbital_transfer.hpp"
#include "tests/support/system_choice.hpp"

namespace dmocbench::interior_point {
namespace {

using tests::KktNumbers;
using tests::RandomPoints;
using tests::RandomShape;
using tests::RandomStructuredProgram;
using tests::SystemChoice;

/// A matrix of a pattern; `mirrored`: of which the lower triangle is there.
Eigen::MatrixXd written_as_dense(const SparsityPattern& pattern, const Eigen::VectorXd& values, Eigen::Index rows,
                                 Eigen::Index columns, bool mirrored) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, columns);
  for (std::size_t e = 0; e < pattern.size(); ++e) {
    const double value = values[static_cast<Eigen::Index>(e)];
    matrix(pattern.rows[e], pattern.columns[e]) = value;
    if (mirrored) matrix(pattern.columns[e], pattern.rows[e]) = value;
  }
  return matrix;
}

/// A lower triangle in which chance, or a full row, a full column or the diagonal, puts entries; by columns, by rows or
/// shuffled.
struct TriangleChoice {
  int size = 1;
  double density = 0.5;
  int full_row = -1;
  int full_column = -1;
  bool has_diagonal = false;
  bool by_rows = false;
  bool shuffled = false;
};

SparsityPattern lower_triangle(const TriangleChoice& choice, RandomPoints& random) {
  SparsityPattern pattern;
  for (int outer = 0; outer < choice.size; ++outer) {
    for (int inner = 0; inner < choice.size; ++inner) {
      const int row = choice.by_rows ? outer : inner;
      const int column = choice.by_rows ? inner : outer;
      if (row < column) continue;
      const bool is_full =
          row == choice.full_row || column == choice.full_column || (choice.has_diagonal && row == column);
      if (!is_full && random.number(0.0, 1.0) >= choice.density) continue;
      pattern.rows.push_back(row);
      pattern.columns.push_back(column);
    }
  }
  for (std::size_t e = pattern.size(); choice.shuffled && e > 1; --e) {
    const auto other = static_cast<std::size_t>(random.number(0.0, 1.0) * static_cast<double>(e));
    std::swap(pattern.rows[e - 1], pattern.rows[other]);
    std::swap(pattern.columns[e - 1], pattern.columns[other]);
  }
  return pattern;
}

bool is_cut_at_diagonal(const PatternRun& run) {
  const bool is_on_diagonal = run.row == run.column && (run.length == 1 || run.row_step == run.column_step);
  for (Eigen::Index i = 0; i < run.length && !is_on_diagonal; ++i) {
    if (run.row + i * run.row_step == run.column + i * run.column_step) return false;
  }
  return true;
}

void expect_symmetric_product(const SparsityPattern& pattern, Eigen::Index size, RandomPoints& random) {
  const Eigen::VectorXd values = random.vector(static_cast<Eigen::Index>(pattern.size()));
  const Eigen::VectorXd x = random.vector(size);
  const Eigen::VectorXd before = random.vector(size);
  const auto runs = cut_at_diagonal(pattern_runs(pattern));
  Eigen::Index entry = 0;
  for (const PatternRun& run : runs) {
    EXPECT_EQ(run.entry, entry) << "an entry is missing, or there twice";
    EXPECT_GT(run.length, 0);
    EXPECT_TRUE(is_cut_at_diagonal(run));
    for (Eigen::Index i = 0; i < run.length; ++i, ++entry) {
      EXPECT_EQ(run.row + i * run.row_step, pattern.rows[static_cast<std::size_t>(entry)]);
      EXPECT_EQ(run.column + i * run.column_step, pattern.columns[static_cast<std::size_t>(entry)]);
    }
  }
  EXPECT_EQ(entry, static_cast<Eigen::Index>(pattern.size()));
  Eigen::VectorXd sum = before;
  MatrixProduct::symmetric(pattern_runs(pattern)).add(values, x, sum);
  const Eigen::VectorXd wanted = before + written_as_dense(pattern, values, size, size, true) * x;
  EXPECT_LT((sum - wanted).lpNorm<Eigen::Infinity>(), 1e-13);
}

TEST(SymmetricProducts, AreThoseOfDenseMatricesForAnyLowerTriangle) {
  RandomPoints random;
  for (int i = 0; i < 1000; ++i) {
    TriangleChoice choice;
    choice.size = 1 + i % 9;
    choice.density = random.number(0.0, 1.0);
    const auto some_line = [&] { return static_cast<int>(random.number(-1.0, 1.0) * choice.size); };
    choice.full_row = some_line();
    choice.full_column = some_line();
    choice.has_diagonal = random.number() > 0.0;
    choice.by_rows = random.number() > 0.0;
    choice.shuffled = random.number() > 0.6;
    SCOPED_TRACE("pattern " + std::to_string(i));
    expect_symmetric_product(lower_triangle(choice, random), choice.size, random);
  }
}

/// Runs that end on the diagonal (a row), begin there (a column), or are all of it.
TEST(SymmetricProducts, AreThoseOfDenseMatricesForLinesThatTouchTheDiagonal) {
  RandomPoints random;
  constexpr int size = 7;
  for (int line = 0; line < size; ++line) {
    for (const bool has_diagonal : {false, true}) {
      for (const bool by_rows : {false, true}) {
        SCOPED_TRACE("line " + std::to_string(line));
        const TriangleChoice of_row{size, 0.0, line, -1, has_diagonal, by_rows, false};
        const TriangleChoice of_column{size, 0.0, -1, line, has_diagonal, by_rows, false};
        const TriangleChoice of_both{size, 0.0, line, line, has_diagonal, by_rows, false};
        for (const TriangleChoice& choice : {of_row, of_column, of_both}) {
          expect_symmetric_product(lower_triangle(choice, random), size, random);
        }
      }
    }
  }
}

TEST(Products, AreThoseOfDenseMatrices) {
  RandomPoints random;
  for (int i = 0; i < 300; ++i) {
    const int rows = 1 + i % 7;
    const int columns = 1 + i % 9;
    SparsityPattern pattern;
    for (int column = 0; column < columns; ++column) {
      for (int row = 0; row < rows; ++row) {
        if (random.number() < 0.0 && row != i % rows) continue;  // one row is full
        pattern.rows.push_back(row);
        pattern.columns.push_back(column);
      }
    }
    const Eigen::VectorXd values = random.vector(static_cast<Eigen::Index>(pattern.size()));
    const Eigen::VectorXd x = random.vector(columns);
    const Eigen::VectorXd before = random.vector(rows);
    Eigen::VectorXd sum = before;
    MatrixProduct::plain(pattern_runs(pattern)).add(values, x, sum);
    const Eigen::VectorXd wanted = before + written_as_dense(pattern, values, rows, columns, false) * x;
    EXPECT_LT((sum - wanted).lpNorm<Eigen::Infinity>(), 1e-13);
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
    slope = numbers.slope + H * primal + numbers.diagonal.cwiseProduct(primal) + J.transpose() * multipliers;
    rows = numbers.rows + J * primal - numbers.compliance.cwiseProduct(multipliers);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (program.variable_lower()[i] == program.variable_upper()[i]) slope[i] = 0.0;
    }
  }
  Eigen::VectorXd slope;
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
    Eigen::VectorXd primal = random.vector(numbers.slope.size());
    Eigen::VectorXd multipliers = random.vector(numbers.rows.size());
    NewtonResidual residual(program);
    for (int repetition = 0; repetition < 2; ++repetition) {
      residual.compute(numbers.matrix(), {numbers.slope, numbers.rows}, {primal, multipliers});
      const DenseResidual wanted(program, numbers, primal, multipliers);
      ASSERT_LT((residual.value().gradient - wanted.slope).lpNorm<Eigen::Infinity>(),
                1e-13 * (1.0 + wanted.slope.lpNorm<Eigen::Infinity>()));
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
  Eigen::VectorXd primal = Eigen::VectorXd::Zero(numbers.slope.size());
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(numbers.rows.size());
  NewtonResidual residual(program);
  const auto excess = [&](double accuracy) {
    residual.compute(numbers.matrix(), {numbers.slope, numbers.rows}, {primal, multipliers});
    return residual.excess(numbers.matrix(), {primal, multipliers}, accuracy);
  };
  // No step leaves all of the right-hand side.
  EXPECT_NEAR(excess(1e-3), 1e3, 1e-6);
  EXPECT_NEAR(excess(1.0), 1.0, 1e-12);
  // Slopes and rows count by their own sizes.
  numbers.slope *= 1e-8;
  EXPECT_NEAR(excess(1e-3), 1e3, 1e-6);
  numbers.rows *= 1e-12;
  EXPECT_NEAR(excess(1e-3), 1e3, 1e-6);
  numbers.rows.setZero();
  numbers.slope.setZero();
  EXPECT_EQ(excess(1e-3), 0.0);
  primal[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(excess(1e-3), std::numeric_limits<double>::infinity());
}

/// Without rows to correct, what a step leaves of them cannot be judged by their right-hand side; the program's own
/// rounding does.
TEST(NewtonResidual, MayBeAsLargeAsTheRoundingOfTheProgram) {
  const OrbitalTransfer problem;
  Transcription program(problem, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(8));
  const double floor = program.rounding_floor();
  ASSERT_GT(floor, 0.0);
  const auto variables = static_cast<Eigen::Index>(program.variable_count());
  const auto rows = static_cast<Eigen::Index>(program.constraint_count());
  const Eigen::VectorXd hessian = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.hessian_structure().size()));
  const Eigen::VectorXd jacobian =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Ones(variables);
  const Eigen::VectorXd compliance = Eigen::VectorXd::Zero(rows);
  const Eigen::VectorXd slope = Eigen::VectorXd::Zero(variables);
  Eigen::VectorXd no_step = Eigen::VectorXd::Zero(variables);
  Eigen::VectorXd no_multipliers = Eigen::VectorXd::Zero(rows);
  NewtonResidual residual(program);
  const KktMatrix matrix{hessian, jacobian, diagonal, compliance};
  for (const double left : {0.5 * floor, 2.0 * floor}) {
    residual.compute(matrix, {slope, Eigen::VectorXd::Constant(rows, left)}, {no_step, no_multipliers});
    EXPECT_NEAR(residual.excess(matrix, {no_step, no_multipliers}, 1e-9), left / floor, 1e-6);
  }
}

}  // namespace
}  // namespace dmocbench::interior_point
