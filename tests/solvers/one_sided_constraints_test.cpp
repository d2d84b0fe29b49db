#include "methods/solvers/one_sided_constraints.hpp"

#include <gtest/gtest.h>

#include "tests/support/small_programs.hpp"

namespace dmocbench {
namespace {

using tests::everywhere;
using tests::HyperVector;
using tests::SmallProgram;
using tests::vector;

/// Constraints x₁x₂ = 3, x₂x₃ in [1, 4], x₁ + x₃ <= 5, x₁ - x₃ free; x₂ is fixed.
SmallProgram mixed() {
  return SmallProgram({[](const HyperVector& x) { return x[0]; },
                       [](const HyperVector& x) {
                         return HyperVector{x[0] * x[1], x[1] * x[2], x[0] + x[2], x[0] - x[2]};
                       },
                       vector({-unbounded, 2.0, -unbounded}), vector({unbounded, 2.0, unbounded}),
                       vector({3.0, 1.0, -unbounded, -unbounded}), vector({3.0, 4.0, 5.0, unbounded})});
}

TEST(OneSidedConstraints, SayTheSameAsTheConstraints) {
  SmallProgram program = mixed();
  const OneSidedConstraints equalities(program, OneSidedConstraints::Kind::equalities);
  const OneSidedConstraints inequalities(program, OneSidedConstraints::Kind::inequalities);
  ASSERT_EQ(equalities.size(), 1U);
  ASSERT_EQ(inequalities.size(), 3U);

  Eigen::VectorXd constraints(4);
  program.constraints(vector({1.0, 2.0, 7.0}), constraints);
  Eigen::VectorXd values(1);
  equalities.values(constraints, values.data());
  EXPECT_EQ(values, vector({2.0 - 3.0}));
  values.resize(3);
  inequalities.values(constraints, values.data());
  EXPECT_EQ(values, vector({14.0 - 4.0, 1.0 - 14.0, 8.0 - 5.0}));

  OneSidedConstraints::RowMajor jacobian(4, 2);  // by x₁ and x₃
  jacobian << 2.0, 0.0,                          //
      0.0, 2.0,                                  //
      1.0, 1.0,                                  //
      1.0, -1.0;
  Eigen::VectorXd dense = everywhere(2, -9.0);
  equalities.jacobian(jacobian, dense.data());
  EXPECT_EQ(dense, vector({2.0, 0.0}));
  dense = everywhere(6, -9.0);
  inequalities.jacobian(jacobian, dense.data());
  EXPECT_EQ(dense, vector({0.0, 2.0, 0.0, -2.0, 1.0, 1.0}));
}

}  // namespace
}  // namespace dmocbench
