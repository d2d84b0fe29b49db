#include "methods/adaptive/error_estimate.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/judgement/polish.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

/// The estimate of a solved and polished program.
struct Estimated {
  tests::Solved solved;
  ErrorEstimate estimate;
};

Estimated estimated(const Problem& problem, const Scheme& scheme, const Grid& grid, const Motion& start) {
  Estimated result{tests::solve(problem, scheme, grid, start), {}};
  Solution& solution = result.solved.solution;
  polish(*result.solved.transcription, solution);
  result.solved.trajectory = read_trajectory(*result.solved.transcription, solution.primal, solution.multipliers);
  ErrorEstimator estimator(*result.solved.transcription);
  result.estimate =
      estimator.estimate(*result.solved.transcription, solution.primal, solution.multipliers, result.solved.trajectory);
  return result;
}

/// What is left of the optimum minus the answer when the estimate is taken away, relative to the difference; for each
/// of q, p, ψ^q, ψ^p and the cost.
struct Misfit {
  double q, p, psi_q, psi_p, objective;
  [[nodiscard]] double largest() const { return std::max({q, p, psi_q, psi_p, objective}); }
};

Misfit misfit(const Estimated& of, const Trajectory& optimum) {
  const Trajectory& answer = of.solved.trajectory;
  const auto part = [&](const Eigen::MatrixXd Trajectory::*table, const Eigen::MatrixXd& estimate) {
    const Eigen::MatrixXd difference = optimum.*table - answer.*table;
    return (difference - estimate).norm() / difference.norm();
  };
  const double cost = optimum.cost - answer.cost;
  return {part(&Trajectory::q, of.estimate.q), part(&Trajectory::p, of.estimate.p),
          part(&Trajectory::psi_q, of.estimate.psi_q), part(&Trajectory::psi_p, of.estimate.psi_p),
          std::abs((cost - of.estimate.objective) / cost)};
}

/// The optimum of the forced oscillator: q = (sin t - t cos t)/π, u = (2/π) sin t, ψ^p = -u, ψ^q = u̇.
Trajectory oscillation_like(const Trajectory& answer) {
  constexpr double pi = 3.14159265358979323846;
  Trajectory optimum = answer;
  for (Eigen::Index k = 0; k < answer.node_times.size(); ++k) {
    const double t = answer.node_times[k];
    optimum.q(k, 0) = (std::sin(t) - t * std::cos(t)) / pi;
    optimum.p(k, 0) = t * std::sin(t) / pi;
    optimum.psi_p(k, 0) = -2.0 / pi * std::sin(t);
    optimum.psi_q(k, 0) = 2.0 / pi * std::cos(t);
  }
  optimum.cost = 1.0 / pi;
  return optimum;
}

TEST(ErrorEstimate, IsTheErrorOfEveryFamilyAndTableauAgainstTheClosedFormOfTheOscillator) {
  const auto problem = make_problem("forced_oscillator");
  std::vector<Scheme> schemes = tests::all_schemes(3);
  schemes.push_back({"multiple_shooting_rk4_1", 2});
  schemes.push_back({"multiple_shooting_midpoint_1", 1});
  for (const Scheme& scheme : schemes) {
    const Estimated found = estimated(*problem, scheme, tests::graded_grid(10), guessed_motion(*problem));
    EXPECT_LT(misfit(found, oscillation_like(found.solved.trajectory)).largest(), 0.1) << scheme.label();
  }
}

TEST(ErrorEstimate, VanishesWhereTheAnswerIsExact) {
  // Gauss with two stages has the cubic optimum of the double integrator.
  const auto problem = make_problem("double_integrator");
  for (const std::string& method : paper_families()) {
    const Estimated found = estimated(*problem, {method, 2}, Grid::uniform(6), guessed_motion(*problem));
    EXPECT_LT(found.estimate.relative, 1e-12) << method;
    EXPECT_LT(found.estimate.defects.maxCoeff(), 1e-12) << method;
  }
}

TEST(ErrorEstimate, HasTheEffectivityOneOnTheDoubleIntegratorByOneStage) {
  // The defect is the same in all intervals: q'' = u with u constant instead of linear.
  const auto problem = make_problem("double_integrator");
  const Estimated found = estimated(*problem, {"dmoc", 1}, Grid::uniform(16), guessed_motion(*problem));
  const Eigen::ArrayXd t = found.solved.trajectory.node_times;
  const Eigen::VectorXd optimum = 3.0 * t.square() - 2.0 * t.cube();
  EXPECT_LT((optimum - found.solved.trajectory.q - found.estimate.q).norm(), 0.05 * found.estimate.q.norm());
  EXPECT_NEAR(found.estimate.objective, 6.0 - found.solved.trajectory.cost, 1e-2 * std::abs(found.estimate.objective));
}

