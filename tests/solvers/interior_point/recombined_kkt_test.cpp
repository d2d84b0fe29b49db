// Elimination of the midpoint rule on (q, p) by DMOC's recursion, against the elimination of its own form.

#include "methods/solvers/interior_point/intervals/recombined_kkt.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "problems/brachistochrone.hpp"
#include "problems/orbital_transfer.hpp"
#include "problems/two_link_manipulator.hpp"
#include "tests/support/dense_kkt.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench::interior_point {
namespace {

using tests::DenseKkt;
using tests::KktNumbers;
using tests::RandomPoints;

/// A system at a random point near a motion, with a shift that makes it convex where `shift` is large. It leaves
/// momenta out between the ends, as the recombined elimination does.
KktNumbers numbers_near(Transcription& program, const Motion& motion, double shift, unsigned seed) {
  RandomPoints random(seed);
  const auto n = static_cast<Eigen::Index>(program.variable_count());
  const auto m = static_cast<Eigen::Index>(program.constraint_count());
  KktNumbers numbers;
  numbers.hessian.resize(static_cast<Eigen::Index>(program.hessian_structure().size()));
  numbers.jacobian.resize(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  const Eigen::VectorXd x = sample(program, motion) + random.vector(n, -1e-2, 1e-2);
  program.hessian(x, 1.0, random.vector(m, -1e-2, 1e-2), numbers.hessian);
  program.jacobian(x, numbers.jacobian);
  numbers.diagonal = random.vector(n, 0.0, 1.0).array() + shift;
  numbers.compliance.setZero(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    if (program.constraint_lower()[i] != program.constraint_upper()[i]) numbers.compliance[i] = random.number(0.1, 1.0);
  }
  numbers.slope = random.vector(n);
  numbers.rows = random.vector(m);
  const auto entries = program.interval_structure()->intervals;
  const Eigen::Index half = program.traced_problem().configuration_size();
  for (Eigen::Index i = half; i < 2 * half; ++i) {
    const auto length = static_cast<Eigen::Index>(entries) + 1;
    numbers.diagonal.segment(i * length + 1, length - 2).setZero();
  }
  return numbers;
}

struct Step {
  FactorisationStatus verdict = FactorisationStatus::untrusted;
  Eigen::VectorXd both;  // unknowns, then multipliers
};

Step step_of(KktSystem& kkt, const KktNumbers& numbers) {
  Eigen::VectorXd primal = Eigen::VectorXd::Zero(numbers.slope.size());
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(numbers.rows.size());
  Step step;
  step.verdict = kkt.solve(numbers.matrix(), {numbers.slope, numbers.rows}, {primal, multipliers});
  step.both.resize(primal.size() + multipliers.size());
  step.both << primal, multipliers;
  return step;
}

/// Returns the shape that was eliminated.
Shape expect_same_step(const Problem& problem, Eigen::Index intervals, const Motion& motion, double shift) {
  constexpr unsigned points = 8;
  Shape shape{};
  for (unsigned seed = 0; seed < points; ++seed) {
    SCOPED_TRACE(problem.name() + ", N = " + std::to_string(intervals) + ", seed " + std::to_string(seed));
    const auto program = tests::transcribe(problem, {"hamiltonian"}, Grid::uniform(intervals));
    const KktNumbers numbers = numbers_near(*program, motion, shift, seed);
    std::string why;
    const auto own = IntervalKkt::make(*program, why);
    const auto recombined = RecombinedKkt::make(*program, why);
    if (!own || !recombined) {
      ADD_FAILURE() << why;
      return shape;
    }
    shape = recombined->shape();
    const Step wanted = step_of(*own, numbers);
    const Step found = step_of(*recombined, numbers);
    EXPECT_EQ(wanted.verdict, FactorisationStatus::solved);
    EXPECT_EQ(found.verdict, FactorisationStatus::solved);
    const Eigen::VectorXd exact = DenseKkt(*program, numbers).solution();
    const auto error = [&](const Step& step, Eigen::Index first, Eigen::Index count) {
      return (step.both - exact).segment(first, count).lpNorm<Eigen::Infinity>() /
             exact.segment(first, count).lpNorm<Eigen::Infinity>();
    };
    EXPECT_LT(error(wanted, 0, numbers.slope.size()), 1e-9);
    EXPECT_LT(error(found, 0, numbers.slope.size()), 1e-9);
    EXPECT_LT(error(wanted, numbers.slope.size(), numbers.rows.size()), 1e-9);
    EXPECT_LT(error(found, numbers.slope.size(), numbers.rows.size()), 1e-9);
  }
  return shape;
}

TEST(RecombinedKkt, GivesTheStepOfTheOwnFormOnThePapersProblems) {
  const OrbitalTransfer orbit;
  const TwoLinkManipulator two_link;
  for (const Eigen::Index intervals : {8, 37}) {
    for (const Problem* problem : {static_cast<const Problem*>(&orbit), static_cast<const Problem*>(&two_link)}) {
      const Shape shape = expect_same_step(*problem, intervals, tests::common_start(*problem), 10.0);
      const auto n = static_cast<int>(problem->configuration_size());
      EXPECT_EQ(shape.node, n);
      EXPECT_EQ(shape.carried, n);
      EXPECT_EQ(shape.rows, n);
    }
  }
}

TEST(RecombinedKkt, TakesFreeVelocitiesInequalitiesAndConditions) {
  const TwoLinkManipulator base;
  const tests::Restated problem(base, [](tests::Restated::Statement& s) {
    s.first.free_velocity(1);
    s.last.free_velocity(0).free_velocity(1);
    s.u = tests::all_between(2, -100.0, 100.0);
    s.path = [](const ControlledState& x) {
      ExpressionVector h(1);
      h << 50.0 - x.q[0] * x.v[1] - x.u[0];
      return h;
    };
    s.conditions = [](const State& first, const State& last) {
      return ExpressionVector::Constant(1, last.v[0] * last.q[0] - first.v[1]);
    };
    s.final_cost = [](const State& last) { return 0.5 * last.v[0] * last.v[0] * last.q[0]; };
  });
  expect_same_step(problem, 11, guessed_motion(problem), 10.0);
}

Solution solve_by(const std::string& factorisation, NonlinearProgram& program, const Eigen::VectorXd& start) {
  SolverOptions options;
  options.passed_on["factorisation"] = factorisation;
  return InteriorPointSolver(options).solve(program, start);
}

TEST(RecombinedKkt, SolvesThePapersProblemsAsTheOwnFormDoes) {
  const OrbitalTransfer orbit;
  const TwoLinkManipulator two_link;
  for (const Problem* problem : {static_cast<const Problem*>(&orbit), static_cast<const Problem*>(&two_link)}) {
    for (const Eigen::Index intervals : {24, 64}) {
      SCOPED_TRACE(problem->name() + ", N = " + std::to_string(intervals));
      const auto program = tests::transcribe(*problem, {"hamiltonian"}, Grid::uniform(intervals));
      const Eigen::VectorXd start = sample(*program, tests::common_start(*problem));
      const Solution own = solve_by("intervals", *program, start);
      const Solution recombined = solve_by("recombined", *program, start);
      ASSERT_EQ(own.status, Status::solved) << own.message;
      ASSERT_EQ(recombined.status, Status::solved) << recombined.message;
      EXPECT_NEAR(recombined.objective, own.objective, 1e-9 * std::abs(own.objective));
      EXPECT_LT((recombined.primal - own.primal).lpNorm<Eigen::Infinity>(), 1e-6);
    }
  }
}

void expect_refusal(NonlinearProgram& program, const std::string& reason) {
  std::string why;
  EXPECT_EQ(RecombinedKkt::make(program, why), nullptr);
  EXPECT_NE(why.find(reason), std::string::npos) << why;
}

TEST(RecombinedKkt, RefusesOtherMethodsTableausAndProgramsInASentence) {
  const OrbitalTransfer orbit;
  const TwoLinkManipulator two_link;
  const Grid grid = Grid::uniform(8);
  expect_refusal(*tests::transcribe(orbit, {"dmoc"}, grid), "those of nodes already");
  expect_refusal(*tests::transcribe(orbit, {"hamiltonian", 2}, grid), "rows of an interval, not in two");
  expect_refusal(*tests::transcribe(two_link, {"tangent"}, grid), "do not enter linearly");
  const Brachistochrone free_horizon;
  expect_refusal(*tests::transcribe(free_horizon, {"hamiltonian"}, grid), "belongs to the whole horizon");
  tests::SmallProgram rosenbrock = tests::rosenbrock();
  expect_refusal(rosenbrock, "interval structure");

  const auto program = tests::transcribe(orbit, {"dmoc"}, grid);
  const Solution solution = solve_by("recombined", *program, sample(*program, guessed_motion(orbit)));
  EXPECT_EQ(solution.status, Status::invalid_program);
}

}  // namespace
}  // namespace dmocbench::interior_point
