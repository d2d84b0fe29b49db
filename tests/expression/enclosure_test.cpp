#include "methods/expression/enclosure.hpp"

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/expression/expression.hpp"
#include "methods/expression/replay.hpp"

namespace dmocbench {
namespace {

using Formula = std::function<Expression(const Expression&)>;

/// Formulas of one variable, which between them contain every operation.
std::vector<std::pair<std::string, Formula>> formulas() {
  return {{"polynomial", [](const Expression& x) { return x * x * x - 2.0 * x * x + 3.0 - x; }},
          {"quotient", [](const Expression& x) { return (x - 1.0) / (1.5 + x * x) - 1.0 / (x + 9.0); }},
          {"root and logarithm", [](const Expression& x) { return sqrt(1.0 + x * x) * log(5.0 + x); }},
          {"exponential", [](const Expression& x) { return 0.5 - exp(-x * x / 0.01); }},
          {"trigonometric", [](const Expression& x) { return sin(3.0 * x) * cos(x) + tan(0.3 * x); }},
          {"inverse", [](const Expression& x) { return asin(0.2 * x) + acos(0.2 * x) * atan(x); }},
          {"angle", [](const Expression& x) { return atan2(x - 0.5, x * x - 1.0) * 0.5; }},
          {"hyperbolic", [](const Expression& x) { return sinh(x) - cosh(0.5 * x) + tanh(4.0 * x) + asinh(x); }},
          {"powers",
           [](const Expression& x) { return pow(x, 4.0) - pow(x, 3.0) + pow(x + 4.5, 2.5) - pow(x + 4.5, -1.5); }},
          {"error function", [](const Expression& x) { return erf(2.0 * x); }}};
}

Schedule traced(const Formula& formula) {
  const std::vector<Expression> outputs{formula(Expression::input(0))};
  return Schedule(outputs);
}

double value_of(const Schedule& schedule, double x) { return replay<double>(schedule, std::vector{x}).front(); }

EnclosedRate enclosed(const Schedule& schedule, double from, double to) {
  return replay<EnclosedRate>(schedule, std::vector{EnclosedRate({from, to}, {1.0, 1.0})}).front();
}

TEST(Enclosure, ContainsEveryValueAndEveryRateOfAFormula) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> between(-4.0, 4.0);
  for (const auto& [name, formula] : formulas()) {
    const Schedule schedule = traced(formula);
    for (int trial = 0; trial < 200; ++trial) {
      const double from = between(random);
      const double to = from + std::pow(10.0, -0.5 * (trial % 8)) * (4.0 - from) / 8.0;
      const EnclosedRate found = enclosed(schedule, from, to);
      for (int i = 0; i <= 20; ++i) {
        const double x = from + (to - from) * i / 20.0;
        const double value = value_of(schedule, x);
        const double rounding = 1e-12 * (1.0 + std::abs(value));
        EXPECT_GE(value, found.value.lower - rounding) << name << " at " << x;
        EXPECT_LE(value, found.value.upper + rounding) << name << " at " << x;
        if (name == "angle") continue;  // it jumps where its second argument is negative
        constexpr double step = 1e-6;
        const double rate = (value_of(schedule, x + step) - value_of(schedule, x - step)) / (2.0 * step);
        const double error = 1e-4 * (1.0 + std::abs(rate));
        EXPECT_GE(rate, found.rate.lower - error) << name << " at " << x;
        EXPECT_LE(rate, found.rate.upper + error) << name << " at " << x;
      }
    }
  }
}

TEST(Enclosure, ShrinksWithItsArgument) {
  for (const auto& [name, formula] : formulas()) {
    const Schedule schedule = traced(formula);
    const auto width = [&](double size) {
      const Enclosure value = enclosed(schedule, 0.3, 0.3 + size).value;
      return value.upper - value.lower;
    };
    EXPECT_LT(width(1e-4), 1e-2) << name;
    EXPECT_LT(width(1e-6), 0.02 * width(1e-4) + 1e-14) << name;
  }
}

TEST(Enclosure, OfAFormulaThatMayLeaveItsDomainIsUnbounded) {
  const auto is_unbounded = [](const Formula& formula, double from, double to) {
    const EnclosedRate found = enclosed(traced(formula), from, to);
    return std::isinf(found.value.lower) || std::isinf(found.value.upper) || std::isinf(found.rate.upper);
  };
  EXPECT_TRUE(is_unbounded([](const Expression& x) { return 1.0 / x; }, -1.0, 2.0));
  EXPECT_TRUE(is_unbounded([](const Expression& x) { return log(x); }, -1.0, 2.0));
  EXPECT_TRUE(is_unbounded([](const Expression& x) { return sqrt(x); }, -1.0, 2.0));
  EXPECT_TRUE(is_unbounded([](const Expression& x) { return tan(x); }, 1.0, 2.0));
  EXPECT_TRUE(is_unbounded([](const Expression& x) { return detail::unit_step(x); }, -1.0, 1.0));
  EXPECT_FALSE(is_unbounded([](const Expression& x) { return 1.0 / x; }, 1.0, 2.0));
}

}  // namespace
}  // namespace dmocbench
