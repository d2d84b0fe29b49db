#include "problems/particle_steering.hpp"

#include <boost/numeric/odeint.hpp>
#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

TEST(ParticleSteering, AcceleratesAlongItsDirection) {
  const ParticleSteering problem;
  EquationsOfMotion motion{TracedProblem(problem)};
  const Eigen::VectorXd a =
      motion.acceleration(Eigen::Vector2d(1.0, 2.0), Eigen::Vector2d(3.0, 4.0), Eigen::VectorXd::Constant(1, 0.3), 0.0);
  EXPECT_NEAR(a[0], 100.0 * std::cos(0.3), 1e-13);
  EXPECT_NEAR(a[1], 100.0 * std::sin(0.3), 1e-13);
}

TEST(ParticleSteering, MeetsItsEndByTheBilinearTangentLaw) {
  ParticleSteering problem;
  for (const double height : {2.0, 5.0, 8.0}) {
    problem.set_parameter("height", height);
    const double horizon = tests::value_of(problem.card().reference).objective;
    const double c = problem.initial_tangent();
    using State = std::array<double, 3>;  // y, ẋ, ẏ
    State state{0.0, 0.0, 0.0};
    boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper;
    constexpr int steps = 100;
    boost::numeric::odeint::integrate_n_steps(
        boost::ref(stepper),  // its copy would read scratch memory that nothing has written
        [&](const State& x, State& rate, double t) {
          const double u = std::atan(c * (1.0 - 2.0 * t / horizon));
          rate = {x[2], 100.0 * std::cos(u), 100.0 * std::sin(u)};
        },
        state, 0.0, horizon / steps, steps);
    EXPECT_NEAR(state[0], height, 1e-12 * height);
    EXPECT_NEAR(state[1], 45.0, 1e-12 * 45.0);
    EXPECT_NEAR(state[2], 0.0, 1e-11);
  }
}

TEST(ParticleSteering, TakesTheTimeThatIsPublishedToTheirDigits) {
  const auto optimum = ParticleSteering().card().reference;
  EXPECT_NEAR(optimum->objective, 0.554570878334603, 1e-14);
  for (const PublishedOptimum& published : optimum->published) {
    EXPECT_NEAR(published.objective, optimum->objective, 1e-5) << published.source;
  }
}

TEST(ParticleSteering, LeavesTheWayOpenAndTheTimeFree) {
  const ParticleSteering problem;
  EXPECT_FALSE(problem.bounds().last.q.is_bounded(0));
  EXPECT_TRUE(problem.bounds().last.q.is_fixed(1));
  EXPECT_TRUE(problem.bounds().last.v.all_fixed());
  EXPECT_TRUE(problem.bounds().horizon.is_free());
  // The bound on the direction is not what decides: u(0) = 0.953.
  EXPECT_LT(std::atan(problem.initial_tangent()), problem.bounds().u.upper[0]);
  EXPECT_NEAR(std::atan(problem.initial_tangent()), 0.953409756443994, 1e-12);
}

}  // namespace
}  // namespace dmocbench
