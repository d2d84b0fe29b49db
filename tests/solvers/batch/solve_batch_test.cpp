#include "methods/solvers/batch/solve_batch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/lane_transcription.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"
#include "tests/solvers/batch/batch_case.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench::batch {
namespace {

/// A motion with random curves added, of up to half of the way that each coordinate goes.
Motion randomly_bent(const Motion& motion, tests::RandomPoints& random) {
  constexpr Eigen::Index modes = 3;
  const Eigen::VectorXd way = (motion.at(motion.horizon).q - motion.at(0.0).q).cwiseAbs();
  Eigen::MatrixXd amplitudes(way.size(), modes);
  for (Eigen::Index k = 0; k < modes; ++k) {
    amplitudes.col(k) = random.vector(way.size(), -0.5, 0.5).cwiseProduct(way) / static_cast<double>(k + 1);
  }
  return bent(motion, amplitudes);
}

/// Instances that must hurt no other: numbers and sizes that are wrong, a formula without a value, ends out of reach.
void poison(BatchInstance& instance, std::size_t kind) {
  switch (kind % 5) {
    case 0:
      instance.start[2] = std::numeric_limits<double>::quiet_NaN();
      break;
    case 1:
      instance.start.conservativeResize(3);
      break;
    case 2:
      instance.multipliers.setOnes(1);
      break;
    case 3:
      instance.start.head(2).setZero();  // the radius: 1/r is infinite
      break;
    default:
      instance.equality_values.array() += 1e150;
  }
}

bool are_same(const Solution& a, const Solution& b) {
  return a.status == b.status && a.primal == b.primal && a.multipliers == b.multipliers &&
         a.major_iterations == b.major_iterations;
}

TEST(SolveBatch, GivesTheAnswersOfSingleSolvesForEveryFamilyAndSeveralStages) {
  for (const std::string& method : paper_families()) {
    for (const int stages : {1, 2}) {
      SCOPED_TRACE(method + ' ' + std::to_string(stages));
      Case("orbital_transfer", method, stages, 16).expect_answers_of_single_solves(12, 0.02);
    }
  }
  Case("two_link_manipulator", "dmoc", 1, 16).expect_answers_of_single_solves(24, 0.1);
  for (const char* method : {"galerkin_2_1", "galerkin_1_3"}) {
    SCOPED_TRACE(method);
    Case("orbital_transfer", method, 3, 16).expect_answers_of_single_solves(12, 0.02);
  }
}

TEST(SolveBatch, GivesTheAnswersOfSingleSolvesWhereThereAreBoundsAndInequalities) {
  Case("double_integrator", "dmoc", 1, 16, "largest_force", 5.0).expect_answers_of_single_solves(12, 0.05);
  Case("cart_pole", "dmoc", 1, 16).expect_answers_of_single_solves(12, 0.01);
  Case("container_crane", "dmoc", 1, 16).expect_answers_of_single_solves(4, 0.01);
}

TEST(SolveBatch, StartsWarmFromMultipliers) {
  Case orbit("orbital_transfer", "dmoc", 1, 16);
  const Solution neighbour = InteriorPointSolver().solve(*orbit.program, orbit.start);
  orbit.start = neighbour.primal;
  std::vector<BatchInstance> instances = orbit.instances(8, 1e-4);
  for (BatchInstance& instance : instances) instance.multipliers = neighbour.multipliers;
  for (const Solution& solution : orbit.solve(instances)) {
    EXPECT_EQ(solution.status, Status::solved);
    EXPECT_LE(*solution.major_iterations, 3);
  }
}

TEST(SolveBatch, GivesTheAnswersOfSingleSolvesForOtherParameters) {
  const auto problem = make_problem("two_link_manipulator");
  const std::string name = "mass_1";
  Transcription program(*problem, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(16),
                        OpenParameters{{name}});
  const Eigen::VectorXd start = sample(program, guessed_motion(*problem));
  const auto number = std::ranges::find(problem->parameters(), name, &Parameter::name) - problem->parameters().begin();
  const auto parameters = [&](std::size_t index) {
    Eigen::VectorXd values = program.parameter_values();
    values[number] *= 1.0 + 0.01 * static_cast<double>(index);
    return values;
  };
  constexpr std::size_t count = 11;
  std::vector<BatchInstance> instances(count);
  for (std::size_t i = 0; i < count; ++i)
    instances[i] = {.start = start, .equality_values = {}, .multipliers = {}, .parameters = parameters(i)};
  std::vector<Solution> solutions(count);
  const auto next = [&](std::size_t index, BatchInstance& instance) {
    if (index < count) instance = instances[index];
    return index < count;
  };
  BatchOptions options;
  options.set_parameters = parameters_of(program);
  solve_batch(
      program, lanes_of(program), start, next,
      [&](std::size_t index, const Solution& solution) { solutions[index] = solution; }, options);
  for (std::size_t i = 0; i < count; ++i) {
    program.set_parameters(instances[i].parameters);
    const Solution alone = InteriorPointSolver().solve(program, start);
    EXPECT_EQ(solutions[i].status, alone.status) << i;
    EXPECT_NEAR(solutions[i].objective, alone.objective, 1e-10 * std::abs(alone.objective)) << i;
  }
  EXPECT_GT(std::abs(solutions[1].objective - solutions[0].objective), 1e-6);
}

TEST(SolveBatch, ChangesNoDigitOfAnAnswerWhateverItsNeighboursAreAndHoweverManyThreadsThereAre) {
  constexpr std::size_t count = 4096;
  constexpr std::size_t one_percent = 100;
  Case orbit("orbital_transfer", "dmoc", 1, 8);
  std::vector<BatchInstance> instances = orbit.instances(count, 0.02);
  const std::vector<Solution> healthy = orbit.solve(instances, {.threads = 1});
  std::ranges::reverse(instances);
  std::vector<bool> is_poisoned(count);
  for (std::size_t i = 0; i < count; i += one_percent) {
    poison(instances[i], i / one_percent);
    is_poisoned[i] = true;
  }
  BatchOptions options{.threads = 3};
  options.falls_back = false;
  const std::vector<Solution> mixed = orbit.solve(instances, options);
  EXPECT_EQ(orbit.summary.instances, count);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (is_poisoned[i]) {
      EXPECT_FALSE(is_solved(mixed[i].status)) << i;
    } else if (healthy[count - 1 - i].solver == "batch") {
      EXPECT_TRUE(are_same(mixed[i], healthy[count - 1 - i])) << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, count * 9 / 10);
}

TEST(SolveBatch, CountsTheEvaluationsThatASingleSolveNeeds) {
  Case motion("double_integrator", "dmoc", 1, 16);
  const std::vector<BatchInstance> instances = motion.instances(3, 0.05);
  const std::vector<Solution> solutions = motion.solve(instances);
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Solution alone = motion.solve_alone(instances[i]);
    ASSERT_EQ(solutions[i].major_iterations, alone.major_iterations);
    EXPECT_EQ(solutions[i].total_evaluations(), alone.total_evaluations());
  }
}

