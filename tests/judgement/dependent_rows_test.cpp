#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "methods/judgement/flat_rows.hpp"
#include "methods/judgement/linearised_conditions.hpp"
#include "tests/support/small_programs.hpp"

namespace dmocbench {
namespace {

using tests::HyperDual;
using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;
using Rows = std::vector<std::size_t>;

/// Four variables without bounds; the rows are equal to 0.
SmallProgram with_rows(const std::function<HyperVector(const HyperVector&)>& rows, int count) {
  return tests::equality_program([](const HyperVector& x) { return x[0]; }, rows, 4, Eigen::VectorXd::Zero(count));
}

Rows sorted(Rows rows) {
  std::ranges::sort(rows);
  return rows;
}

const Eigen::VectorXd here = vector({0.3, -0.7, 1.1, 0.0});

TEST(DependentRows, AreNoneWhereTheGradientsAreIndependent) {
  SmallProgram program = with_rows([](const HyperVector& x) { return HyperVector{x[0] * x[1], x[1] + x[2], x[3]}; }, 3);
  EXPECT_EQ(dependent_rows(program, here), Rows{});
}

TEST(DependentRows, AreThoseOfTheCombinationWithoutAGradient) {
  // Row 3 is the product of rows 0 and 1 plus a constant: its gradient is a combination of theirs.
  SmallProgram program = with_rows(
      [](const HyperVector& x) {
        const HyperDual a = x[0] * x[1];
        const HyperDual b = x[1] + x[2];
        return HyperVector{a, b, x[3], a * b};
      },
      4);
  EXPECT_EQ(sorted(dependent_rows(program, here)), (Rows{0, 1, 3}));
}

TEST(DependentRows, AreOneDependencyOfSeveral) {
  SmallProgram program = with_rows(
      [](const HyperVector& x) {
        return HyperVector{x[0], x[1], 2.0 * x[0], x[1] * x[1]};
      },
      4);
  const Rows found = sorted(dependent_rows(program, here));
  EXPECT_TRUE(found == (Rows{0, 2}) || found == (Rows{1, 3})) << testing::PrintToString(found);
}

TEST(DependentRows, IsOneRowWhereItsDerivativesVanish) {
  SmallProgram program = with_rows([](const HyperVector& x) { return HyperVector{x[0], x[3] * x[3]}; }, 2);
  EXPECT_EQ(dependent_rows(program, here), Rows{1});
  EXPECT_EQ(dependent_rows(program, vector({0.3, -0.7, 1.1, 0.1})), Rows{});
}

TEST(DependentRows, CountHeldInequalitiesAndFreeVariablesOnly) {
  const auto program = [](double most_of_first, double most_of_row) {
    return SmallProgram({[](const HyperVector& x) { return x[0]; },
                         [](const HyperVector& x) {
                           return HyperVector{x[0] + x[1], x[1]};
                         },
                         vector({0.0, -unbounded}), vector({most_of_first, unbounded}), vector({0.0, -unbounded}),
                         vector({0.0, most_of_row})});
  };
  const Eigen::VectorXd point = vector({0.0, 0.0});
  const auto rows_of = [&](SmallProgram of) { return sorted(dependent_rows(of, point)); };
  EXPECT_EQ(rows_of(program(0.0, 0.0)), (Rows{0, 1}));  // without x₀ both are x₁
  EXPECT_EQ(rows_of(program(0.0, 1.0)), Rows{});        // the second is not held
  EXPECT_EQ(rows_of(program(1.0, 0.0)), Rows{});
}

/// x₀² + x₁² >= 1 and x₂ >= 2; x₃ is in no row.
SmallProgram outside_of_a_disc() {
  return SmallProgram({[](const HyperVector& x) { return x[0]; },
                       [](const HyperVector& x) {
                         return HyperVector{x[0] * x[0] + x[1] * x[1], x[2]};
                       },
                       tests::everywhere(4, -unbounded), tests::everywhere(4, unbounded), vector({1.0, 2.0}),
                       tests::everywhere(2, unbounded)});
}

TEST(FlatRows, AreViolatedOnesThatCurvatureAloneRepairs) {
  SmallProgram program = outside_of_a_disc();
  const std::vector<FlatRow> ahead = flat_rows(program, vector({0.5, 0.0, 0.0, 0.0}));
  ASSERT_EQ(ahead.size(), 1U);
  EXPECT_EQ(ahead.front().row, 0U);
  EXPECT_EQ(ahead.front().unknown, 1U);
  EXPECT_EQ(flat_rows(program, vector({0.0, 0.0, 0.0, 0.0})).size(), 2U);
  EXPECT_TRUE(flat_rows(program, vector({0.5, 1e-6, 0.0, 0.0})).empty());  // it leads to one side
  EXPECT_TRUE(flat_rows(program, vector({1.5, 0.0, 0.0, 0.0})).empty());   // it holds
}

}  // namespace
}  // namespace dmocbench
