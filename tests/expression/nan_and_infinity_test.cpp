// NaN, infinities and extreme numbers go through the tape as they go through the functions of std.

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/expression/operations.hpp"
#include "tests/expression/series_table.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench {
namespace {

using tests::RandomPoints;
using tests::SeriesTable;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// What std makes NaN is NaN, what it makes infinite is the same infinity, and numbers agree.
void expect_as_std(double found, double expected) {
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(found)) << found;
  } else if (std::isinf(expected)) {
    EXPECT_EQ(found, expected);
  } else {
    EXPECT_NEAR(found, expected, 1e-13 * std::max(1.0, std::abs(expected)));
  }
}

const std::vector<double>& special_numbers() {
  static const std::vector<double> numbers{
      nan,  infinity, -infinity, 0.0,    -0.0,  1.0,    -1.0,
      0.5,  -0.5,     2.0,       -3.0,   1e300, -1e300, std::numeric_limits<double>::denorm_min(),
      1e10, -1e5,     710.0,     -750.0, 1e-300};
  return numbers;
}

/// All pairs of special numbers.
SeriesTable special_series() {
  SeriesTable inputs(2);
  for (const double x : special_numbers()) {
    for (const double y : special_numbers()) {
      inputs[0].push_back(x);
      inputs[1].push_back(y);
    }
  }
  return inputs;
}

struct CompareSpecialNumbers {
  template <class Formula>
  void operator()(const char* name, const Formula& formula, const tests::Domain& /*of use*/) const {
    SCOPED_TRACE(name);
    const ExpressionVector x = input_vector(0, 2);
    const Schedule schedule(ExpressionVector{{formula(x[0], x[1])}});
    const SeriesTable inputs = special_series();
    const std::size_t total = inputs[0].size();
    for (const InstructionSet set : available_instruction_sets()) {
      SCOPED_TRACE(name_of(set));
      const Tape tape(schedule, set);
      // Whole blocks and every length of a partial block's remainder.
      for (std::size_t cut = 0; cut < 9; ++cut) {
        const SeriesTable found = tests::evaluate(tape, inputs, total - cut);
        for (std::size_t k = 0; k < total - cut; ++k) {
          SCOPED_TRACE(testing::Message() << "x = " << inputs[0][k] << ", y = " << inputs[1][k]);
          expect_as_std(found[0][k], formula(inputs[0][k], inputs[1][k]));
        }
      }
    }
  }
};

TEST(NanAndInfinity, PassEveryOperationAsInStd) { tests::visit_operations(CompareSpecialNumbers{}); }

TEST(NanAndInfinity, PassEveryPowerAsInStd) {
  const CompareSpecialNumbers compare;
  // Not ±1/2: sqrt and pow differ at -infinity and -0, see HalfPowersAreSquareRoots.
  for (const double exponent : {2.0, 3.0, 16.0, -1.0, -2.0, 1.5, -1.5, 17.0, -17.0, 0.3, -0.7}) {
    compare(("x^" + std::to_string(exponent)).c_str(),
            [exponent](const auto& x, const auto& /*y*/) {
              using std::pow;
              return pow(x, exponent);
            },
            {});
  }
}

TEST(NanAndInfinity, HalfPowersAreSquareRoots) {
  const Expression x = Expression::input(0);
  EXPECT_TRUE(pow(x, 0.5).is_same(sqrt(x)));
  EXPECT_TRUE(pow(x, -0.5).is_same(1.0 / sqrt(x)));
}

TEST(NanAndInfinity, NamedCasesComeOutAsTheyShould) {
  const Expression x = Expression::input(0);
  struct Case {
    Expression formula;
    double at;
    double expected;
  };
  const std::vector<Case> cases{
      {sin(x), infinity, nan},  {cos(x), -infinity, nan},   {exp(x), -infinity, 0.0},    {exp(x), infinity, infinity},
      {log(x), 0.0, -infinity}, {log(x), -1.0, nan},        {sqrt(x), -1.0, nan},        {sqrt(x), infinity, infinity},
      {1.0 / x, 0.0, infinity}, {1.0 / x, -0.0, -infinity}, {1.0 / x, infinity, 0.0},    {asin(x), 1.5, nan},
      {acos(x), -1.5, nan},     {tanh(x), -infinity, -1.0}, {x * x, -infinity, infinity}};
  for (const InstructionSet set : available_instruction_sets()) {
    for (const auto& entry : cases) {
      const Tape tape(Schedule(ExpressionVector{{entry.formula}}), set);
      for (const std::size_t count : {1U, 5U, 64U, 67U}) {
        const SeriesTable found = tests::evaluate(tape, {std::vector<double>(count, entry.at)}, count);
        for (const double value : found[0]) expect_as_std(value, entry.expected);
      }
    }
  }
}

