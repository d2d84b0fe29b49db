#include "problems/hanging_chain.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

/// y = a cosh((x - b)/a) + c from (0, 1) to (1, 3), of a given length.
struct Catenary {
  explicit Catenary(double length) {
    const double rise = 2.0;
    double low = 0.05;
    double high = 5.0;
    for (int i = 0; i < 200; ++i) {  // length² - rise² = (2a sinh(1/(2a)))²
      a = 0.5 * (low + high);
      (2.0 * a * std::sinh(0.5 / a) > std::sqrt(length * length - rise * rise) ? low : high) = a;
    }
    b = 0.5 - a * std::atanh(rise / length);
    c = 1.0 - a * std::cosh(b / a);
  }
  [[nodiscard]] double height(double x) const { return a * std::cosh((x - b) / a) + c; }
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;
};

class HangingChainBy : public testing::TestWithParam<std::string> {};

TEST_P(HangingChainBy, IsACatenaryAndItsLengthHasThePriceOfItsHeight) {
  for (const double length : {4.0, 3.0}) {
    HangingChain problem;
    problem.set_parameter("length", length);
    const Catenary catenary(length);
    const auto solved = [&](Eigen::Index intervals) {
      return tests::solve(problem, {GetParam(), 1}, Grid::uniform(intervals), guessed_motion(problem)).trajectory;
    };
    const Trajectory motion = solved(128);
    EXPECT_NEAR(motion.integrals[0], length, 1e-9);
    for (Eigen::Index k = 0; k <= 128; k += 16) {
      EXPECT_NEAR(motion.q(k, 0), catenary.height(motion.node_times[k]), 2e-3) << k;
    }
    // δ∫(y - λ) ds = 0 with λ = c: the least energy grows by c per unit of the length.
    const double coarse = motion.integral_prices[0] - catenary.c;
    const double fine = solved(256).integral_prices[0] - catenary.c;
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(All, HangingChainBy, testing::Values("dmoc", "hamiltonian", "tangent"),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace dmocbench
