#include "methods/solvers/interior_point/interior_point_solver.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/beam.hpp"
#include "problems/brachistochrone.hpp"
#include "problems/cart_pole.hpp"
#include "problems/container_crane.hpp"
#include "problems/forced_oscillator.hpp"
#include "problems/orbital_transfer.hpp"
#include "problems/particle_steering.hpp"
#include "problems/two_link_manipulator.hpp"
#include "tests/robustness/rigid_body_slew.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

Solution solve_by_interior_point(NonlinearProgram& program, const Eigen::VectorXd& start,
                                 const SolverOptions& options = {}) {
  return InteriorPointSolver(options).solve(program, start);
}

Solution solve_with(const std::string& factorisation, NonlinearProgram& program, const Eigen::VectorXd& start) {
  return InteriorPointSolver({}, {.factorisation = factorisation_named(factorisation)}).solve(program, start);
}

/// Ipopt's answer, and a point near it, from which a solver cannot but go back to it.
struct AnswerOfIpopt {
  Solution solution;
  Eigen::VectorXd near;
};

AnswerOfIpopt ask_ipopt(NonlinearProgram& program, const Eigen::VectorXd& start) {
  constexpr double share = 1e-3;
  AnswerOfIpopt answer{.solution = make_solver("ipopt")->solve(program, start), .near = {}};
  EXPECT_EQ(answer.solution.status, Status::solved) << answer.solution.message;
  tests::RandomPoints random;
  answer.near = answer.solution.primal + share * random.vector(start.size());
  return answer;
}

void expect_same_answer(const Solution& found, const Solution& wanted, double unknowns = 1e-6) {
  ASSERT_EQ(found.status, Status::solved) << found.message;
  EXPECT_NEAR(found.objective, wanted.objective, 1e-9 * std::abs(wanted.objective));
  EXPECT_LT((found.primal - wanted.primal).lpNorm<Eigen::Infinity>(), unknowns);
}

void expect_agreement_with_ipopt(const Problem& problem, const tests::Scheme& scheme, Eigen::Index intervals,
                                 const Motion& motion) {
  SCOPED_TRACE(problem.name() + ", " + scheme.label() + ", N = " + std::to_string(intervals));
  Transcription program(problem, *make_element(scheme.method), scheme.tableau(), Grid::uniform(intervals));
  const AnswerOfIpopt ipopt = ask_ipopt(program, sample(program, motion));
  for (const char* factorisation : {"intervals", "sparse"}) {
    SCOPED_TRACE(factorisation);
    expect_same_answer(solve_with(factorisation, program, ipopt.near), ipopt.solution);
  }
}

/// All methods on the paper's problems, and those that a problem with more in it is tried with.
std::vector<tests::Scheme> gauss_schemes_up_to(int most_stages) { return tests::schemes_of({"gauss"}, most_stages); }

TEST(InteriorPoint, AgreesWithIpoptOnTheOrbitalTransfer) {
  const OrbitalTransfer problem;
  for (const tests::Scheme& scheme : gauss_schemes_up_to(2)) {
    for (const Eigen::Index intervals : {16, 32}) {
      expect_agreement_with_ipopt(problem, scheme, intervals, tests::common_start(problem));
    }
  }
}

TEST(InteriorPoint, AgreesWithIpoptOnTheTwoLinkManipulator) {
  const TwoLinkManipulator problem;
  for (const tests::Scheme& scheme : gauss_schemes_up_to(2)) {
    for (const Eigen::Index intervals : {16, 32}) {
      expect_agreement_with_ipopt(problem, scheme, intervals, tests::common_start(problem));
    }
  }
}

