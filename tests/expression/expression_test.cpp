#include "methods/expression/expression.hpp"

#include <cmath>
#include <concepts>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/expression/vectors.hpp"

namespace dmocbench {
namespace {

class Folding : public testing::Test {
 protected:
  Expression x = Expression::input(0);
  Expression y = Expression::input(1);
  Expression z = Expression::input(2);
};

TEST_F(Folding, EqualOperationsAreTheSameNode) {
  EXPECT_TRUE(Expression::input(0).is_same(x));
  EXPECT_TRUE((x + y).is_same(x + y));
  EXPECT_TRUE(sin(x * y).is_same(sin(x * y)));
  EXPECT_TRUE(atan2(x, y).is_same(atan2(x, y)));
  EXPECT_TRUE(pow(x, 2.5).is_same(pow(x, 2.5)));
  EXPECT_FALSE(pow(x, 2.5).is_same(pow(x, 3.5)));
  EXPECT_FALSE(atan2(x, y).is_same(atan2(y, x)));
  EXPECT_FALSE(x.is_same(y));
}

TEST_F(Folding, SumsAndProductsCommute) {
  EXPECT_TRUE((x + y).is_same(y + x));
  EXPECT_TRUE((x * y).is_same(y * x));
  EXPECT_TRUE((2.0 + x).is_same(x + 2.0));
  EXPECT_TRUE((2.0 * x).is_same(x * 2.0));
}

TEST_F(Folding, NeutralElementsVanish) {
  EXPECT_TRUE((x + 0.0).is_same(x));
  EXPECT_TRUE((0.0 + x).is_same(x));
  EXPECT_TRUE((x - 0.0).is_same(x));
  EXPECT_TRUE((0.0 - x).is_same(-x));
  EXPECT_TRUE((1.0 * x).is_same(x));
  EXPECT_TRUE((x / 1.0).is_same(x));
  EXPECT_TRUE((x * -1.0).is_same(-x));
  EXPECT_TRUE((+x).is_same(x));
  EXPECT_TRUE(pow(x, 1.0).is_same(x));
}

TEST_F(Folding, ZeroIsStructural) {
  EXPECT_TRUE((0.0 * x).is_zero());
  EXPECT_TRUE((x * -0.0).is_zero());
  EXPECT_TRUE((0.0 / x).is_zero());
  EXPECT_TRUE((x - x).is_zero());
  EXPECT_TRUE((x * y - y * x).is_zero());
  EXPECT_TRUE((x + y - (y + x)).is_zero());
  EXPECT_TRUE((x - y + (y - x)).is_zero());
  EXPECT_TRUE((0.0 * x + 0.0 * sin(y)).is_zero());
  EXPECT_FALSE(x.is_zero());
  EXPECT_FALSE(Expression(1e-300).is_zero());
}

TEST_F(Folding, ConstantsAreComputedWhileTracing) {
  EXPECT_EQ((Expression(2.0) * 3.0 + 4.0).constant_value(), 10.0);
  EXPECT_EQ((Expression(1.0) / 4.0 - 1.0).constant_value(), -0.75);
  EXPECT_EQ(atan2(Expression(1.0), Expression(-1.0)).constant_value(), std::atan2(1.0, -1.0));
  EXPECT_EQ(pow(Expression(2.0), -0.5).constant_value(), std::pow(2.0, -0.5));
  const std::vector<std::pair<Expression (*)(const Expression&), double (*)(double)>> functions{
      {sqrt, std::sqrt}, {exp, std::exp},   {log, std::log},   {sin, std::sin},   {cos, std::cos},   {tan, std::tan},
      {asin, std::asin}, {acos, std::acos}, {atan, std::atan}, {sinh, std::sinh}, {cosh, std::cosh}, {tanh, std::tanh}};
  for (const auto& [traced, plain] : functions) {
    EXPECT_EQ(traced(Expression(0.7)).constant_value(), plain(0.7));
  }
  EXPECT_EQ(pow(x, 0.0).constant_value(), 1.0);
  EXPECT_FALSE(x.constant_value().has_value());
}

TEST_F(Folding, NumericFactorsAreCollected) {
  EXPECT_TRUE((2.0 * (3.0 * x)).is_same(6.0 * x));
  EXPECT_TRUE((2.0 * x * (3.0 * y)).is_same(6.0 * (x * y)));
  EXPECT_TRUE((2.0 * x + 3.0 * x).is_same(5.0 * x));
  EXPECT_TRUE((x + x).is_same(2.0 * x));
  EXPECT_TRUE((3.0 * x - 2.0 * x).is_same(x));
  EXPECT_TRUE((2.0 * x - 2.0 * x).is_zero());
  EXPECT_TRUE((x / 4.0).is_same(0.25 * x));
  EXPECT_TRUE((8.0 * x / (2.0 * y)).is_same(4.0 * (x / y)));
}

TEST_F(Folding, ACommonNumericFactorIsTakenOut) {
  EXPECT_TRUE((2.0 * x + 2.0 * y).is_same(2.0 * (x + y)));
  EXPECT_TRUE((2.0 * x - 2.0 * y).is_same(2.0 * (x - y)));
  EXPECT_TRUE((-3.0 * x - 3.0 * y).is_same(-3.0 * (x + y)));
}

TEST_F(Folding, SignsMoveOutside) {
  EXPECT_TRUE((-(-x)).is_same(x));
  EXPECT_TRUE((-x * y).is_same(-(x * y)));
  EXPECT_TRUE((-x * -y).is_same(x * y));
  EXPECT_TRUE((-x / y).is_same(-(x / y)));
  EXPECT_TRUE((x / -y).is_same(-(x / y)));
  EXPECT_TRUE((x + -y).is_same(x - y));
  EXPECT_TRUE((-x - y).is_same(-(x + y)));
  EXPECT_TRUE((-2.0 * x).is_same(-(2.0 * x)));
  EXPECT_TRUE((1.0 - x).is_same(-(x - 1.0)));
}

TEST_F(Folding, ADifferenceAndItsReverseAreOneNodeAndItsNegative) {
  const Expression forward = x - y;
  EXPECT_TRUE((y - x).is_same(-forward));
  EXPECT_TRUE((-(y - x)).is_same(forward));
  EXPECT_TRUE((forward + (y - x)).is_zero());
  EXPECT_TRUE((-forward + forward).is_zero());
  EXPECT_TRUE((sin(y - x) + sin(forward)).is_zero());
  EXPECT_TRUE(cos(y - x).is_same(cos(forward)));
  EXPECT_TRUE(((y - x) * (y - x)).is_same(forward * forward));
}

TEST_F(Folding, OddFunctionsPassSignsAndEvenOnesDropThem) {
  using Function = Expression (*)(const Expression&);
  for (const Function odd : std::initializer_list<Function>{sin, tan, asin, atan, sinh, tanh}) {
    EXPECT_TRUE(odd(-x).is_same(-odd(x)));
    EXPECT_TRUE(odd(-2.0 * x).is_same(-odd(2.0 * x)));
  }
  for (const Function even : std::initializer_list<Function>{cos, cosh}) {
    EXPECT_TRUE(even(-x).is_same(even(x)));
    EXPECT_TRUE(even(-2.0 * x).is_same(even(2.0 * x)));
  }
  EXPECT_FALSE(acos(-x).is_same(-acos(x)));
  EXPECT_FALSE(exp(-x).is_same(exp(x)));
}

TEST_F(Folding, AFactorMeetsItsReciprocal) {
  EXPECT_TRUE((x * y / y).is_same(x));
  EXPECT_TRUE((x / y * y).is_same(x));
  EXPECT_EQ((x / x).constant_value(), 1.0);
  EXPECT_TRUE((1.0 / (1.0 / x)).is_same(x));
  EXPECT_TRUE((x / (1.0 / y)).is_same(x * y));
  EXPECT_TRUE((x * y * z / x / y).is_same(z));
  EXPECT_TRUE((x * sin(y) * z / sin(y)).is_same(x * z));
  EXPECT_TRUE((2.0 * x * y / (4.0 * y)).is_same(0.5 * x));
  EXPECT_TRUE(((x + z) * y / y - (x + z)).is_zero());
  EXPECT_FALSE((x * x / y).is_same(x));
}

TEST_F(Folding, CompoundAssignmentsAreTheOperations) {
  Expression f = x;
  f += y;
  EXPECT_TRUE(f.is_same(x + y));
  f *= z;
  EXPECT_TRUE(f.is_same((x + y) * z));
  f -= x;
  EXPECT_TRUE(f.is_same((x + y) * z - x));
  f /= y;
  EXPECT_TRUE(f.is_same(((x + y) * z - x) / y));
  const Expression same = f;
  f -= same;
  EXPECT_TRUE(f.is_zero());
}

TEST_F(Folding, MatrixTimesVectorKeepsStructuralZeros) {
  ExpressionMatrix a(2, 2);
  a << Expression(0.0), x, Expression(1.0), Expression(0.0);
  const ExpressionVector product = a * ExpressionVector{{y, z}};
  EXPECT_TRUE(product[0].is_same(x * z));
  EXPECT_TRUE(product[1].is_same(y));
}

// A formula that branched on a traced value would be traced on one side only.
template <class A, class B>
concept SomehowComparable =
    requires(const A& a, const B& b) { a == b; } || requires(const A& a, const B& b) { a != b; } ||
    requires(const A& a, const B& b) { a < b; } || requires(const A& a, const B& b) { a <= b; } ||
    requires(const A& a, const B& b) { a > b; } || requires(const A& a, const B& b) { a >= b; };

static_assert(SomehowComparable<double, double>, "the concept itself has to see comparisons");
static_assert(!SomehowComparable<Expression, Expression>);
static_assert(!SomehowComparable<Expression, double>);
static_assert(!SomehowComparable<double, Expression>);
static_assert(!SomehowComparable<Expression, int>);
static_assert(!SomehowComparable<int, Expression>);
static_assert(!std::is_convertible_v<Expression, double>);
static_assert(!std::is_convertible_v<Expression, bool>);
static_assert(!std::is_constructible_v<double, Expression>);
static_assert(!std::is_constructible_v<bool, Expression>);

template <class A>
concept SomehowACondition =
    requires(const A& a) { a ? 1 : 0; } || requires(const A& a) { !a; } || requires(const A& a) { a&& a; };

static_assert(SomehowACondition<double>, "the concept itself has to see conditions");
static_assert(!SomehowACondition<Expression>);

static_assert(std::copyable<Expression>);
static_assert(std::is_nothrow_move_constructible_v<Expression>);

}  // namespace
}  // namespace dmocbench
