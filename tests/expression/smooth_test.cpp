#include "methods/expression/smooth.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "methods/expression/replay.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

constexpr double width = 0.01;

double value_at(const Expression& f, double x, double y) {
  const std::array<double, 2> point{x, y};
  return replay<double>(Schedule(std::span(&f, 1)), std::span<const double>(point))[0];
}

TEST(Smooth, FormsStayAsCloseToTheFunctionsTheyReplaceAsPromised) {
  const Expression x = Expression::input(0);
  const Expression y = Expression::input(1);
  tests::RandomPoints random;
  for (int sample = 0; sample < 200; ++sample) {
    const double a = random.number(-0.1, 0.1);
    const double b = sample % 4 == 0 ? a : random.number(-0.1, 0.1);
    const auto expect_above = [](double rounded, double sharp, double most) {
      EXPECT_GE(rounded, sharp);
      EXPECT_LE(rounded, sharp + most * (1.0 + 1e-14));
    };
    expect_above(value_at(smooth_abs(x, width), a, b), std::abs(a), width);
    expect_above(value_at(smooth_max(x, y, width), a, b), std::max(a, b), width / 2.0);
    expect_above(-value_at(smooth_min(x, y, width), a, b), -std::min(a, b), width / 2.0);
  }
}

TEST(Smooth, SignIsOddAndHalfAtTheStatedPlace) {
  const Expression sign = smooth_sign(Expression::input(0), width);
  EXPECT_EQ(value_at(sign, 0.0, 0.0), 0.0);
  EXPECT_NEAR(value_at(sign, width / std::sqrt(3.0), 0.0), 0.5, 1e-15);
  EXPECT_NEAR(value_at(sign, -1.0, 0.0), -1.0, width * width);
}

TEST(Smooth, ChoiceIsEitherFormulaFarAwayAndTheirMeanBetween) {
  const Expression x = Expression::input(0);
  const Expression choice = smooth_if_else(x, 2.0 + x, 5.0 - x, width);
  EXPECT_NEAR(value_at(choice, 1.0, 0.0), 3.0, 1e-14);
  EXPECT_NEAR(value_at(choice, -1.0, 0.0), 6.0, 1e-14);
  EXPECT_NEAR(value_at(choice, 0.0, 0.0), 3.5, 1e-14);
}

TEST(Smooth, HypotIsTheLengthOfBothLegs) {
  EXPECT_EQ(value_at(hypot(Expression::input(0), Expression::input(1)), 3.0, -4.0), 5.0);
}

TEST(Smooth, FormsRefuseAWidthThatIsNoneNamingThemselves) {
  const Expression x = Expression::input(0);
  tests::expect_error_naming({"smooth_abs", "eps > 0", "0"}, [&] { static_cast<void>(smooth_abs(x, 0.0)); });
  tests::expect_error_naming({"smooth_max", "-1"}, [&] { static_cast<void>(smooth_max(x, x, -1.0)); });
  tests::expect_error_naming({"smooth_min", "nan"}, [&] { static_cast<void>(smooth_min(x, x, std::nan(""))); });
  tests::expect_error_naming({"smooth_sign"}, [&] { static_cast<void>(smooth_sign(x, 0.0)); });
  tests::expect_error_naming({"smooth_if_else"}, [&] { static_cast<void>(smooth_if_else(x, x, x, 0.0)); });
}

}  // namespace
}  // namespace dmocbench