/// Newton's method needs one system for linear rows and a quadratic cost; where the start has controls, whose cost has
/// a gradient, its multipliers take another one.
TEST(InteriorPoint, SolvesALinearQuadraticProblemByOneSystemAndOneForMultipliersWhereTheCostHasAGradient) {
  const ForcedOscillator problem;
  for (const tests::Scheme& scheme : gauss_schemes_up_to(2)) {
    SCOPED_TRACE(scheme.label());
    Transcription program(problem, *make_element(scheme.method), scheme.tableau(), Grid::uniform(32));
    const Eigen::VectorXd without_controls = sample(program, guessed_motion(problem));
    const Solution plain = solve_by_interior_point(program, without_controls);
    EXPECT_EQ(plain.status, Status::solved) << plain.message;
    EXPECT_EQ(plain.linear_systems, 1);
    const Eigen::VectorXd with_controls = without_controls + tests::RandomPoints().vector(without_controls.size());
    const Solution other = solve_by_interior_point(program, with_controls);
    EXPECT_EQ(other.linear_systems, 2);
    expect_same_answer(other, plain);
  }
}

TEST(InteriorPoint, AgreesWithIpoptFromTheSameStartFarAway) {
  const OrbitalTransfer problem;
  for (const tests::Scheme& scheme : gauss_schemes_up_to(1)) {
    SCOPED_TRACE(scheme.label());
    Transcription program(problem, *make_element(scheme.method), scheme.tableau(), Grid::uniform(32));
    const Eigen::VectorXd start = sample(program, guessed_motion(problem));
    const Solution ipopt = make_solver("ipopt")->solve(program, start);
    ASSERT_EQ(ipopt.status, Status::solved);
    expect_same_answer(solve_by_interior_point(program, start), ipopt);
  }
}

/// Started from its answer with multipliers, a neighbouring program is solved in fewer iterations than without them,
/// and to the same answer.
TEST(InteriorPoint, StartsWarmFromTheMultipliersOfANeighbour) {
  const ContainerCrane problem;
  for (const char* method : {"dmoc", "hamiltonian"}) {
    SCOPED_TRACE(method);
    Transcription program(problem, *make_element(method), make_tableau("gauss", 1), Grid::uniform(32));
    const Solution cold = solve_by_interior_point(program, sample(program, guessed_motion(problem)));
    ASSERT_EQ(cold.status, Status::solved);
    constexpr double share = 1e-5;
    tests::RandomPoints random;
    const Eigen::VectorXd near = cold.primal + share * random.vector(cold.primal.size());
    const Solution warm = InteriorPointSolver().solve(program, near, cold.multipliers);
    expect_same_answer(warm, cold);
    EXPECT_LE(tests::value_of(warm.major_iterations), tests::value_of(cold.major_iterations) / 2);
    EXPECT_LT(tests::value_of(warm.major_iterations),
              tests::value_of(solve_by_interior_point(program, near).major_iterations));
  }
}

TEST(InteriorPoint, RefusesStartMultipliersOfAnotherProgram) {
  const OrbitalTransfer problem;
  Transcription program(problem, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(8));
  const Eigen::VectorXd start = sample(program, guessed_motion(problem));
  tests::expect_error_naming({"multipliers", "3", "constraints"}, [&] {
    static_cast<void>(InteriorPointSolver().solve(program, start, Eigen::VectorXd::Ones(3)));
  });
}

TEST(InteriorPoint, AgreesWithIpoptWhereBoundsOnControlsAreActive) {
  const TwoLinkManipulator base;
  const Motion motion = tests::common_start(base);
  Transcription free(base, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(16));
  const Solution unbounded_answer = make_solver("ipopt")->solve(free, sample(free, motion));
  const auto largest_torque =
      read_trajectory(free, unbounded_answer.primal, unbounded_answer.multipliers).stage_u.cwiseAbs().maxCoeff();
  const tests::Restated problem(base, [&](tests::Restated::Statement& statement) {
    statement.u = tests::all_between(2, -0.9 * largest_torque, 0.9 * largest_torque);
  });
  for (const tests::Scheme& scheme : gauss_schemes_up_to(2)) expect_agreement_with_ipopt(problem, scheme, 16, motion);
}

TEST(InteriorPoint, AgreesWithIpoptOnAFreeHorizon) {
  const Brachistochrone problem;
  for (const tests::Scheme& scheme : gauss_schemes_up_to(1)) {
    expect_agreement_with_ipopt(problem, scheme, 16, guessed_motion(problem));
  }
}

