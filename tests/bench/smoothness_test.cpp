#include <gtest/gtest.h>

#include "bench/experiments/convergence/situation.hpp"
#include "bench/experiments/smoothness/optimum_error.hpp"
#include "bench/run/restated_problem.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "problems/double_integrator.hpp"
#include "problems/registry.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"
#include "tests/support/wider_problems.hpp"

namespace dmocbench {
namespace {

std::unique_ptr<Problem> bounded_integrator() {
  auto problem = make_problem("double_integrator");
  problem->set_parameter("largest_force", 5.0);
  return problem;
}

/// A solve whose numbers are replaced by those of the closed form.
Trajectory exact_on_eight_intervals(const Problem& problem) {
  Trajectory motion = tests::solve(problem, {"dmoc", 2}, Grid::uniform(8), guessed_motion(problem)).trajectory;
  for (Eigen::Index k = 0; k < motion.q.rows(); ++k) {
    const OptimalPoint point = tests::value_of(problem.optimum(motion.node_times[k]));
    motion.q.row(k) = point.motion.q;
    motion.v.row(k) = motion.p.row(k) = point.motion.v;  // unit mass
    motion.psi_q.row(k) = point.psi_q;
    motion.psi_p.row(k) = point.psi_p;
  }
  for (Eigen::Index i = 0; i < motion.stage_u.rows(); ++i) {
    motion.stage_u.row(i) = tests::value_of(problem.optimum(motion.stage_times[i])).motion.u;
  }
  motion.cost = tests::value_of(problem.card().reference).objective;
  return motion;
}

TEST(OptimumError, VanishesOnTheClosedFormAndFindsWhatIsMoved) {
  const auto problem = bounded_integrator();
  const KnownOptimum optimum(*problem, std::nullopt);
  Trajectory motion = exact_on_eight_intervals(*problem);
  const OptimumError none = optimum.error_of(motion);
  for (const double error :
       {none.state, none.costate_q, none.costate_p, none.node_control, none.control, none.objective}) {
    EXPECT_LT(error, 1e-13);
  }
  motion.q(3, 0) += 0.03;
  motion.p(3, 0) += 0.04;
  motion.psi_p(4, 0) += 0.2;  // on the ramp, where the control follows the costate
  motion.psi_p(0, 0) -= 0.1;  // beyond the bound, where it does not
  motion.stage_u(5, 0) -= 0.7;
  motion.cost += 0.5;
  const OptimumError moved = optimum.error_of(motion);
  EXPECT_NEAR(moved.state, 0.05, 1e-13);
  EXPECT_NEAR(moved.costate_p, 0.2, 1e-13);
  EXPECT_NEAR(moved.node_control, 0.2, 1e-13);
  EXPECT_NEAR(moved.control, 0.7, 1e-13);
  EXPECT_NEAR(moved.objective, 0.5, 1e-13);
}

TEST(OptimumError, NeedsAClosedFormOrAFinerMotion) {
  const auto problem = make_problem("two_link_manipulator");
  tests::expect_error_naming({"two_link_manipulator", "closed form"},
                             [&] { static_cast<void>(KnownOptimum(*problem, std::nullopt)); });
}

TEST(OptimumError, AgainstAFinerMotionIsThatAgainstTheClosedForm) {
  const auto problem = bounded_integrator();
  const Trajectory coarse = tests::solve(*problem, {"dmoc", 1}, Grid::uniform(24), guessed_motion(*problem)).trajectory;
  const Trajectory finer = tests::solve(*problem, {"dmoc", 2}, Grid::uniform(768), guessed_motion(*problem)).trajectory;
  const OptimumError exact = KnownOptimum(*problem, std::nullopt).error_of(coarse);
  const OptimumError measured = KnownOptimum(*problem, finer).error_of(coarse);
  EXPECT_NEAR(measured.state, exact.state, 0.02 * exact.state);
  EXPECT_NEAR(measured.costate_p, exact.costate_p, 0.02 * exact.costate_p);
  EXPECT_NEAR(measured.node_control, exact.node_control, 0.02 * exact.node_control);
}

TEST(RestatedProblem, LeavesTheFinalStateFreeAtThePriceOfItsDistance) {
  const std::shared_ptr<const Problem> base = make_problem("double_integrator");
  const RestatedProblem problem(base, {.final_weight = 2.0});
  // min ½∫u² + (q(1) - 1)² + v(1)²: with u = a - b(1 - t) stationary in a and b, a = -2 v(1), b = 2 (q(1) - 1).
  // v(1) = a - b/2 and q(1) = a/2 - b/3 give 3a = b, b (1 + 2/3) - a = -2: a = -1/2, b = -3/2.
  const Trajectory motion = tests::solve(problem, {"dmoc", 2}, Grid::uniform(4), guessed_motion(problem)).trajectory;
  EXPECT_NEAR(motion.q(4, 0), 0.25, 1e-9);
  EXPECT_NEAR(motion.v(4, 0), 0.25, 1e-9);
}

TEST(RestatedProblem, KeepsTheUnknownsOfTheProblem) {
  const auto base = std::make_shared<const tests::UnknownMass>();
  const BoundaryState wanted{.q = Eigen::VectorXd::Constant(1, 1.5), .v = Eigen::VectorXd::Ones(1)};
  const RestatedProblem problem(base, {.final = wanted});
  // q = t + d (3t² - 2t³) with d = q(1) - 1 and J = 6 m² d² + (m - 3)², hence m = 3/(1 + 6 d²).
  const Trajectory motion = tests::solve(problem, {"dmoc", 2}, Grid::uniform(8), guessed_motion(problem)).trajectory;
  ASSERT_EQ(motion.unknowns.size(), 1);
  EXPECT_NEAR(motion.unknowns[0], 1.2, 1e-8);
  EXPECT_NEAR(motion.p(0, 0), 1.2, 1e-8);
  const ParameterScope found = with_unknowns(problem, motion.unknowns);
  EXPECT_EQ(base->parameter("mass"), motion.unknowns[0]) << "formulas of the base read it";
}

/// Which bounds are active at the optimum that DMOC finds on 40 intervals.
std::string active_at_optimum(const Problem& problem) {
  return active_bounds(problem,
                       tests::solve(problem, {"dmoc", 1}, Grid::uniform(40), guessed_motion(problem)).trajectory);
}

TEST(ActiveBounds, AreThoseThatTheExamplesAreToldToHave) {
  for (const Situation& situation : example_situations()) {
    if (!situation.has_closed_form) continue;
    EXPECT_EQ(active_at_optimum(*situation.problem), situation.active) << situation.name;
  }
}

/// The double integrator with path constraints: a largest force and a largest speed.
class ConstrainedIntegrator : public DoubleIntegrator {
 public:
  explicit ConstrainedIntegrator(double most_force, double most_speed) : force_(most_force), speed_(most_speed) {}
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return ExpressionVector{{force_ - x.u[0], force_ + x.u[0], speed_ - x.v[0]}};
  }