/// Instances along a line, each a little farther than the one before, so that the nearest one is the last of those that
/// may be taken.
TEST(SolveBatch, StartsFromTheNearestInstanceOfThoseBeforeHoweverManyThreadsThereAre) {
  constexpr std::size_t count = 200;
  Case orbit("orbital_transfer", "dmoc", 1, 8);
  ClampedEnds ends(*orbit.program);
  const auto answers = [&](std::size_t threads) {
    std::vector<Solution> solutions(count);
    std::vector<bool> has_neighbour(count);
    const auto place = [&](std::size_t index, Eigen::VectorXd& here) {
      if (index == count) return false;
      here = Eigen::VectorXd::Constant(1, static_cast<double>(index));
      return true;
    };
    const auto next = [&](std::size_t index, const Solution* neighbour, BatchInstance& instance) {
      has_neighbour[index] = neighbour != nullptr;
      instance.start = neighbour == nullptr ? orbit.start : neighbour->primal;
      instance.multipliers = neighbour == nullptr ? Eigen::VectorXd() : neighbour->multipliers;
      instance.equality_values = orbit.program->constraint_lower();
      BoundaryState last = orbit.problem->final_state();
      last.q[1] += 1e-4 * static_cast<double>(index);
      ends.write(orbit.problem->initial_state(), last, instance.start, instance.equality_values);
    };
    BatchOptions options;
    options.threads = threads;
    orbit.summary = solve_batch_from_neighbours(
        *orbit.program, lanes_of(*orbit.program), orbit.start, place, next,
        [&](std::size_t index, const Solution& solution) { solutions[index] = solution; }, options);
    EXPECT_EQ(orbit.summary.instances, count);
    EXPECT_FALSE(has_neighbour[63]);
    EXPECT_TRUE(has_neighbour[64]);
    return solutions;
  };
  const std::vector<Solution> one = answers(1);
  const std::vector<Solution> three = answers(3);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(one[i].status, Status::solved) << i;
    EXPECT_TRUE(are_same(one[i], three[i])) << i;
  }
  EXPECT_LT(*one[64].major_iterations, *one[63].major_iterations);
  EXPECT_LE(*one[64].major_iterations, *one[127].major_iterations);
}

TEST(SolveBatch, SaysWhatIsWrongWithAnInstance) {
  Case orbit("orbital_transfer", "dmoc", 1, 8);
  std::vector<BatchInstance> instances = orbit.instances(3, 0.01);
  poison(instances[0], 0);
  poison(instances[1], 1);
  const std::vector<Solution> solutions = orbit.solve(instances);
  EXPECT_EQ(solutions[0].status, Status::evaluation_failed);
  EXPECT_EQ(solutions[1].status, Status::invalid_program);
  EXPECT_NE(solutions[1].message.find("has 3 entries"), std::string::npos);
  EXPECT_EQ(solutions[2].status, Status::solved);
}