TEST(InteriorPoint, AgreesWithIpoptOnEverythingAtOnce) {
  const tests::Everything everything;
  for (const tests::Scheme& scheme : tests::all_schemes(2)) {
    expect_agreement_with_ipopt(everything.problem(), scheme, 12, guessed_motion(everything.problem()));
  }
}

TEST(InteriorPoint, ReachesTheOptimumThoughMultipliersRunAwayOnTheWay) {
  const ParticleSteering problem;  // its bounds on the control allow steps of a hundredth for a while
  for (const Eigen::Index intervals : {60, 80}) {
    SCOPED_TRACE(intervals);
    const auto solve = [&](const char* method) {
      Transcription program(problem, *make_element(method), make_tableau("gauss", 1), Grid::uniform(intervals));
      return solve_by_interior_point(program, sample(program, guessed_motion(problem)));
    };
    const Solution dmoc = solve("dmoc");
    const Solution hamiltonian = solve("hamiltonian");
    ASSERT_EQ(dmoc.status, Status::solved) << dmoc.message;
    ASSERT_EQ(hamiltonian.status, Status::solved) << hamiltonian.message;
    EXPECT_NEAR(hamiltonian.objective, dmoc.objective, 1e-8 * dmoc.objective);
  }
}

/// A step that lowers the cost a little may miss the rows a thousand times as much as any point before it; the way back
/// took 228 iterations.
TEST(InteriorPoint, TakesNoStepToWhereTheRowsSayNothing) {
  const ParticleSteering problem;
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    Transcription program(problem, *make_element(method), make_tableau("gauss", 1), Grid::uniform(64));
    const Eigen::VectorXd start = sample(program, guessed_motion(problem));
    const Solution ipopt = make_solver("ipopt")->solve(program, start);
    const Solution found = solve_by_interior_point(program, start);
    ASSERT_EQ(found.status, Status::solved) << found.message;
    EXPECT_NEAR(found.objective, ipopt.objective, 1e-8 * ipopt.objective);
    EXPECT_LE(1.0 * found.major_iterations.value_or(1000), 1.5 * ipopt.major_iterations.value_or(0));
  }
}

/// Its q is small and its multipliers are large: their rounding is what ends the solve.
TEST(InteriorPoint, StopsWhereMultipliersOfALowBeamAreRounding) {
  Beam problem;
  problem.set_parameter("bound", 0.01);
  const auto program = tests::transcribe(problem, {"dmoc", 1}, Grid::uniform(500));
  const Solution found = solve_by_interior_point(*program, sample(*program, guessed_motion(problem)));
  EXPECT_EQ(found.status, Status::solved) << found.message;
  const double least = problem.card().reference->objective * program->cost_scale();
  EXPECT_NEAR(found.objective, least, 2e-3 * least);
}

/// Terminal weights that are too small see conjugate points everywhere: every Hessian was shifted, and 114 to 500
/// iterations were needed, when the compliance of rates, which cost nothing, was taken for that of the controls.
TEST(InteriorPoint, NeedsWithSeveralStagesAsManyIterationsAsWithAnExactInertia) {
  const CartPole cart_pole;
  const ContainerCrane crane;
  for (const Problem* problem : {static_cast<const Problem*>(&cart_pole), static_cast<const Problem*>(&crane)}) {
    for (const char* method : {"dmoc", "hamiltonian"}) {
      SCOPED_TRACE(problem->name() + " " + method);
      Transcription program(*problem, *make_element(method), make_tableau("gauss", 2), Grid::uniform(32));
      const Eigen::VectorXd start = sample(program, guessed_motion(*problem));
      const Solution exact = solve_with("sparse", program, start);
      const Solution found = solve_by_interior_point(program, start);
      ASSERT_EQ(found.status, Status::solved) << found.message;
      EXPECT_NEAR(found.objective, exact.objective, 1e-9 * std::abs(exact.objective));
      EXPECT_LE(1.0 * found.major_iterations.value_or(1000), 1.3 * exact.major_iterations.value_or(0));
      EXPECT_LE(1.0 * found.linear_systems.value_or(1000), 1.3 * exact.linear_systems.value_or(0));
    }
  }
}

