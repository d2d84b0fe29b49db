#include "problems/brachistochrone.hpp"

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

TEST(Brachistochrone, IsDrivenByAReactionThatDoesNoWork) {
  const Brachistochrone problem;
  tests::RandomPoints random;
  for (int trial = 0; trial < 10; ++trial) {
    const MotionPoint at{random.vector(2), random.vector(2, -5.0, 5.0), random.vector(1, -9.0, 9.0)};
    EXPECT_NEAR(tests::force_at(problem, at).dot(at.v), 0.0, 1e-13);
  }
}

TEST(Brachistochrone, HasTheCycloidAsItsMotionUnderAConstantControl) {
  const Brachistochrone problem;
  const auto [radius, angle] = problem.cycloid();
  const double rate = std::sqrt(problem.parameter("gravity") / radius);
  EquationsOfMotion motion{TracedProblem(problem)};
  for (const double fraction : {0.1, 0.4, 0.9}) {
    const double phi = fraction * angle;
    const double sine = std::sin(phi);
    const double cosine = std::cos(phi);
    const Eigen::Vector2d q(radius * (phi - sine), 10.0 - radius * (1.0 - cosine));
    const Eigen::Vector2d v = radius * rate * Eigen::Vector2d(1.0 - cosine, -sine);
    const Eigen::Vector2d acceleration = radius * rate * rate * Eigen::Vector2d(sine, -cosine);
    EXPECT_LT((motion.acceleration(q, v, Eigen::VectorXd::Constant(1, rate), 0.0) - acceleration).norm(), 1e-12);
  }
  // It ends where it must.
  const Eigen::Vector2d end(radius * (angle - std::sin(angle)), 10.0 - radius * (1.0 - std::cos(angle)));
  EXPECT_LT((end - problem.final_state().q).norm(), 1e-13);
}

TEST(Brachistochrone, TakesTheTimesThatArePublished) {
  Brachistochrone problem;
  EXPECT_NEAR(tests::value_of(problem.card().reference).objective, 1.80160312245308, 1e-14);
  EXPECT_NEAR(tests::value_of(problem.card().reference).published.at(0).objective,
              tests::value_of(problem.card().reference).objective, 5e-5);
  problem.set_parameter("width", 2.0);
  problem.set_parameter("drop", 2.0);
  problem.set_parameter("gravity", 9.8);
  EXPECT_NEAR(tests::value_of(problem.card().reference).objective, 0.824759143156625, 1e-15);
  EXPECT_NEAR(tests::value_of(problem.card().reference).published.at(0).objective,
              tests::value_of(problem.card().reference).objective, 5e-8);
}

TEST(Brachistochrone, IsFasterThanTheStraightWireOfItsGuess) {
  const Brachistochrone problem;
  EXPECT_LT(tests::value_of(problem.card().reference).objective, problem.horizon());
  // The guess keeps the energy: it is a motion on a wire.
  const MotionPoint end = problem.guess(problem.horizon());
  EXPECT_NEAR(0.5 * end.v.squaredNorm(), problem.parameter("gravity") * problem.parameter("drop"), 1e-12);
}

}  // namespace
}  // namespace dmocbench
