#include "methods/extensions/step_control/step_control_program.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/extensions/step_control/extended_action.hpp"
#include "methods/extensions/step_control/step_control_map.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

Expression one_everywhere(const ControlledState& /*x*/) { return 1.0; }
Expression by_distance(const ControlledState& x) { return pow(x.q.dot(x.q), 0.75); }
/// Reads the velocity, the control and the time too; equals 1 nowhere.
Expression by_everything(const ControlledState& x) {
  return 1.2 + 0.3 * x.q[0] * x.q[0] + 0.1 * x.v[1] * x.v[1] + 0.1 * sin(x.t) + 0.1 * x.u[0] * x.u[0];
}

struct Stepped {
  Trajectory motion;
  Eigen::VectorXd primal;
};

Stepped solved(StepControlProgram& program, const Motion& start) {
  const Solution solution = make_solver("ipopt")->solve(program, program.start(start));
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  return {program.read(solution.primal), solution.primal};
}

TEST(StepControlProgram, WithAConstantFunctionIsDmocOnAUniformGrid) {
  const tests::MovingFrame problem;
  for (const int stages : {1, 2}) {
    StepControlProgram program(problem, gauss_tableau(stages), one_everywhere, 8);
    const Trajectory motion = solved(program, guessed_motion(problem)).motion;
    const Trajectory plain =
        tests::solve(problem, {"dmoc", stages}, Grid::uniform(8), guessed_motion(problem)).trajectory;
    EXPECT_LT((motion.node_times - plain.node_times).norm(), 1e-10);
    EXPECT_LT((motion.q - plain.q).norm(), 1e-8);
    EXPECT_LT((motion.p - plain.p).norm(), 1e-8);
    EXPECT_NEAR(motion.cost, plain.cost, 1e-9);
  }
}

TEST(StepControlProgram, DerivativesAreThoseOfCentralDifferences) {
  const tests::MovingFrame problem;
  StepControlProgram program(problem, gauss_tableau(2), by_everything, 3);
  tests::RandomPoints random;
  const auto variables = static_cast<Eigen::Index>(program.variable_count());
  const auto constraints = static_cast<Eigen::Index>(program.constraint_count());
  const Eigen::VectorXd x = program.start(guessed_motion(problem)) + random.vector(variables, -0.05, 0.05);
  const Eigen::VectorXd multipliers = random.vector(constraints);
  const Eigen::VectorXd direction = random.vector(variables);
  const auto rows = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd values(constraints);
    program.constraints(at, values);
    return values;
  };
  const auto jacobian = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(program.jacobian_structure().size()));
    program.jacobian(at, values);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(constraints, variables);
    program.jacobian_structure().for_each([&](Eigen::Index e, int i, int j) { matrix(i, j) += values[e]; });
    return matrix;
  };
  const auto lagrangian_gradient = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd gradient(variables);
    program.gradient(at, gradient);
    return Eigen::VectorXd(0.7 * gradient + jacobian(at).transpose() * multipliers);
  };
  Eigen::VectorXd values(static_cast<Eigen::Index>(program.hessian_structure().size()));
  program.hessian(x, 0.7, multipliers, values);
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(variables, variables);
  program.hessian_structure().for_each([&](Eigen::Index e, int i, int j) {
    EXPECT_GE(i, j);
    hessian(i, j) += values[e];
    if (i != j) hessian(j, i) += values[e];
  });
  constexpr double step = 1e-5;
  const Eigen::VectorXd ahead = x + step * direction;
  const Eigen::VectorXd behind = x - step * direction;
  EXPECT_LT(((rows(ahead) - rows(behind)) / (2.0 * step) - jacobian(x) * direction).norm(), 1e-6);
  EXPECT_LT(((lagrangian_gradient(ahead) - lagrangian_gradient(behind)) / (2.0 * step) - hessian * direction).norm(),
            1e-6);
}

TEST(StepControlProgram, HasMotionsThatTheMapWithTheSameControlsAndPaceSimulates) {
  const tests::MovingFrame problem;
  for (const int stages : {1, 2}) {
    const Tableau tableau = gauss_tableau(stages);
    StepControlProgram program(problem, tableau, by_everything, 8);
    const auto [motion, primal] = solved(program, guessed_motion(problem));
    const StepControlMap map(problem, tableau, by_everything, StepRule::variational);
    const BoundaryState first = problem.initial_state();
    StepControlMap::From at{.q = first.q,
                            .p = LegendreTransform(TracedProblem(problem)).momentum(first.q, first.v, 0.0),
                            .t = 0.0,
                            .energy = Energy(problem).energy(first.q, first.v, 0.0),
                            .velocity = first.v};
    for (Eigen::Index k = 0; k < 8; ++k) {
      const auto step = map.advance(at, motion.stage_u.middleRows(k * stages, stages), program.pace(primal));
      EXPECT_NEAR(step.end.t, motion.node_times[k + 1], 1e-8);
      EXPECT_LT((step.end.q - motion.q.row(k + 1).transpose()).norm(), 1e-8);
      EXPECT_NEAR(step.multiplier, primal[primal.size() - 9 + k], 1e-7) << "the last unknowns are λ and the pace";
      at = step.end;
    }
  }
}

TEST(StepControlProgram, HasTheOrderOfItsTableauAndStepsInProportionToTheFunction) {
  const tests::CentralForce problem;
  const double optimum = tests::solve(problem, {"dmoc", 3}, Grid::uniform(64), guessed_motion(problem)).trajectory.cost;
  for (const int stages : {1, 2}) {
    const auto error = [&](std::size_t intervals) {
      StepControlProgram program(problem, gauss_tableau(stages), by_distance, intervals);
      const Trajectory motion = solved(program, guessed_motion(problem)).motion;
      const StepTimes wanted = step_times(by_distance, smooth_motion(motion), static_cast<Eigen::Index>(intervals));
      EXPECT_LT((motion.node_times - wanted.times).lpNorm<Eigen::Infinity>(), 0.02);
      return std::abs(motion.cost - optimum);
    };
    EXPECT_NEAR(std::log2(error(12) / error(24)), 2.0 * stages, 0.35);
  }
}

TEST(StepControlProgram, RefusesWhatItDoesNotKnowAndAFunctionThatIsNotPositive) {
  const auto bounded = make_problem("beam");
  tests::expect_error_naming({"beam", "fixed ends"}, [&] {
    static_cast<void>(StepControlProgram(*bounded, gauss_tableau(1), one_everywhere, 8));
  });
  const tests::DoubleIntegrator problem;
  const auto negative = [](const ControlledState& x) { return 0.5 - x.q[0]; };
  const StepControlProgram program(problem, gauss_tableau(1), negative, 8);
  tests::expect_error_naming({"positive"}, [&] { static_cast<void>(program.start(guessed_motion(problem))); });
}

}  // namespace
}  // namespace dmocbench
