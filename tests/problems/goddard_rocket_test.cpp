// The optimum against the three arcs that the maximum principle leaves: full thrust, the singular arc, coasting.
#include "problems/goddard_rocket.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "methods/numerics/adaptive_integration.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

constexpr double rocket_exhaust = 0.5;

/// Height, velocity, mass.
using RocketState = std::vector<double>;

double rocket_drag(const RocketState& x) { return 310.0 * x[1] * x[1] * std::exp(-500.0 * (x[0] - 1.0)); }

/// 0 on the singular arc: D (1 + v/c) - m/h².
double distance_from_arc(const RocketState& x) {
  return rocket_drag(x) * (1.0 + x[1] / rocket_exhaust) - x[2] / (x[0] * x[0]);
}

RocketState rate_with(const RocketState& x, double thrust) {
  return {x[1], (thrust - rocket_drag(x)) / x[2] - 1.0 / (x[0] * x[0]), -thrust / rocket_exhaust};
}

/// The thrust that stays on the singular arc: the rate of the distance is linear in it.
double singular_thrust(const RocketState& x) {
  const auto rate_of_distance = [&](double thrust) {
    constexpr double c = rocket_exhaust;
    const RocketState rate = rate_with(x, thrust);
    const double d = rocket_drag(x);
    return d * (1.0 + x[1] / c) * -500.0 * rate[0] + (2.0 * d / x[1] * (1.0 + x[1] / c) + d / c) * rate[1] -
           rate[2] / (x[0] * x[0]) + 2.0 * x[2] / std::pow(x[0], 3) * rate[0];
  };
  const double without = rate_of_distance(0.0);
  return -without / (rate_of_distance(1.0) - without);
}

/// The state where `sign` changes, by bisection for the duration.
RocketState at_the_end_of(RocketState x, const std::function<double(const RocketState&)>& thrust,
                          const std::function<double(const RocketState&)>& sign) {
  const auto after = [&](double duration) {
    RocketState end = x;
    const Rate<double> rate = [&](const RocketState& at, RocketState& result, double) {
      result = rate_with(at, thrust(at));
    };
    EXPECT_TRUE(integrate<double>(rate, end, 0.0, duration, 1e-3, 1e-14));
    return end;
  };
  const bool is_above = sign(x) > 0.0;
  double low = 0.0;
  double high = 0.15;
  while (high - low > 1e-15) {
    const double middle = 0.5 * (low + high);
    ((sign(after(middle)) > 0.0) == is_above ? low : high) = middle;
  }
  return after(high);
}

double largest_altitude() {
  const RocketState on_arc = at_the_end_of(
      {1.0, 0.0, 1.0}, [](const RocketState&) { return 3.5; }, distance_from_arc);
  const RocketState empty = at_the_end_of(on_arc, singular_thrust, [](const RocketState& x) { return x[2] - 0.6; });
  EXPECT_GT(singular_thrust(on_arc), 0.0);
  EXPECT_LT(singular_thrust(empty), 3.5);
  return at_the_end_of(
      empty, [](const RocketState&) { return 0.0; }, [](const RocketState& x) { return x[1]; })[0];
}

TEST(GoddardRocket, ReferenceIsThatOfTheThreeArcs) {
  EXPECT_NEAR(tests::value_of(GoddardRocket().card().reference).objective, -largest_altitude(), 2e-13);
}

class GoddardRocketBy : public testing::TestWithParam<std::string> {};

TEST_P(GoddardRocketBy, RisesAsHigh) {
  const GoddardRocket problem;
  const auto program = tests::transcribe(problem, {GetParam(), 1}, Grid::uniform(256));
  // Not asked for a confirmed control: on the singular arc it hardly changes the cost.
  const Solution solution = make_solver("interior_point")->solve(*program, sample(*program, guessed_motion(problem)));
  EXPECT_LT(solution.kkt_residual, 1e-8);
  const Trajectory motion = read_trajectory(*program, solution.primal, solution.multipliers);
  EXPECT_NEAR(motion.cost, -largest_altitude(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All, GoddardRocketBy, testing::Values("dmoc", "hamiltonian", "tangent"),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace dmocbench
