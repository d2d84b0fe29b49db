#include <gtest/gtest.h>

#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Restated;
using Statement = Restated::Statement;

/// About 1 within `width` of t = ½, else about 0.
Expression window_about_half(const Expression& t, double width) {
  const double steepness = 20.0 / width;
  const Expression after = 1.0 / (1.0 + exp(-steepness * (t - 0.5 + width)));
  return after / (1.0 + exp(steepness * (t - 0.5 - width)));
}

/// The double integrator with one path constraint; its guess goes evenly from 0 to 1.
Restated with_path_constraint(const Problem& base,
                              const std::function<Expression(const ControlledState&)>& constraint) {
  return Restated(base, [constraint](Statement& s) {
    s.path_constraints = [constraint](const ControlledState& x) {
      return ExpressionVector::Constant(1, constraint(x));
    };
  });
}

class ConstraintWindows : public testing::Test {
 protected:
  const tests::DoubleIntegrator base_;
  /// q >= 0.8 within 0.02 of t = ½.
  const Restated gate_ =
      with_path_constraint(base_, [](const ControlledState& x) { return x.q[0] - 0.8 * window_about_half(x.t, 0.02); });
};

TEST_F(ConstraintWindows, BetweenTheStagesAreRefused) {
  // Stages at 7/16 and 9/16.
  tests::expect_error_naming({"path_constraints[0]", "from t = 0.4", "to 0.5", "0.4375 and 0.5625", "more intervals"},
                             [&] {
                               static_cast<void>(tests::transcribe(gate_, {"dmoc", 1}, Grid::uniform(8)));
                             });
}

TEST_F(ConstraintWindows, ThatAStageMeetsAreAccepted) {
  EXPECT_NO_THROW(static_cast<void>(tests::transcribe(gate_, {"dmoc", 1}, Grid::uniform(9))));
  EXPECT_NO_THROW(static_cast<void>(tests::transcribe(gate_, {"tangent", 3}, Grid::uniform(9))));
}

TEST_F(ConstraintWindows, AreThoseOfTimeNotThoseOfTheMotion) {
  // The guess crosses a narrow obstacle between two stages, whenever it comes there.
  const Restated obstacle = with_path_constraint(base_, [](const ControlledState& x) {
    const Expression d = x.q[0] - 0.5 - 0.001 * x.t;
    return d * d - 1e-4;
  });
  EXPECT_NO_THROW(static_cast<void>(tests::transcribe(obstacle, {"dmoc", 1}, Grid::uniform(8))));
}

}  // namespace
}  // namespace dmocbench
