#include "methods/solvers/sqp/quadratic/basis.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "tests/solvers/sqp/random_quadratic_program.hpp"

namespace dmocbench::sqp {
namespace {

using tests::owned;
using tests::random_matrix;
using tests::random_program;

Eigen::MatrixXd dense_columns(const QuadraticProgram& program, const std::vector<Eigen::Index>& columns) {
  Eigen::MatrixXd result(program.row_count(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    result.col(static_cast<Eigen::Index>(i)) = program.column(columns[i]);
  return result;
}

std::vector<Eigen::Index> slacks_of(const QuadraticProgram& program) {
  std::vector<Eigen::Index> slacks(static_cast<std::size_t>(program.row_count()));
  std::iota(slacks.begin(), slacks.end(), program.variable_count());
  return slacks;
}

TEST(BasisFactorisation, SolvesWithTheBasisAfterEveryReplacement) {
  const auto problem = random_program(40, 25, 1.0, 7);
  const QuadraticProgram& program = problem.program;
  std::vector<Eigen::Index> basics = slacks_of(program);
  BasisFactorisation factors;
  ASSERT_TRUE(factors.factorise(program, basics));
  std::mt19937 generator(3);
  for (Eigen::Index j = 0; j < 25; ++j) {
    // Gauss-Jordan with the largest pivot among the slacks that are left.
    const Eigen::VectorXd solved = factors.solve(program.column(j));
    Eigen::Index position = -1;
    for (Eigen::Index i = 0; i < 25; ++i) {
      if (basics[static_cast<std::size_t>(i)] < 40) continue;
      if (position < 0 || std::abs(solved[i]) > std::abs(solved[position])) position = i;
    }
    factors.replace(position, solved);
    basics[static_cast<std::size_t>(position)] = j;
    const Eigen::MatrixXd dense = dense_columns(program, basics);
    const Eigen::VectorXd y = random_matrix(25, 1, generator);
    EXPECT_LT((dense * factors.solve(y) - y).lpNorm<Eigen::Infinity>(), 1e-9);
    EXPECT_LT((dense.transpose() * factors.solve_transposed(y) - y).lpNorm<Eigen::Infinity>(), 1e-9);
  }
}

TEST(BasisFactorisation, RefusesColumnsThatDependOnEachOther) {
  Eigen::MatrixXd rows(2, 3);
  rows << 1.0, 2.0, 0.0,  //
      3.0, 6.0, 1.0;
  const auto problem = owned(Eigen::MatrixXd::Identity(3, 3), Eigen::VectorXd::Zero(3), rows, Eigen::VectorXd::Zero(5),
                             Eigen::VectorXd::Zero(5));
  BasisFactorisation factors;
  EXPECT_FALSE(factors.factorise(problem.program, {0, 1}));
  EXPECT_TRUE(factors.factorise(problem.program, {0, 2}));
}

TEST(BasisChoice, LeavesNoLargeEntryInTheTable) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto problem = random_program(60, 30, 1.0, seed);
    const BasisChoice choice = crash_basis(problem.program);
    EXPECT_LE(choice.table.cwiseAbs().maxCoeff(), 4.0);
    const Eigen::MatrixXd product = dense_columns(problem.program, choice.basics) * choice.table;
    EXPECT_LT((product - dense_columns(problem.program, choice.others)).cwiseAbs().maxCoeff(), 1e-10);
  }
}

TEST(BasisChoice, OfABadBasisIsAGoodOneFromTheSameColumns) {
  // The first two columns are almost parallel.
  Eigen::MatrixXd rows(2, 3);
  rows << 1.0, 1.0, 0.0,  //
      1.0, 1.0 + 1e-5, 1.0;
  const auto problem = owned(Eigen::MatrixXd::Identity(3, 3), Eigen::VectorXd::Zero(3), rows, Eigen::VectorXd::Zero(5),
                             Eigen::VectorXd::Zero(5));
  const BasisChoice choice = choose_basis(problem.program, {0, 1}, {2});
  EXPECT_LE(choice.table.cwiseAbs().maxCoeff(), 4.0);
  std::vector<Eigen::Index> all = choice.basics;
  all.insert(all.end(), choice.others.begin(), choice.others.end());
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, (std::vector<Eigen::Index>{0, 1, 2}));
}

TEST(BasisChoice, KeepsTheSlackOfARowThatDependsOnAnother) {
  Eigen::MatrixXd rows(2, 2);
  rows << 1.0, 2.0,  //
      2.0, 4.0;
  const auto problem = owned(Eigen::MatrixXd::Identity(2, 2), Eigen::VectorXd::Zero(2), rows,
                             Eigen::VectorXd::Constant(4, -1.0), Eigen::VectorXd::Constant(4, 1.0));
  const BasisChoice choice = crash_basis(problem.program);
  EXPECT_EQ(std::count_if(choice.basics.begin(), choice.basics.end(), [](Eigen::Index j) { return j >= 2; }), 1);
  BasisFactorisation factors;
  EXPECT_TRUE(factors.factorise(problem.program, choice.basics));
}

TEST(BasisChoice, OfSingularColumnsTakesSlacksInstead) {
  Eigen::MatrixXd rows(2, 3);
  rows << 1.0, 2.0, 0.0,  //
      3.0, 6.0, 0.0;
  const auto problem = owned(Eigen::MatrixXd::Identity(3, 3), Eigen::VectorXd::Zero(3), rows, Eigen::VectorXd::Zero(5),
                             Eigen::VectorXd::Zero(5));
  const BasisChoice choice = choose_basis(problem.program, {0, 1}, {});
  BasisFactorisation factors;
  EXPECT_TRUE(factors.factorise(problem.program, choice.basics));
  EXPECT_LT(choice.basics[0], 2);
  EXPECT_GE(choice.basics[1], 3);
}

}  // namespace
}  // namespace dmocbench::sqp
