#include "methods/mechanics/problem.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

/// A problem with two parameters.
class Tunable final : public Problem {
 public:
  explicit Tunable(double default_mass = 1.0)
      : Problem({{.name = "mass", .value = default_mass, .unit = "kg", .meaning = "mass", .lower = 0.0, .upper = 2.0},
                 {.name = "turns",
                  .value = 3.0,
                  .unit = "",
                  .meaning = "turns",
                  .lower = 1.0,
                  .upper = 9.0,
                  .whole = true}}) {}
  [[nodiscard]] std::string name() const override { return "tunable"; }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"a", "b"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"c"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * parameter("mass") * (x.v[0] * x.v[0] + x.v[1] * x.v[1]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector::Constant(2, x.u[0]);
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0]; }
  [[nodiscard]] BoundaryState initial_state() const override {
    return {Eigen::Vector2d(1.0, 2.0), Eigen::Vector2d::Zero()};
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return {Eigen::Vector2d(5.0, -2.0), Eigen::Vector2d::Zero()};
  }
  [[nodiscard]] double horizon() const override { return 2.0; }
};

/// A class that states nothing but what has to be stated, and the line that makes it copied by its base.
class FreeFlight : public Problem {
 public:
  explicit FreeFlight(double span = 1.0)
      : Problem({{.name = "mass", .value = 1.0, .unit = "kg", .meaning = "of the body"}}), span_(span) {}
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"f"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * parameter("mass") * x.v.squaredNorm();
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u.squaredNorm(); }
  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Zero(1));
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Constant(1, span_));
  }
  [[nodiscard]] double horizon() const override { return 1.0; }

 private:
  double span_;
};

/// A variant: another end, all else as it is.
class FreeFlightUpwards : public FreeFlight {
  [[nodiscard]] double horizon() const override { return 2.0; }
};

/// C = a (1 + u²) and Φ = b, at rest for one unit of time.
class Costly final : public tests::SmallProblem {
 public:
  Costly(double a, double b) : SmallProblem("costly", at(0.0, 0.0), at(0.0, 0.0), 1.0, 1), a_(a), b_(b) {}
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return a_ * (1.0 + x.u[0] * x.u[0]);
  }
  [[nodiscard]] Expression final_cost(const State& /*last*/) const override { return b_; }

 private:
  double a_;
  double b_;
};

TEST(Problem, CostIsScaledByAPowerOfTwoToBeOfOrderOneAlongTheGuess) {
  EXPECT_EQ(Costly(1e-3, 0.0).cost_scale(), 1024.0);
  EXPECT_EQ(Costly(-1e-3, 0.0).cost_scale(), 1024.0) << "magnitudes count";
  EXPECT_EQ(Costly(0.0, 500.0).cost_scale(), 1.0 / 512.0);
  EXPECT_EQ(Costly(1e-3, -1e-3).cost_scale(), 512.0);
}

