#include "methods/expression/derivatives.hpp"

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/expression/replay.hpp"
#include "tests/expression/adolc_reference.hpp"
#include "tests/expression/operations.hpp"
#include "tests/expression/terms.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench {
namespace {

using tests::AdolcReference;
using tests::Domain;
using tests::Terms;
using tests::visit_operations;
using tests::visit_powers;

constexpr double promise_of_derivatives = 1e-12;  // of the sum of magnitudes

/// What the entries of a table come to at a point.
std::vector<Terms> evaluate(const ExpressionMatrix& table, std::span<const double> point) {
  const std::vector<Terms> inputs(point.begin(), point.end());
  const std::span<const Expression> entries(table.data(), static_cast<std::size_t>(table.size()));
  return replay<Terms>(Schedule(entries), std::span<const Terms>(inputs));
}

void expect_near(const ExpressionMatrix& traced, const Eigen::MatrixXd& expected, std::span<const double> point) {
  const std::vector<Terms> found = evaluate(traced, point);
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    const Terms& entry = found[static_cast<std::size_t>(i)];
    EXPECT_NEAR(entry.value, expected.data()[i], promise_of_derivatives * entry.magnitude)
        << "entry " << i << " at (" << point[0] << ", " << point[1] << ")";
  }
}

/// Compares both orders with ADOL-C at random points of the domain.
struct CompareWithAdolc {
  template <class Formula>
  void operator()(const char* name, const Formula& formula, const Domain& domain) const {
    SCOPED_TRACE(name);
    const ExpressionVector x = input_vector(0, 2);
    const Expression f = formula(x[0], x[1]);
    const ExpressionMatrix first = gradient(f, x).transpose();
    const ExpressionMatrix second = hessian(f, x);
    tests::RandomPoints random;
    for (int sample = 0; sample < 20; ++sample) {
      const std::array<double, 2> point{random.number(domain.low, domain.high), random.number(domain.low, domain.high)};
      const AdolcReference reference(
          [&](std::span<const adouble> inputs) { return std::vector<adouble>{adouble(formula(inputs[0], inputs[1]))}; },
          point);
      expect_near(first, reference.first_derivatives(), point);
      expect_near(second, reference.second_derivatives(), point);
    }
  }
};

/// Binds the formula to one input read twice, and to a formula of both inputs: chain rule and
/// repeated operands.
struct CompareComposed {
  template <class Formula>
  void operator()(const char* name, const Formula& formula, const Domain& domain) const {
    const double middle = 0.5 * (domain.low + domain.high);
    const double reach = 0.5 * (domain.high - domain.low);
    const auto composed = [&](const auto& x, const auto& y) {
      using std::sin, std::cos;
      return formula(middle + reach * sin(x * y), middle + reach * sin(x) * cos(y));
    };
    CompareWithAdolc{}(name, composed, {-2.0, 2.0});
  }
};

TEST(Derivatives, OfEveryOperationAgreeWithAdolc) { visit_operations(CompareWithAdolc{}); }

TEST(Derivatives, OfEveryPowerAgreeWithAdolc) { visit_powers(CompareWithAdolc{}); }

TEST(Derivatives, FollowTheChainRuleThroughEveryOperation) { visit_operations(CompareComposed{}); }

TEST(Derivatives, FollowTheChainRuleThroughEveryPower) { visit_powers(CompareComposed{}); }

TEST(Derivatives, OfAConstantOrAnUnreadInputAreStructuralZeros) {
  const ExpressionVector x = input_vector(0, 3);
  EXPECT_TRUE(gradient(Expression(4.0), x)[1].is_zero());
  const Expression f = sin(x[0]) * x[2];
  EXPECT_TRUE(gradient(f, x)[1].is_zero());
  const ExpressionMatrix second = hessian(f, x);
  EXPECT_TRUE(second(1, 1).is_zero());
  EXPECT_TRUE(second(0, 1).is_zero());
  EXPECT_TRUE(second(2, 2).is_zero());
}

TEST(Derivatives, OfAnInputAreOneForItselfWhereverItStands) {
  const ExpressionVector x = input_vector(5, 3);
  const ExpressionVector twice{{x[1], x[0], x[1]}};
  const ExpressionVector first = gradient(x[1], twice);
  EXPECT_EQ(first[0].constant_value(), 1.0);
  EXPECT_TRUE(first[1].is_zero());
  EXPECT_EQ(first[2].constant_value(), 1.0);
}

TEST(Derivatives, OfALinearFormulaAreConstants) {
  const ExpressionVector x = input_vector(0, 2);
  const ExpressionVector f{{3.0 * x[0] - x[1] / 4.0, x[1] - (x[0] - 2.0)}};
  const ExpressionMatrix first = jacobian(f, x);
  EXPECT_EQ(first(0, 0).constant_value(), 3.0);
  EXPECT_EQ(first(0, 1).constant_value(), -0.25);
  EXPECT_EQ(first(1, 0).constant_value(), -1.0);
  EXPECT_EQ(first(1, 1).constant_value(), 1.0);
  const ExpressionMatrix second = hessian(f[0], x);
  for (const Expression& entry : second.reshaped()) EXPECT_TRUE(entry.is_zero());
}

TEST(Derivatives, HessianIsSymmetricNodeByNode) {
  const ExpressionVector x = input_vector(0, 3);
  const ExpressionMatrix second = hessian(sin(x[0] * x[1]) / (2.0 + cos(x[2] - x[0])), x);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) EXPECT_TRUE(second(i, j).is_same(second(j, i)));
  }
}

TEST(Derivatives, OfASharedPartAreSummedOverItsReaders) {
  const ExpressionVector x = input_vector(0, 1);
  const Expression shared = sin(x[0]);
  const Expression slope = gradient(shared * shared + exp(shared), x)[0];
  const double point = 0.7;
  const double s = std::sin(point);
  const std::vector<double> found = replay<double>(Schedule(std::span(&slope, 1)), std::span<const double>(&point, 1));
  EXPECT_NEAR(found[0], (2.0 * s + std::exp(s)) * std::cos(point), 1e-15 * 8.0);
}

TEST(Derivatives, WithRespectToAFormulaThrow) {
  const ExpressionVector x = input_vector(0, 2);
  const Expression f = x[0] * x[1];
  EXPECT_THROW(static_cast<void>(gradient(f, ExpressionVector{{x[0], f}})), Error);
  EXPECT_THROW(static_cast<void>(gradient(f, ExpressionVector{{Expression(1.0)}})), Error);
  EXPECT_THROW(static_cast<void>(jacobian(ExpressionVector{{f}}, ExpressionVector{{-x[0]}})), Error);
  EXPECT_THROW(static_cast<void>(hessian(f, ExpressionVector{{sin(x[0])}})), Error);
}

}  // namespace
}  // namespace dmocbench