TEST(SolveBatch, SolvesOneByOneWhatTheLanesCannotAndCountsIt) {
  Case motion("double_integrator", "dmoc", 1, 16, "largest_force", 5.0);
  std::vector<BatchInstance> instances = motion.instances(9, 0.05);
  ClampedEnds ends(*motion.program);
  ends.write(BoundaryState::at_rest(Eigen::VectorXd::Zero(1)),
             BoundaryState::at_rest(Eigen::VectorXd::Constant(1, 9.0)), instances[4].start,
             instances[4].equality_values);
  const std::vector<Solution> solutions = motion.solve(instances);
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    EXPECT_EQ(solutions[i].status, i == 4 ? Status::infeasible : Status::solved) << i;
  }
  EXPECT_EQ(solutions[4].solver, "interior_point");
  EXPECT_EQ(motion.summary.solved_one_by_one, 1U);
}

/// Half of such starts lead nowhere. The lanes follow them to the last iteration, as a single solve does, instead of
/// leaving that to it.
TEST(SolveBatch, KeepsHopelessStartsInTheirLanes) {
  constexpr std::size_t count = 128;
  Case orbit("orbital_transfer", "dmoc", 1, 48);
  tests::RandomPoints random;
  std::vector<BatchInstance> instances(count);
  for (BatchInstance& instance : instances) {
    instance.start = sample(*orbit.program, randomly_bent(guessed_motion(*orbit.problem), random));
    instance.equality_values = orbit.program->constraint_lower();
  }
  const std::vector<Solution> solutions = orbit.solve(instances, {.most_iterations = 200, .falls_back = false});
  const auto ended = [&](Status status) { return std::ranges::count(solutions, status, &Solution::status); };
  EXPECT_GT(ended(Status::iteration_limit), 30);
  EXPECT_LE(ended(Status::step_failed), 6) << "leave their lanes";
}

TEST(SolveBatch, FillsTheLaneOfAnInstanceThatHasConverged) {
  Case arm("two_link_manipulator", "dmoc", 1, 8);
  const std::vector<Solution> solutions = arm.solve(arm.instances(160, 0.1), {.threads = 1});
  std::size_t systems = 0;
  std::size_t most = 0;
  for (const Solution& solution : solutions) {
    systems += static_cast<std::size_t>(solution.linear_systems.value_or(0));
    most = std::max(most, static_cast<std::size_t>(solution.linear_systems.value_or(0)));
  }
  // One more per instance evaluates its start; in the end lanes run dry.
  EXPECT_LE(arm.summary.rounds, (systems + solutions.size()) / instance_lanes + most + 1);
}

TEST(SolveBatch, EndsWhenAskedToAndPassesOnWhatIsThrown) {
  Case orbit("orbital_transfer", "dmoc", 1, 8);
  const std::vector<BatchInstance> instances = orbit.instances(64, 0.02);
  BatchOptions options;
  options.stop_requested = [] { return true; };
  static_cast<void>(orbit.solve(instances, options));
  EXPECT_LT(orbit.summary.instances, instances.size());
  const auto fails = [](std::size_t, const Solution&) { throw Error("full"); };
  const auto next = [&](std::size_t index, BatchInstance& instance) {
    if (index == instances.size()) return false;
    instance = instances[index];
    return true;
  };
  EXPECT_THROW(solve_batch(*orbit.program, lanes_of(*orbit.program), orbit.start, next, fails), Error);
}

TEST(SolveBatch, EndsWithItsTimeOrTheCallersAndSaysSo) {
  for (const bool is_of_caller : {false, true}) {
    Case orbit("orbital_transfer", "dmoc", 1, 8);
    const std::vector<BatchInstance> instances = orbit.instances(64, 0.02);
    constexpr double moment = 1e-9;
    const StopScope scope(nullptr, is_of_caller ? moment : 0.0);
    BatchOptions options{.threads = 2};
    options.most_seconds = is_of_caller ? 0.0 : moment;
    const std::vector<Solution> solutions = orbit.solve(instances, options);
    EXPECT_LT(orbit.summary.instances, instances.size());
    std::size_t begun = 0;
    for (const Solution& solution : solutions) {
      if (solution.status == Status::not_run) continue;
      ++begun;
      EXPECT_EQ(solution.status, Status::time_limit);
    }
    EXPECT_EQ(begun, orbit.summary.instances);
  }
}

TEST(SolveBatch, RefusesEndsThatAreNotGivenInASentence) {
  const auto problem = make_problem("robot_arm");
  Transcription program(*problem, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(16));
  const Eigen::VectorXd start = sample(program, guessed_motion(*problem));
  const auto next = [](std::size_t, BatchInstance&) { return false; };
  const auto take = [](std::size_t, const Solution&) {};
  EXPECT_THROW(solve_batch(program, lanes_of(program), start, next, take), Error);
}

}  // namespace
}  // namespace dmocbench::batch
