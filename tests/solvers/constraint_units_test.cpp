// Constraints times any number: what is solved is the same, or the answer says that it is not.
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "methods/solvers/solver.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Restated;

Solution solve(const Problem& problem, const std::string& method, const std::string& solver, int stages = 1) {
  const auto program = tests::transcribe(problem, {method, stages}, Grid::uniform(12));
  SolverOptions options;
  options.most_iterations = 200;
  return make_solver(solver, options)->solve(*program, sample(*program, guessed_motion(problem)));
}

class ConstraintsTimes : public testing::TestWithParam<std::tuple<const char*, const char*>> {
 protected:
  static constexpr int smallest = -100;
  static constexpr int largest = 30;
  tests::DoubleIntegrator base_;
};

INSTANTIATE_TEST_SUITE_P(All, ConstraintsTimes,
                         testing::Combine(testing::Values("dmoc", "hamiltonian", "tangent"),
                                          testing::Values("auto", "interior_point", "ipopt", "sqp")),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param)) + "_" + std::get<1>(test.param);
                         });

/// 0 to 1 from rest to rest takes |u| = 4 at least.
TEST_P(ConstraintsTimes, APowerOfTenAreNotSolvedWhereTheyAreInfeasible) {
  const auto& [method, solver] = GetParam();
  for (int k = smallest; k <= largest; k += 5) {
    const double factor = std::pow(10.0, k);
    const Restated limited(base_, [factor](Restated::Statement& s) {
      s.path_constraints = [factor](const ControlledState& x) {
        return ExpressionVector::Constant(1, factor * (1.0 - x.u[0]));
      };
    });
    const Solution solution = solve(limited, method, solver);
    EXPECT_FALSE(is_solved(solution.status)) << k << ": cost " << solution.objective << " " << solution.message;
  }
}

/// Without the limit |u| reaches 6, which 4.5 allows at the price of a higher cost.
TEST_P(ConstraintsTimes, APowerOfTenReachTheirBoundOrAreNotSolved) {
  const auto& [method, solver] = GetParam();
  const auto limited = [this](double factor) {
    return Restated(base_, [factor](Restated::Statement& s) {
      s.path_constraints = [factor](const ControlledState& x) {
        return ExpressionVector::Constant(1, factor * (4.5 - x.u[0]));
      };
    });
  };
  const double optimum = solve(limited(1.0), method, "ipopt").objective;
  const double without = solve(base_, method, "ipopt").objective;
  EXPECT_GT(optimum, 1.01 * without);
  for (int k = smallest; k <= largest; k += 3) {
    const Solution solution = solve(limited(std::pow(10.0, k)), method, solver);
    if (!is_solved(solution.status)) continue;
    EXPECT_NEAR(solution.objective, optimum, 1e-5 * optimum) << k << ": " << solution.message;
  }
  if (solver == std::string_view("sqp")) return;  // its quadratic programs lose rows of some sizes, and it fails
  for (const double factor : {1e-13, 1e-11, 1e-9, 1e-6, 1e3}) {
    const Solution solution = solve(limited(factor), method, solver);
    EXPECT_TRUE(is_solved(solution.status)) << factor << ": " << solution.message;
  }
}

TEST_P(ConstraintsTimes, APowerOfTenAreSolvedOnlyAtTheSameCost) {
  const auto& [method, solver] = GetParam();
  const auto with_mean = [this](double factor) {
    return Restated(base_, [factor](Restated::Statement& s) {
      s.integrals = Bounds::all(1, 0.6 * factor, 0.6 * factor);
      s.integrands = [factor](const ControlledState& x) { return ExpressionVector::Constant(1, factor * x.q[0]); };
    });
  };
  const double optimum = solve(with_mean(1.0), method, "ipopt").objective;
  for (int k = smallest; k <= largest; k += 5) {
    const Solution solution = solve(with_mean(std::pow(10.0, k)), method, solver);
    if (!is_solved(solution.status)) continue;
    EXPECT_NEAR(solution.objective, optimum, 1e-6 * optimum) << k << ": " << solution.message;
  }
  EXPECT_TRUE(is_solved(solve(with_mean(1e3), method, solver).status));
}

/// The mean of q is between 0 and 1, the mean of q̇ is 1 and that of q̇² at least 1, whatever the control.
TEST_P(ConstraintsTimes, AnyNumberAreNotSolvedWhereAnIntegralCannotBeReached) {
  const auto& [method, solver] = GetParam();
  struct Integral {
    std::function<Expression(const ControlledState&)> of;
    double lower = 0.0;
    double upper = 0.0;
  };
  const std::vector<Integral> unreachable{{[](const ControlledState& x) { return x.v[0]; }, 2.0, 2.0},
                                          {[](const ControlledState& x) { return x.v[0]; }, 0.0, 0.0},
                                          {[](const ControlledState& x) { return x.v[0]; }, 2.0, unbounded},
                                          {[](const ControlledState& x) { return x.v[0] * x.v[0]; }, -unbounded, 0.5},
                                          {[](const ControlledState& x) { return x.q[0] * x.q[0]; }, -1.0, -1.0},
                                          {[](const ControlledState& x) { return x.u[0]; }, 1.0, unbounded}};
  for (const Integral& integral : unreachable) {
    for (int k = -36; k <= -6; k += 3) {  // whole and half powers of ten
      const double factor = std::pow(10.0, 0.5 * k);
      const Restated limited(base_, [&](Restated::Statement& s) {
        s.integrals = Bounds::all(1, integral.lower * factor, integral.upper * factor);
        s.integrands = [&](const ControlledState& x) { return ExpressionVector::Constant(1, factor * integral.of(x)); };
      });
      const Solution solution = solve(limited, method, solver);
      EXPECT_FALSE(is_solved(solution.status))
          << factor << ": " << integral.lower << " to " << integral.upper << ", cost " << solution.objective;
    }
  }
}

/// ẏ = factor u_2 from 0 to `reached` times the factor with |u_2| <= 1, next to a double integrator.
class ReachedByARate final : public tests::SmallProblem {
 public:
  ReachedByARate(double factor, double reached)
      : SmallProblem("reached", at(0.0, 0.0, 0.0), at(1.0, 0.0, factor * reached), 1.0, 2), factor_(factor) {}
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"y"}; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    return one(factor_ * x.u[1]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return one(x.u[0]); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.u = {.lower = Eigen::Vector2d(-100.0, -1.0), .upper = Eigen::Vector2d(100.0, 1.0)};
    return bounds;
  }

 private:
  double factor_;
};

TEST_P(ConstraintsTimes, AnyNumberAreNotSolvedWhereAFirstOrderStateCannotBeReached) {
  const auto& [method, solver] = GetParam();
  for (const int stages : {1, 2}) {
    for (int k = -30; k <= 3; k += 3) {
      const ReachedByARate problem(std::pow(10.0, k), 1.5);
      const Solution solution = solve(problem, method, solver, stages);
      EXPECT_FALSE(is_solved(solution.status)) << k << ", " << stages << " stages: " << solution.objective;
    }
    const Solution solution = solve(ReachedByARate(1.0, 0.5), method, solver, stages);
    EXPECT_TRUE(is_solved(solution.status)) << solution.message;
    EXPECT_NEAR(solution.objective, 6.125, 0.1);
  }
}

}  // namespace
}  // namespace dmocbench
