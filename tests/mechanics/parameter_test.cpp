#include <limits>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/mechanics/problem.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

Parameter mass() { return {.name = "mass", .value = 1.0, .unit = "kg", .meaning = "mass", .lower = 0.5, .upper = 2.0}; }

Parameter count() {
  Parameter parameter = mass();
  parameter.name = "revolutions";
  parameter.unit = "";
  parameter.lower = 1.0;
  parameter.upper = 100.0;
  parameter.whole = true;
  return parameter;
}

TEST(Parameter, TakesEveryValueOfItsRangeTheEndsIncluded) {
  for (const double value : {0.5, 0.75, 2.0}) EXPECT_NO_THROW(mass().check(value));
  for (const double value : {1.0, 7.0, 100.0}) EXPECT_NO_THROW(count().check(value));
}

TEST(Parameter, RefusesValuesOutsideNamingItselfItsRangeItsUnitAndTheValue) {
  tests::expect_error_naming({"mass", "[0.5, 2]", "kg", "0.25"}, [] { mass().check(0.25); });
  tests::expect_error_naming({"mass", "[0.5, 2]", "2.5"}, [] { mass().check(2.5); });
}

TEST(Parameter, RefusesWhatIsNotANumberAndInfinity) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  tests::expect_error_naming({"mass", "nan"}, [] { mass().check(std::numeric_limits<double>::quiet_NaN()); });
  tests::expect_error_naming({"mass", "inf"}, [] { mass().check(infinity); });
  tests::expect_error_naming({"mass", "-inf"}, [] { mass().check(-infinity); });
}

TEST(Parameter, RefusesFractionsWhereOnlyWholeNumbersAreAllowed) {
  tests::expect_error_naming({"revolutions", "whole number", "[1, 100]", "2.5"}, [] { count().check(2.5); });
  EXPECT_EQ(mass().range(), "a number in [0.5, 2]");
}

TEST(Parameter, RefusesInfinityEvenWithoutARange) {
  Parameter free;
  free.name = "free";
  EXPECT_NO_THROW(free.check(-1e300));
  EXPECT_THROW(free.check(std::numeric_limits<double>::infinity()), Error);
}

}  // namespace
}  // namespace dmocbench
