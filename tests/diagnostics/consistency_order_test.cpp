#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/diagnostics/exact_discrete_lagrangian.hpp"
#include "tests/support/problems_for_tests.hpp"

namespace dmocbench {
namespace {

/// A slope within this distance of an order is nearer to it than to the orders above and below: the test fails if a
/// formula gains or loses a power of h.
constexpr double slope_tolerance = 0.25;

double slope_of(const std::vector<std::vector<ConsistencyErrors>>& errors, const std::vector<double>& steps,
                std::size_t tableau, double ConsistencyErrors::*quantity) {
  std::vector<GridError> points;
  points.reserve(steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) points.push_back({steps[k], errors[k][tableau].*quantity});
  return fit_order(points).value_or(FittedOrder{}).order;
}

TEST(ConsistencyOrder, LegendreTransformsAndForcesAreOnePowerOfTheStepBelowLagrangianAndMap) {
  const tests::MovingFrame problem;
  const auto control = [](const Expression& t) {
    ExpressionVector u(2);
    u << 0.5 + sin(2.0 * t), cos(3.0 * t);
    return u;
  };
  const std::vector<Tableau> tableaus{gauss_tableau(1), gauss_tableau(2)};
  const ConsistencyOrder order(problem, control, {problem.initial_state(), problem.final_state()});
  const std::vector<double> steps{0.02, 0.014, 0.01, 0.007};
  std::vector<std::vector<ConsistencyErrors>> errors;
  errors.reserve(steps.size());
  for (const double h : steps) errors.push_back(order.errors(tableaus, h));
  for (std::size_t i = 0; i < tableaus.size(); ++i) {
    const auto r = static_cast<double>(tableaus[i].order);
    const auto slope = [&](double ConsistencyErrors::*quantity) { return slope_of(errors, steps, i, quantity); };
    EXPECT_NEAR(slope(&ConsistencyErrors::lagrangian), r + 1.0, slope_tolerance);
    EXPECT_NEAR(slope(&ConsistencyErrors::map), r + 1.0, slope_tolerance);
    EXPECT_NEAR(slope(&ConsistencyErrors::left_force), r, slope_tolerance);
    EXPECT_NEAR(slope(&ConsistencyErrors::right_force), r, slope_tolerance);
    EXPECT_NEAR(slope(&ConsistencyErrors::left_legendre), r, slope_tolerance);
    EXPECT_NEAR(slope(&ConsistencyErrors::right_legendre), r, slope_tolerance);
  }
}

TEST(ConsistencyOrder, OfTheMidpointRuleOnAFreeParticleIsWhatItIsByHand) {
  // L = v²/2, f = u = u_0 + u' t: the exact integrals are polynomials.
  const tests::DoubleIntegrator particle;
  constexpr double u_0 = 0.8;
  constexpr double rate = 1.7;
  constexpr double h = 0.1;
  const auto control = [](const Expression& t) {
    return ExpressionVector(ExpressionVector::Constant(1, u_0 + rate * t));
  };
  const ConsistencyErrors errors =
      ConsistencyOrder(particle, control, {particle.initial_state()}).errors({gauss_tableau(1)}, h).front();
  EXPECT_NEAR(errors.left_force, rate * h * h / 12.0, 1e-16);
  EXPECT_NEAR(errors.right_force, rate * h * h / 12.0, 1e-16);
  EXPECT_NEAR(errors.left_legendre, rate * h * h / 12.0, 1e-16);
  EXPECT_NEAR(errors.right_legendre, rate * h * h / 12.0, 1e-16);
  EXPECT_NEAR(errors.map, rate * h * h * h / 12.0, 1e-16);
  // ½ ∫ (q̇ - (q_1 - q_0)/h)² dt
  const double about_mean =
      u_0 * u_0 * h * h * h / 12.0 + u_0 * rate * h * h * h * h / 12.0 + rate * rate * h * h * h * h * h / 45.0;
  EXPECT_NEAR(errors.lagrangian, 0.5 * about_mean, 1e-16);
}

}  // namespace
}  // namespace dmocbench