/// One interval has NaN; the values of all others are as if it had not.
struct ExpectNanStaysInItsInterval {
  template <class Formula>
  void operator()(const char* name, const Formula& formula, const tests::Domain& domain) const {
    SCOPED_TRACE(name);
    const ExpressionVector x = input_vector(0, 2);
    const Schedule schedule(ExpressionVector{{formula(x[0], x[1])}});
    RandomPoints random;
    constexpr std::size_t count = 77;
    SeriesTable inputs(2, std::vector<double>(count));
    for (auto& column : inputs) {
      for (double& entry : column) entry = random.number(domain.low, domain.high);
    }
    for (const InstructionSet set : available_instruction_sets()) {
      const Tape tape(schedule, set);
      for (std::size_t place = 0; place < count; ++place) {
        SeriesTable disturbed = inputs;
        disturbed[0][place] = disturbed[1][place] = nan;
        const SeriesTable found = tests::evaluate(tape, disturbed, count);
        for (std::size_t k = 0; k < count; ++k) {
          expect_as_std(found[0][k], formula(disturbed[0][k], disturbed[1][k]));
        }
        EXPECT_TRUE(std::isnan(found[0][place]));
      }
    }
  }
};

TEST(NanAndInfinity, StayInTheirInterval) { tests::visit_operations(ExpectNanStaysInItsInterval{}); }

TEST(NanAndInfinity, LargeArgumentsOfSineAndCosineKeepTheirAccuracy) {
  const Expression x = Expression::input(0);
  const Schedule schedule(ExpressionVector{{sin(x), cos(x)}});
  SeriesTable inputs(1);
  RandomPoints random;
  for (const double size : {1.0, 30.0, 1e3, 1e5, 1e7, 1e10, 1e15, 1e22, 1e100, 1e300}) {
    inputs[0].push_back(size);
    inputs[0].push_back(-size);
    for (int i = 0; i < 30; ++i) inputs[0].push_back(size * random.number(-1.0, 1.0));
  }
  const std::size_t count = inputs[0].size();
  for (const InstructionSet set : available_instruction_sets()) {
    const SeriesTable found = tests::evaluate(Tape(schedule, set), inputs, count);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_NEAR(found[0][k], std::sin(inputs[0][k]), 1e-13) << inputs[0][k] << ' ' << name_of(set);
      EXPECT_NEAR(found[1][k], std::cos(inputs[0][k]), 1e-13) << inputs[0][k] << ' ' << name_of(set);
    }
  }
}

TEST(NanAndInfinity, SmallArgumentsOfSineKeepTheirRelativeAccuracy) {
  const Schedule schedule(ExpressionVector{{sin(Expression::input(0))}});
  SeriesTable inputs(1);
  for (int exponent = -300; exponent <= 0; ++exponent) inputs[0].push_back(std::pow(10.0, exponent));
  const std::size_t count = inputs[0].size();
  for (const InstructionSet set : available_instruction_sets()) {
    const SeriesTable found = tests::evaluate(Tape(schedule, set), inputs, count);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_NEAR(found[0][k] / std::sin(inputs[0][k]), 1.0, 1e-15) << inputs[0][k];
    }
  }
}

TEST(NanAndInfinity, PassConstantsWhileTracing) {
  EXPECT_TRUE(std::isnan(Expression(nan).constant_value().value_or(0.0)));
  EXPECT_TRUE(std::isnan((0.0 * Expression(infinity)).constant_value().value_or(0.0)));
  EXPECT_TRUE(std::isnan((Expression(0.0) / 0.0).constant_value().value_or(0.0)));
  EXPECT_EQ((Expression(-1.0) / 0.0).constant_value(), -infinity);
  EXPECT_EQ(log(Expression(0.0)).constant_value(), -infinity);
}

TEST(NanAndInfinity, QuotientsByTheConstantZeroAreSummedAsStdDoes) {
  const ExpressionVector x = input_vector(0, 2);
  const Schedule schedule(ExpressionVector{{x[0] / 0.0 + x[1] / 0.0, x[0] / 0.0 - x[1] / 0.0, x[0] * nan - x[1]}});
  const std::vector<double> point{1.0, 2.0};
  const std::vector<double> found = replay<double>(schedule, std::span<const double>(point));
  EXPECT_EQ(found[0], infinity);
  EXPECT_FALSE(std::isfinite(found[1]));
  EXPECT_TRUE(std::isnan(found[2]));
}

}  // namespace
}  // namespace dmocbench