 private:
  double force_;
  double speed_;
};

TEST(ActiveBounds, CountPathConstraintsByWhatTheyRead) {
  EXPECT_EQ(active_at_optimum(ConstrainedIntegrator(5.0, 9.0)), "control");
  EXPECT_EQ(active_at_optimum(ConstrainedIntegrator(9.0, 1.4)), "state");
  EXPECT_EQ(active_at_optimum(ConstrainedIntegrator(5.5, 1.45)), "control and state");
  EXPECT_EQ(active_at_optimum(ConstrainedIntegrator(9.0, 9.0)), "nothing");
}

TEST(SituationOf, TellsEndsAndClosedFormsAndRefusesFreeHorizons) {
  const Situation integrator = situation_of(bounded_integrator());
  EXPECT_EQ(integrator.end, "fixed");
  EXPECT_TRUE(integrator.has_closed_form);
  const Situation links = situation_of(std::make_shared<RestatedProblem>(
      make_problem("two_link_manipulator"), RestatedProblem::Changes{.final_weight = 1.0}));
  EXPECT_EQ(links.end, "free");
  EXPECT_FALSE(links.has_closed_form);
  tests::expect_error_naming({"particle_steering", "free horizon"},
                             [] { static_cast<void>(situation_of(make_problem("particle_steering"))); });
}

}  // namespace
}  // namespace dmocbench
