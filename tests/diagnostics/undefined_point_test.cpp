#include "methods/diagnostics/undefined_point.hpp"

#include <gtest/gtest.h>

#include "methods/solvers/solver.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

/// L = ½v² + log(q - 1)/100, f = u, C = ½u², thrown down from q = 2 to return in T = 1: below q = 1 the Lagrangian is
/// not defined, and L_q = 1/(q - 1)/100 is a number all the same.
class ThrownDown final : public tests::SmallProblem {
 public:
  explicit ThrownDown(double speed) : SmallProblem("thrown_down", at(2.0, -speed), at(2.0, speed), 1.0, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v[0] * x.v[0] + 0.01 * log(x.q[0] - 1.0);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }
};

Trajectory solved(const Problem& problem) {
  const auto program = tests::transcribe(problem, {"dmoc", 1}, Grid::uniform(16));
  const Solution solution = make_solver("ipopt")->solve(*program, sample(*program, guessed_motion(problem)));
  EXPECT_TRUE(is_solved(solution.status)) << solution.message;
  return read_trajectory(*program, solution.primal, solution.multipliers);
}

TEST(UndefinedPoint, IsFoundWhereASolverHasSteppedOverASingularity) {
  const ThrownDown problem(8.0);  // q = 2 - 8t + 8t² has its least value 0
  const auto found = tests::value_of(undefined_point(problem, solved(problem)));
  EXPECT_EQ(found.quantity, "lagrangian");
  EXPECT_EQ(found.interval, 2) << "1 - 8t + 8t² vanishes at t = 0.146";
  EXPECT_NEAR(found.time, 0.146, 0.01);
  EXPECT_NE(found.words().find("lagrangian is not a number in interval 2"), std::string::npos) << found.words();
}

TEST(UndefinedPoint, IsNotFoundWhereAllFormulasAreNumbers) {
  const ThrownDown problem(1.0);
  EXPECT_FALSE(undefined_point(problem, solved(problem)));
}

/// The Lagrangian is not a number along the guess, its derivatives are; C has an infinite slope where u = 0.
class Undefined final : public tests::SmallProblem {
 public:
  explicit Undefined(bool in_cost) : SmallProblem("undefined", at(0.0, 0.0), at(0.5, 0.0), 1.0, 1), in_cost_(in_cost) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v[0] * x.v[0] + (in_cost_ ? Expression(0.0) : log(x.q[0] - 1.0));
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return in_cost_ ? sqrt(x.u[0] * x.u[0]) : x.u[0] * x.u[0];
  }

 private:
  bool in_cost_;
};

TEST(UndefinedPoint, OfTheGuessIsRefusedByName) {
  const auto transcribed = [](bool in_cost) {
    static_cast<void>(tests::transcribe(Undefined(in_cost), {"dmoc", 1}, Grid::uniform(8)));
  };
  tests::expect_error_naming({"at its guess in interval 0", "lagrangian is not a number"}, [&] { transcribed(false); });
  tests::expect_error_naming({"at its guess in interval 0", "a derivative of running_cost is not a number"},
                             [&] { transcribed(true); });
}

}  // namespace
}  // namespace dmocbench