/// On fine grids only the largest terminal weights see that a long segment has no conjugate point. Where the failure of
/// smaller ones was believed, Hessians were shifted that were right.
TEST(InteriorPoint, NeedsOnAFineGridAsManyIterationsAsWithAnExactInertia) {
  const TwoLinkManipulator problem;
  Transcription program(problem, *make_element("hamiltonian"), make_tableau("gauss", 3), Grid::uniform(192));
  const Eigen::VectorXd start = sample(program, guessed_motion(problem));
  const Solution exact = solve_with("sparse", program, start);
  const Solution found = solve_by_interior_point(program, start);
  expect_same_answer(found, exact);
  EXPECT_LE(1.0 * found.major_iterations.value_or(1000), 1.2 * exact.major_iterations.value_or(0));
}

/// The length of the quaternion is redundant. Where the inertia by intervals is believed, 300 iterations do not
/// suffice.
TEST(InteriorPoint, ChecksTheInertiaWhereADirectionIsRedundant) {
  const tests::RigidBodySlew problem = tests::RigidBodySlew::slanted();
  for (const char* method : {"dmoc", "hamiltonian"}) {
    SCOPED_TRACE(method);
    Transcription program(problem, *make_element(method), make_tableau("gauss", 3), Grid::uniform(64));
    const Eigen::VectorXd start = sample(program, guessed_motion(problem));
    const Solution exact = solve_with("sparse", program, start);
    const Solution found = solve_by_interior_point(program, start);
    expect_same_answer(found, exact);
    EXPECT_LE(found.major_iterations.value_or(1000), 150);
  }
}

TEST(InteriorPoint, RefusesAProgramWithoutIntervalsInASentence) {
  tests::SmallProgram program = tests::rosenbrock();
  const Solution solution = solve_by_interior_point(program, tests::vector({-1.2, 1.0}));
  EXPECT_EQ(solution.status, Status::invalid_program);
  EXPECT_NE(solution.message.find("interval structure"), std::string::npos) << solution.message;
  EXPECT_NE(solution.message.find("factorisation=sparse"), std::string::npos) << solution.message;
}

TEST(InteriorPoint, KnowsItsOptions) {
  tests::expect_error_naming({"mu_strategy", "factorisation"}, [] {
    static_cast<void>(make_solver("interior_point", {}, {{"mu_strategy", "adaptive"}}));
  });
  tests::expect_error_naming({"factorisation", "dense", "intervals or sparse"}, [] {
    static_cast<void>(make_solver("interior_point", {}, {{"factorisation", "dense"}}));
  });
  tests::expect_error_naming({"factorisation", "dense", "intervals, sparse"},
                             [] { static_cast<void>(factorisation_named("dense")); });
  tests::SmallProgram program = tests::rosenbrock();
  tests::expect_error_naming({"3"},
                             [&] { static_cast<void>(solve_with("sparse", program, Eigen::VectorXd::Zero(3))); });
}

/// A double integrator whose control may not be as large as the shortest way needs it: T = 1 needs |u| >= 4.
TEST(InteriorPoint, NeverSaysThatAnInfeasibleProblemIsSolved) {
  const tests::DoubleIntegrator base;
  const tests::Restated problem(
      base, [](tests::Restated::Statement& statement) { statement.u = tests::all_between(1, -3.0, 3.0); });
  for (const tests::Scheme& scheme : gauss_schemes_up_to(1)) {
    SCOPED_TRACE(scheme.label());
    Transcription program(problem, *make_element(scheme.method), scheme.tableau(), Grid::uniform(16));
    const Solution solution = solve_by_interior_point(program, sample(program, guessed_motion(problem)));
    EXPECT_EQ(solution.status, Status::infeasible) << solution.message;
    EXPECT_GT(solution.constraint_violation.value_or(0.0), 1e-3);
  }
}

}  // namespace
}  // namespace dmocbench
