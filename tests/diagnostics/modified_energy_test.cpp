#include "methods/diagnostics/modified_energy.hpp"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/diagnostics/one_step_map.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

constexpr std::array modified_orders{2, 4, 6};

LongVector entry_of(long double entry) { return LongVector::Constant(1, entry); }

/// The largest deviation of the truncated modified energies from what the modified work explains, over a motion by the
/// midpoint rule until `end`, with controls that jump from step to step.
std::array<double, 3> deviations(const Problem& problem, const BoundaryState& start, const std::string& method,
                                 long double end, int steps, double amplitude) {
  const TracedProblem traced(problem);
  const ModifiedEnergy modified(problem);
  const OneStepMap<long double> map(traced, *make_element(method), gauss_tableau(1));
  LongVector q = start.q.cast<long double>();
  LongVector v = start.v.cast<long double>();
  LongVector p = LegendreTransform(traced).momentum(start.q, start.v, 0.0).cast<long double>();
  const long double h = end / steps;
  const StepSeries first = partial_sums(modified.energy(q, v), h);
  StepSeries work{};
  std::array<double, 3> largest{};
  for (int k = 0; k < steps; ++k) {
    const LongMatrix controls = LongMatrix::NullaryExpr(1, problem.control_size(), [=](Eigen::Index, Eigen::Index j) {
      return amplitude * std::sin(5.0L * static_cast<long double>(k) + static_cast<long double>(j));
    });
    const auto step = map.advance(q, p, v, controls, h, 0.0L);
    const StepSeries power =
        partial_sums(modified.power((q + step.q) / 2.0L, step.mean_velocity, controls.row(0).transpose(), 0.0L), h);
    q = step.q;
    p = step.p;
    v = modified.velocity(q, p, step.mean_velocity);
    const StepSeries energy = partial_sums(modified.energy(q, v), h);
    for (std::size_t i = 0; i < work.size(); ++i) {
      work[i] += h * power[i];
      largest[i] = std::max(largest[i], static_cast<double>(std::abs(energy[i] - first[i] - work[i])));
    }
  }
  return largest;
}

struct FreeMotion {
  std::string name;
  std::shared_ptr<const Problem> problem;
  BoundaryState start;
  double end;
  int steps;
};

/// Constant and moving masses, and a momentum that is not linear in the velocity.
std::vector<FreeMotion> motions() {
  const auto at = [](double q, double v) {
    return BoundaryState{Eigen::VectorXd::Constant(1, q), Eigen::VectorXd::Constant(1, v)};
  };
  return {{"pendulum", std::make_shared<tests::Pendulum>(), at(1.0, 0.5), 6.0, 60},
          {"spring", std::make_shared<tests::RelativisticSpring>(), at(0.5, 0.4), 6.0, 60},
          {"orbit", make_problem("orbital_transfer"), {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.1, 1.1)}, 6.0, 60},
          {"links",
           make_problem("two_link_manipulator"),
           {Eigen::Vector2d(-1.0, 0.5), Eigen::Vector2d(1.0, -0.5)},
           1.0,
           60}};
}

void expect_orders_2_4_6(const FreeMotion& motion, const std::string& method, double amplitude) {
  std::array<std::vector<GridError>, 3> errors;
  for (const int factor : {2, 3, 4, 6}) {
    const int steps = motion.steps * factor;
    const auto largest = deviations(*motion.problem, motion.start, method, motion.end, steps, amplitude);
    for (std::size_t i = 0; i < modified_orders.size(); ++i) errors[i].push_back({motion.end / steps, largest[i]});
  }
  for (std::size_t i = 0; i < modified_orders.size(); ++i) {
    EXPECT_NEAR(tests::value_of(fit_order(errors[i])).order, modified_orders[i], 0.1) << motion.name << ' ' << method;
  }
}

TEST(ModifiedEnergy, OfTheHarmonicOscillatorIsThatOfItsSlowerFrequency) {
  // The midpoint rule turns by 2 atan(hω/2) per step: H̃/H = 2 atan(hω/2)/(hω) = 1 - (hω)²/12 + (hω)⁴/80 - …
  const ModifiedEnergy modified(tests::HarmonicOscillator{});
  const StepSeries terms = modified.energy(entry_of(0.3L), entry_of(-0.7L));
  const long double omega = tests::HarmonicOscillator::omega;
  EXPECT_NEAR(static_cast<double>(terms[1] / terms[0]), static_cast<double>(-omega * omega / 12.0L), 1e-15);
  EXPECT_NEAR(static_cast<double>(terms[2] / terms[0]), static_cast<double>(std::pow(omega, 4) / 80.0L), 1e-15);
}

TEST(ModifiedEnergy, IsConservedToOrders2And4And6WithoutForces) {
  for (const FreeMotion& motion : motions()) expect_orders_2_4_6(motion, "dmoc", 0.0);
  expect_orders_2_4_6(motions()[2], "hamiltonian", 0.0);
}

TEST(ModifiedEnergy, ChangesByTheModifiedWorkOfControlsThatJump) {
  for (const FreeMotion& motion : motions()) expect_orders_2_4_6(motion, "dmoc", 0.2);
}

TEST(ModifiedEnergy, IsNotThatOfTangentSpaceCollocationWithAMovingMass) {
  for (const FreeMotion& motion : {motions()[2], motions()[3]}) {
    const auto coarse = deviations(*motion.problem, motion.start, "tangent", motion.end, 120, 0.0);
    const auto fine = deviations(*motion.problem, motion.start, "tangent", motion.end, 240, 0.0);
    EXPECT_NEAR(std::log2(coarse[1] / fine[1]), 2.0, 0.1) << motion.name;
    EXPECT_NEAR(std::log2(coarse[2] / fine[2]), 2.0, 0.1) << motion.name;
  }
}

TEST(ModifiedEnergy, NeedsNoCorrectionOfTheWorkWhereNoForceActs) {
  const auto problem = make_problem("two_link_manipulator");
  const LongVector q = Eigen::Vector2d(-1.0, 0.5).cast<long double>();
  const LongVector v = Eigen::Vector2d(1.0, -0.5).cast<long double>();
  const StepSeries work = ModifiedEnergy(*problem).power(q, v, LongVector::Zero(2), 0.0L);
  const StepSeries energy = ModifiedEnergy(*problem).energy(q, v);
  EXPECT_EQ(work[0], 0.0L);
  EXPECT_LT(std::abs(work[1]), 1e-15L * std::abs(energy[1]));
  EXPECT_LT(std::abs(work[2]), 1e-14L * std::abs(energy[2]));
}

TEST(ModifiedEnergy, IsRefusedToALagrangianThatDependsOnTime) {
  tests::expect_error_naming({"moving_frame", "time"}, [] { static_cast<void>(ModifiedEnergy(tests::MovingFrame())); });
}

}  // namespace
}  // namespace dmocbench