TEST(ErrorEstimate, HasTheSlopeOfTheErrorOnUniformGrids) {
  const auto problem = make_problem("two_link_manipulator");
  const Motion& start = tests::common_start(*problem);
  for (const Scheme& scheme : {Scheme{"dmoc", 1}, Scheme{"tangent", 2}}) {
    const IndirectSolution reference =
        solve_indirect(*problem, tests::solve(*problem, {"dmoc", 2}, Grid::uniform(32), start).trajectory);
    std::vector<GridError> estimates;
    std::vector<GridError> errors;
    for (const Eigen::Index intervals : {16, 24, 32, 48}) {
      const Estimated found = estimated(*problem, scheme, Grid::uniform(intervals), start);
      const Trajectory optimum = reference.sampled_like(found.solved.trajectory);
      EXPECT_LT(misfit(found, optimum).largest(), 0.35) << scheme.label() << ' ' << intervals;
      const double h = 1.0 / static_cast<double>(intervals);
      estimates.push_back({h, found.estimate.q.rowwise().norm().maxCoeff()});
      errors.push_back({h, (optimum.q - found.solved.trajectory.q).rowwise().norm().maxCoeff()});
    }
    EXPECT_NEAR(fit_order(estimates)->order, fit_order(errors)->order, 0.1) << scheme.label();
  }
}

TEST(ErrorEstimate, KnowsWhatTheSolverHasLeft) {
  const auto problem = make_problem("forced_oscillator");
  Estimated found = estimated(*problem, {"hamiltonian", 3}, Grid::uniform(16), guessed_motion(*problem));
  tests::Solved& solved = found.solved;
  Eigen::VectorXd moved = solved.solution.primal;
  moved[5] += 1e-4;  // an inner node
  const Trajectory motion = read_trajectory(*solved.transcription, moved, solved.solution.multipliers);
  ErrorEstimator estimator(*solved.transcription);
  const ErrorEstimate estimate = estimator.estimate(*solved.transcription, moved, solved.solution.multipliers, motion);
  EXPECT_NEAR(estimate.q(5, 0), -1e-4, 1e-8);
}

TEST(ErrorEstimate, IsRefusedWhereABoundIsActiveAndWhereTheHorizonIsFree) {
  auto bounded = make_problem("double_integrator");
  bounded->set_parameter("largest_force", 5.0);
  tests::expect_error_naming({"bound"}, [&] {
    static_cast<void>(estimated(*bounded, {"dmoc", 1}, Grid::uniform(24), guessed_motion(*bounded)));
  });
  const auto free = make_problem("brachistochrone");
  const auto program = tests::transcribe(*free, {"dmoc", 1}, Grid::uniform(8));
  tests::expect_error_naming({"horizon"}, [&] { static_cast<void>(ErrorEstimator(*program)); });
}

TEST(ErrorEstimate, SaysThatTheControlDoesNotFollowFromTheCostateWhereTheCostDoesNotWeighIt) {
  const tests::DoubleIntegrator base;
  const tests::Restated unweighed(base, [](tests::Restated::Statement& s) {
    s.running_cost = [](const ControlledState& x) { return x.q[0] * x.q[0]; };
  });
  const auto program = tests::transcribe(unweighed, {"dmoc", 1}, Grid::uniform(8));
  tests::expect_error_naming({"control", "costate", "running cost"},
                             [&] { static_cast<void>(ErrorEstimator(*program)); });
}

TEST(ErrorEstimate, NamesBoundaryConditionsWhicheverEndsTheyRead) {
  const tests::DoubleIntegrator base;
  const tests::Restated conditioned(base, [](tests::Restated::Statement& s) {
    s.last.free_configuration(0);
    s.conditions = [](const State& /*first*/, const State& last) {
      return ExpressionVector::Constant(1, sin(last.q[0]));
    };
  });
  const auto program = tests::transcribe(conditioned, {"dmoc", 1}, Grid::uniform(8));
  const std::string sentence = tests::sentence_of_error([&] { static_cast<void>(ErrorEstimator(*program)); });
  EXPECT_NE(sentence.find("boundary conditions"), std::string::npos) << sentence;
  EXPECT_EQ(sentence.find("both ends"), std::string::npos) << sentence;
}

TEST(ErrorEstimate, DoesNotMindBoundsThatAreNotActive) {
  auto bounded = make_problem("double_integrator");
  bounded->set_parameter("largest_force", 5.999);  // the stages stay inside
  const auto free = make_problem("double_integrator");
  const Grid grid = Grid::uniform(12);
  const ErrorEstimate one = estimated(*bounded, {"dmoc", 1}, grid, guessed_motion(*bounded)).estimate;
  const ErrorEstimate other = estimated(*free, {"dmoc", 1}, grid, guessed_motion(*free)).estimate;
  EXPECT_LT((one.q - other.q).norm(), 1e-6 * other.q.norm());
}

}  // namespace
}  // namespace dmocbench
