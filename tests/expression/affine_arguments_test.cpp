#include "methods/expression/affine_arguments.hpp"

#include <cmath>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench {
namespace {

/// What the entries come to at a point.
std::vector<double> values_at(const std::vector<double>& point, std::span<const Expression> entries,
                              const Definitions& definitions = {}) {
  return replay<double>(Schedule(entries, definitions), std::span<const double>(point));
}

void expect_same_values(std::span<const double> found, std::span<const double> expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-13 * (1.0 + std::abs(expected[i])));
}

/// Formulas of an interval from a to b of length h, λ a multiplier, that meet their arguments in every way: twice, with
/// signs and factors, by products that cancel, beside terms that are affine, and not at all.
struct Interval {
  ExpressionVector x = input_vector(0, 5);  // two components of both ends and a control
  Expression h = Expression::input(5);
  Expression lambda = Expression::input(6);
  ExpressionVector middle = 0.5 * (x.head(2) + x.segment(2, 2));
  ExpressionVector rate = (x.segment(2, 2) - x.head(2)) / h;
  std::vector<Expression> formulas{cos(middle[0] - middle[1]) * rate[0] * rate[1] + lambda * middle[0],
                                   sin(-middle[0]) + cos(3.0 * middle[0]) * x[4],
                                   h* rate[0] * middle[1] + (x[0] - x[2]) * x[4],
                                   lambda* rate[1] - x[4],
                                   h* lambda,
                                   exp(x[0] * x[1]) / middle[0]};

  [[nodiscard]] static std::vector<double> random_point() {
    tests::RandomPoints random;
    std::vector<double> point(7);
    for (double& value : point) value = random.number(0.5, 1.5);
    return point;
  }
};

TEST(AffineArguments, FormulasOfArgumentsAreTheFormulas) {
  const Interval interval;
  const AffineArguments arguments(interval.formulas, interval.x);
  const std::vector<double> point = Interval::random_point();
  expect_same_values(values_at(point, arguments.formulas(), arguments.definitions()),
                     values_at(point, interval.formulas));
}

TEST(AffineArguments, CoefficientsDoNotDependOnTheUnknowns) {
  const Interval interval;
  const ExpressionMatrix a = AffineArguments(interval.formulas, interval.x).coefficients();
  const ExpressionVector entries = a.reshaped();
  const ExpressionMatrix by_unknowns = jacobian(entries, interval.x);
  for (const Expression& entry : by_unknowns.reshaped()) EXPECT_TRUE(entry.is_zero());
}

TEST(AffineArguments, SecondDerivativesAreThoseOfTheGradient) {
  const Interval interval;
  const std::vector<double> point = Interval::random_point();
  for (const Expression& f : interval.formulas) {
    const ExpressionVector first = gradient(f, interval.x);
    const ExpressionVector second = symmetric_jacobian(first, interval.x).reshaped();
    const DefinedDerivatives found = gradient_and_hessian(f, interval.x);
    const ExpressionVector found_second = found.hessian.reshaped();
    expect_same_values(values_at(point, entries_of(found.gradient), found.definitions),
                       values_at(point, entries_of(first)));
    expect_same_values(values_at(point, entries_of(found_second), found.definitions),
                       values_at(point, entries_of(second)));
    expect_same_values(values_at(point, entries_of(ExpressionVector(hessian(f, interval.x).reshaped()))),
                       values_at(point, entries_of(second)));
  }
}

TEST(AffineArguments, MidpointTakesFewerOperationsThanTheEnds) {
  const Interval interval;
  const Expression& f = interval.formulas.front();
  const DefinedDerivatives found = gradient_and_hessian(f, interval.x);
  const ExpressionVector by_middle = found.hessian.reshaped();
  const ExpressionVector by_ends = symmetric_jacobian(gradient(f, interval.x), interval.x).reshaped();
  EXPECT_LT(Schedule(entries_of(by_middle), found.definitions).operation_count(), Schedule(by_ends).operation_count());
}

TEST(AffineArguments, AreTheUnknownsThemselvesWhereThereAreTooMany) {
  const ExpressionVector x = input_vector(0, 2);
  const auto product_of = [&x](std::size_t factors) {
    Expression product(1.0);
    for (std::size_t i = 1; i <= factors; ++i) product *= Expression(1.0 + 1e-4 * static_cast<double>(i)) - 1e-5 * x[0];
    return product * x[1];
  };
  constexpr std::size_t most = 2 * AffineArguments::most_per_entry - 1;  // beside x[1]
  EXPECT_EQ(AffineArguments(std::vector{product_of(most)}, x).definitions().inputs.size(), Eigen::Index{most} + 1);
  const Expression f = product_of(3000);
  const AffineArguments arguments(std::vector{f}, x);
  ASSERT_EQ(arguments.coefficients().rows(), 2);
  EXPECT_TRUE(arguments.coefficients()(0, 0).is_same(Expression(1.0)) && arguments.coefficients()(0, 1).is_zero());
  const std::vector<double> point{0.5, 1.25};
  const DefinedDerivatives found = gradient_and_hessian(f, x);
  const ExpressionVector second = symmetric_jacobian(gradient(f, x), x).reshaped();
  expect_same_values(values_at(point, entries_of(ExpressionVector(found.hessian.reshaped())), found.definitions),
                     values_at(point, entries_of(second)));
}

TEST(AffineArguments, OfFormulasAreRefused) {
  const ExpressionVector x = input_vector(0, 1);
  EXPECT_THROW(AffineArguments(std::vector{sin(x[0])}, ExpressionVector{{sin(x[0])}}), Error);
}

}  // namespace
}  // namespace dmocbench