TEST(Problem, CostIsLeftAloneWhereTheGuessSaysNothingOrItIsOfOrderOne) {
  for (const double cost :
       {1.0, 0.05, 20.0, 0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(Costly(cost, 0.0).cost_scale(), 1.0) << cost;
  }
}

TEST(Problem, SetParameterIsReadBackAndReachesTheFormulas) {
  Tunable problem;
  const State x{input_vector(0, 2), input_vector(2, 2), Expression::input(5)};
  const Expression before = problem.lagrangian(x);
  problem.set_parameter("mass", 1.5);
  EXPECT_EQ(problem.parameter("mass"), 1.5);
  EXPECT_EQ(problem.parameter("turns"), 3.0);
  EXPECT_FALSE(problem.lagrangian(x).is_same(before));
}

TEST(Problem, UnknownParametersListTheKnownOnes) {
  Tunable problem;
  tests::expect_error_naming({"tunable", "\"length\"", "mass", "turns"}, [&] { problem.set_parameter("length", 1.0); });
  tests::expect_error_naming({"tunable", "\"length\"", "mass", "turns"},
                             [&] { static_cast<void>(problem.parameter("length")); });
  tests::DoubleIntegrator plain;
  tests::expect_error_naming({"none"}, [&] { plain.set_parameter("length", 1.0); });
}

TEST(Problem, ARefusedValueChangesNothing) {
  Tunable problem;
  tests::expect_error_naming({"mass", "[0, 2]"}, [&] { problem.set_parameter("mass", 3.0); });
  tests::expect_error_naming({"turns", "whole"}, [&] { problem.set_parameter("turns", 2.5); });
  EXPECT_EQ(problem.parameter("mass"), 1.0);
  EXPECT_EQ(problem.parameter("turns"), 3.0);
}

TEST(Problem, RefusesADefaultOutsideItsOwnRange) {
  tests::expect_error_naming({"mass"}, [] { Tunable{-1.0}; });
}

TEST(Problem, GuessesTheStraightLineBetweenItsEnds) {
  const Tunable problem;
  const MotionPoint middle = problem.guess(0.5);
  EXPECT_EQ(middle.q, Eigen::Vector2d(2.0, 1.0));
  EXPECT_EQ(middle.v, Eigen::Vector2d(2.0, -2.0));
  EXPECT_EQ(middle.u, Eigen::VectorXd::Zero(1));
  EXPECT_EQ(problem.guess(0.0).q, problem.initial_state().q);
  EXPECT_EQ(problem.guess(2.0).q, problem.final_state().q);
}

TEST(Problem, ShowsItsConfigurationAndControlUnlessItSaysOtherwise) {
  const Tunable problem;
  const ControlledState x{input_vector(0, 2), input_vector(2, 2), input_vector(4, 1), Expression::input(5)};
  const Picture quantities = pictured_quantities(problem, x);
  ASSERT_EQ(quantities.size(), 3U);
  EXPECT_EQ(quantities[0].name, "a");
  EXPECT_EQ(quantities[2].name, "c");
  EXPECT_TRUE(quantities[1].value.is_same(x.q[1]));
  EXPECT_TRUE(quantities[2].value.is_same(x.u[0]));
}

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

TEST(Problem, IsNamedAfterItsClassUnlessItSaysOtherwise) {
  EXPECT_EQ(FreeFlight().name(), "free_flight");
  EXPECT_EQ(FreeFlightUpwards().name(), "free_flight_upwards");
  EXPECT_EQ(Tunable().name(), "tunable");
}

TEST(Problem, CopiesAreIndependentAndKeepParametersAndMembers) {
  FreeFlight original(3.0);
  original.set_parameter("mass", 5.0);
  const std::unique_ptr<Problem> by_base = original.clone();
  FreeFlight by_class = original;
  by_class.set_parameter("mass", 7.0);
  EXPECT_EQ(original.parameter("mass"), 5.0);
  EXPECT_EQ(by_base->parameter("mass"), 5.0);
  EXPECT_EQ(by_base->final_state().q[0], 3.0);
  EXPECT_FALSE(by_base->has_default_parameters());
  EXPECT_EQ(by_class.parameter("mass"), 7.0);
}

TEST(Problem, WhoseClassDoesNotSayHowItIsCopiedTellsTheLineThatDoes) {
  tests::expect_error_naming({"tunable", "Tunable", "copy_of(*this)"}, [] { static_cast<void>(Tunable().clone()); });
  // The base's line would lose what the derived class adds.
  tests::expect_error_naming({"FreeFlightUpwards", "copy_of(*this)"},
                             [] { static_cast<void>(FreeFlightUpwards().clone()); });
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

TEST(ForwardingProblem, ReadsTheParametersOfItsOriginalAndDoesNotSetThem) {
  Tunable original;
  tests::WithEnds forwarding(original, original.initial_state(), original.final_state());
  original.set_parameter("mass", 2.0);
  EXPECT_EQ(forwarding.parameter("mass"), 2.0);
  tests::expect_error_naming({"tunable", "another problem"}, [&] { forwarding.set_parameter("mass", 1.0); });
}

}  // namespace
}  // namespace dmocbench
