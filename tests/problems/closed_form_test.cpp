// Optimal motions in closed form: they solve the maximum principle, have the stated cost, and are what a solve finds.
#include <algorithm>
#include <map>
#include <memory>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "problems/registry.hpp"
#include "tests/support/problem_values.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

/// A problem with one coordinate, a unit mass and f = u; `factor` is C/u².
struct KnownOptimum {
  std::string label;
  std::string problem;
  std::map<std::string, double> settings;
  double factor;
};

std::ostream& operator<<(std::ostream& stream, const KnownOptimum& known) { return stream << known.label; }

class ClosedFormTest : public testing::TestWithParam<KnownOptimum> {
 protected:
  ClosedFormTest() {
    for (const auto& [name, value] : GetParam().settings) problem_->set_parameter(name, value);
  }
  [[nodiscard]] OptimalPoint at(double t) const { return tests::value_of(problem_->optimum(t)); }
  [[nodiscard]] const Problem& problem() const { return *problem_; }

 private:
  std::unique_ptr<Problem> problem_ = make_problem(GetParam().problem);
};

/// Fractions of the horizon that avoid every kink of these motions.
constexpr std::array fractions{0.03, 0.11, 0.26, 0.37, 0.44, 0.55, 0.68, 0.81, 0.97};

TEST_P(ClosedFormTest, SolvesTheEquationsOfMotionAndOfTheCostate) {
  const double horizon = problem().horizon();
  const double e = 1e-6 * horizon;
  for (const double fraction : fractions) {
    const double t = fraction * horizon;
    const OptimalPoint here = at(t);
    const OptimalPoint before = at(t - e);
    const OptimalPoint after = at(t + e);
    EXPECT_NEAR((after.motion.q - before.motion.q)[0] / (2.0 * e), here.motion.v[0], 1e-7);
    EXPECT_NEAR((after.motion.v - before.motion.v)[0] / (2.0 * e), here.motion.u[0], 1e-7);
    EXPECT_NEAR((after.psi_p - before.psi_p)[0] / (2.0 * e), -here.psi_q[0], 1e-6);
  }
}

TEST_P(ClosedFormTest, ChoosesTheControlThatMinimisesTheHamiltonian) {
  const Bounds bounds = problem().bounds().u;
  const double limit = bounds.empty() ? 1e300 : bounds.upper[0];
  for (const double fraction : fractions) {
    const OptimalPoint here = at(fraction * problem().horizon());
    const double free = -here.psi_p[0] / (2.0 * GetParam().factor);
    EXPECT_NEAR(here.motion.u[0], std::clamp(free, -limit, limit), 1e-13);
  }
}

TEST_P(ClosedFormTest, MeetsBothEndsAndEveryBound) {
  const Bounds bounds = problem().bounds().q;
  for (const auto& [t, end] :
       {std::pair(0.0, problem().initial_state()), {problem().horizon(), problem().final_state()}}) {
    EXPECT_NEAR(at(t).motion.q[0], end.q[0], 1e-14);
    EXPECT_NEAR(at(t).motion.v[0], end.v[0], 1e-14);
  }
  for (int i = 0; i <= 1000 && !bounds.empty(); ++i) {
    EXPECT_LE(at(problem().horizon() * i / 1000.0).motion.q[0], bounds.upper[0] + 1e-15);
  }
}

TEST_P(ClosedFormTest, HasTheStatedCostByQuadratureAndByASolve) {
  constexpr int points = 40000;
  double cost = 0.0;
  for (int i = 0; i < points; ++i) {
    const double u = at(problem().horizon() * (i + 0.5) / points).motion.u[0];
    cost += GetParam().factor * u * u * problem().horizon() / points;
  }
  const double stated = tests::value_of(problem().card().reference).objective;
  EXPECT_NEAR(cost, stated, 1e-7 * stated);
  const double solved =
      tests::solve(problem(), {"dmoc", 1}, Grid::uniform(128), guessed_motion(problem())).trajectory.cost;
  EXPECT_NEAR(solved, stated, 1e-3 * stated);
}

INSTANTIATE_TEST_SUITE_P(Problems, ClosedFormTest,
                         testing::Values(KnownOptimum{"free_force", "double_integrator", {}, 0.5},
                                         KnownOptimum{
                                             "bounded_force", "double_integrator", {{"largest_force", 5.0}}, 0.5},
                                         KnownOptimum{"bounded_force_of_other_size",
                                                      "double_integrator",
                                                      {{"largest_force", 1.5}, {"distance", 2.5}, {"horizon", 3.0}},
                                                      0.5},
                                         KnownOptimum{"beam_on_its_bound", "beam", {}, 1.0},
                                         KnownOptimum{"beam_that_touches", "beam", {{"bound", 0.2}}, 1.0},
                                         KnownOptimum{"free_beam", "beam", {{"bound", 0.3}}, 1.0}),
                         [](const auto& instance) { return instance.param.label; });

TEST(ClosedForms, KnowThatTooSmallAForceLeavesNoMotion) {
  const auto problem = make_problem("double_integrator");
  problem->set_parameter("largest_force", 3.9);
  EXPECT_FALSE(problem->optimum(0.5).has_value());
  EXPECT_FALSE(problem->card().reference.has_value());
}

TEST(ClosedForms, GiveTheBeamThePublishedCostOfHalfTheSquare) {
  // Bryson and Ho state 4/(9 l) for the cost with the factor 1/2.
  const auto problem = make_problem("beam");
  EXPECT_NEAR(tests::value_of(problem->card().reference).objective, 80.0 / 9.0, 1e-14);
  problem->set_parameter("bound", 1.0 / 9.0);
  EXPECT_NEAR(0.5 * tests::value_of(problem->card().reference).objective, 4.0, 1e-14);
}

}  // namespace
}  // namespace dmocbench
