#include <gtest/gtest.h>

#include "bench/experiments/kkt_eigenvalues.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

double curvature_of(const Problem& problem, const tests::Scheme& scheme, Eigen::Index intervals,
                    EndVariation end = EndVariation::stated) {
  tests::Solved solved = tests::solve(problem, scheme, Grid::uniform(intervals), guessed_motion(problem));
  return tests::value_of(smallest_curvature(*solved.transcription, solved.solution, end));
}

TEST(SmallestCurvature, OfHalfTheSquareOfTheControlIsOneOnEveryGridByEveryMethod) {
  // Linear equations and C = ½u²: the form is ∫δu² itself, whatever the null space.
  for (const tests::Scheme& scheme : {tests::Scheme{"dmoc", 1}, {"hamiltonian", 2}, {"tangent", 1}}) {
    for (const Eigen::Index intervals : {8, 64}) {
      EXPECT_NEAR(curvature_of(tests::DoubleIntegrator(), scheme, intervals), 1.0, 1e-5) << scheme.label();
    }
  }
}

TEST(SmallestCurvature, CountsTheTrueCostAndNotTheScaledOne) {
  // C = u² has the second derivative 2; the scale of the beam's cost does not change that.
  EXPECT_NEAR(curvature_of(*make_problem("beam"), {"dmoc", 1}, 32), 2.0, 1e-4);
}

/// C = ½u² - ½c q²: an oscillator's ∫δu² - c∫δq² with δq = δq̇ = 0 at both ends and δq̈ = δu.
class Repelled final : public tests::SmallProblem {
 public:
  explicit Repelled(double c) : SmallProblem("repelled", at(0.0, 0.0), at(0.0, 0.0), 1.0, 1), c_(c) {}
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * (x.u[0] * x.u[0] - c_ * x.q[0] * x.q[0]);
  }

 private:
  double c_;
};

TEST(SmallestCurvature, IsThatOfTheClampedBeamInTheLimit) {
  // The least ∫δq̈²/∫δq² of a clamped beam is k⁴ with cos k cosh k = 1, k = 4.730040745: α = 1 - c/k⁴.
  constexpr double k = 4.730040744862704;
  const double c = 0.5 * k * k * k * k;
  const double coarse = curvature_of(Repelled(c), {"dmoc", 1}, 32);
  const double fine = curvature_of(Repelled(c), {"dmoc", 1}, 128);
  EXPECT_NEAR(fine, 0.5, 1e-3);
  EXPECT_LT(std::abs(fine - 0.5), 0.1 * std::abs(coarse - 0.5));
}

TEST(SmallestCurvature, OfVariationsThatMoveTheEndIsThatOfTheClampedAndFreeBeamAndMayBeNegative) {
  // Clamped at one end and free at the other, cos k cosh k = -1, k = 1.875104069: c above k^4 makes the form
  // indefinite.
  constexpr double k = 1.875104068711961;
  for (const double of_limit : {0.5, 3.0}) {
    const double c = of_limit * k * k * k * k;
    for (const char* const method : {"dmoc", "hamiltonian"}) {
      EXPECT_NEAR(curvature_of(Repelled(c), {method, 1}, 128, EndVariation::free), 1.0 - of_limit, 2e-3) << method;
    }
    EXPECT_GT(curvature_of(Repelled(c), {"dmoc", 1}, 128), 0.0) << "the stated end is clamped";
  }
}

}  // namespace
}  // namespace dmocbench
