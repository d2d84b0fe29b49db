// Every problem's stated optimum against a solve.
#include <cmath>
#include <map>
#include <ostream>
#include <string>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "methods/transcription/motions/interpolation.hpp"
#include "problems/registry.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

/// A smooth problem whose optimum a small grid knows, found from its own guess.
struct Instance {
  std::string problem;
  Eigen::Index intervals = 32;
  std::map<std::string, double> settings;
};

/// Test names would show addresses without it.
std::ostream& operator<<(std::ostream& stream, const Instance& instance) { return stream << instance.problem; }

class StatedReference : public testing::TestWithParam<Instance> {};

TEST_P(StatedReference, IsWhatGaussWithThreeStagesFinds) {
  const auto problem = make_problem(GetParam().problem);
  for (const auto& [name, value] : GetParam().settings) problem->set_parameter(name, value);
  const auto reference = tests::value_of(problem->card().reference);
  const double cost = tests::solve(*problem, {"dmoc", 3}, Grid::uniform(GetParam().intervals), guessed_motion(*problem))
                          .trajectory.cost;
  constexpr double coarsest = 1e-7;
  const double tolerance = std::max(coarsest, std::pow(10.0, -reference.digits)) * std::abs(reference.objective);
  EXPECT_NEAR(cost, reference.objective, tolerance);
}

INSTANTIATE_TEST_SUITE_P(Smooth, StatedReference,
                         testing::Values(Instance{"double_integrator", 4, {}},
                                         Instance{"double_integrator", 4, {{"distance", 2.0}, {"horizon", 3.0}}},
                                         Instance{"particle_steering", 32, {}}, Instance{"brachistochrone", 16, {}},
                                         Instance{"cart_pole", 64, {}}, Instance{"planar_quadrotor", 48, {}},
                                         Instance{"planar_quadrotor_flip", 64, {}},
                                         Instance{"orbital_transfer", 32, {}},
                                         Instance{"orbital_transfer", 128, {{"revolutions", 10.0}}},
                                         Instance{"link_chain", 96, {}}, Instance{"link_chain", 64, {{"links", 2.0}}},
                                         Instance{"spherical_pendulum", 24, {}}, Instance{"hovercraft", 32, {}},
                                         Instance{"double_oscillator", 32, {}}, Instance{"rigid_quadrotor", 32, {}},
                                         Instance{"cannonball", 128, {}}, Instance{"hanging_chain", 128, {}},
                                         Instance{"waypoints", 6, {}}, Instance{"orbital_transfer_with_mass", 32, {}}),
                         [](const auto& instance) {
                           return instance.param.problem + (instance.param.settings.empty() ? "" : "_as_set");
                         });

// From the guess each method and grid finds another minimum.
TEST(References, OfTheArmWithMotorsIsTheMinimumNextToTheOptimumOfTheArm) {
  const auto arm = make_problem("two_link_manipulator");
  const tests::Solved solved = tests::solve(*arm, {"dmoc", 1}, Grid::uniform(64), guessed_motion(*arm));
  const Motion of_arm = smooth_motion(solved.trajectory);
  const auto with_currents = [&](double t) {
    MotionPoint point = of_arm.at(t);
    point.y = Eigen::Vector2d(point.u[0] + point.u[1], point.u[1]);  // torques are differences of currents
    point.u = point.y + Eigen::Vector2d(point.v[0], point.v[1] - point.v[0]);
    return point;
  };
  const auto problem = make_problem("two_link_with_motors");
  const auto reference = tests::value_of(problem->card().reference);
  for (const char* method : {"dmoc", "tangent"}) {
    const tests::Solved found =
        tests::solve(*problem, {method, 3}, Grid::uniform(128), {.at = with_currents, .horizon = of_arm.horizon});
    EXPECT_NEAR(found.trajectory.cost, reference.objective, 1e-7 * reference.objective) << method;
  }
}

TEST(References, SayHowTheyAreKnown) {
  for (const std::string& name : problem_names()) {
    const auto reference = make_problem(name)->card().reference;
    if (!reference) continue;
    EXPECT_TRUE(std::isfinite(reference->objective)) << name;
    EXPECT_GE(reference->digits, 1) << name;
    EXPECT_LE(reference->digits, 16) << name;
    EXPECT_FALSE(reference->certificate.empty()) << name;
    for (const PublishedOptimum& published : reference->published) {
      EXPECT_FALSE(published.source.empty()) << name;
      // Whoever differs in the first three digits is owed an explanation.
      const double difference = std::abs(published.objective / reference->objective - 1.0);
      EXPECT_TRUE(difference <= 1e-3 || !reference->remark.empty()) << name;
    }
  }
}

}  // namespace
}  // namespace dmocbench
