#include <gtest/gtest.h>

#include "bench/experiments/sequence/neighbours.hpp"
#include "bench/experiments/sequence/solved_steps.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

TEST(Shifted, BelongsToTheNodeOrIntervalBehind) {
  Places places;
  places.append(Place::Kind::node, 0, 3);
  places.append(Place::Kind::interval, 0, 2);
  places.append(Place::Kind::node, 2, 1);
  places.append(Place::Kind::border, 0, 2);
  Eigen::VectorXd values(8);
  values << 1, 2, 3, 4, 5, 6, 7, 8;
  Eigen::VectorXd expected(8);
  expected << 2, 3, 3, 5, 5, 6, 7, 8;
  EXPECT_EQ(shifted(places, values), expected);
}

TEST(OneIntervalLater, GoesOnBeyondTheEndWithTheVelocityThere) {
  Trajectory motion;
  motion.tableau = make_tableau("gauss", 1);
  motion.node_times = Eigen::Vector3d(0.0, 0.5, 1.0);
  motion.q = Eigen::Vector3d(1.0, 2.0, 4.0);
  motion.v = Eigen::Vector3d(1.0, 3.0, 5.0);
  motion.stage_times = Eigen::Vector2d(0.25, 0.75);
  motion.stage_u = Eigen::Vector2d(6.0, 7.0);
  const Motion later = one_interval_later(motion);
  EXPECT_EQ(later.horizon, 1.0);
  EXPECT_NEAR(later.at(0.0).q[0], 2.0, 1e-14);
  EXPECT_NEAR(later.at(0.0).v[0], 3.0, 1e-14);
  EXPECT_NEAR(later.at(0.25).u[0], 7.0, 1e-14);
  EXPECT_NEAR(later.at(0.5).q[0], 4.0, 1e-14);
  EXPECT_NEAR(later.at(1.0).q[0], 4.0 + 0.5 * 5.0, 1e-14);
  EXPECT_NEAR(later.at(1.0).v[0], 5.0, 1e-14);
}

class SequenceOfProblems : public testing::Test {
 protected:
  SolvedCase solved_first(const std::string& method) {
    const Case the_case{
        .problem = problem_, .method = method, .solver = "interior_point", .grid = Grid::uniform(intervals_)};
    const Motion start = tests::common_start(*problem_);
    return solve_case(the_case, {start}, *make_solver("interior_point"), 1e-10, 1);
  }
  std::shared_ptr<const Problem> problem_ = make_problem("two_link_manipulator");
  int intervals_ = 16;
};

TEST_F(SequenceOfProblems, BeginsAtTheSecondNodeOfTheLastSolutionButForTheDisturbance) {
  const SolvedCase first = solved_first("dmoc");
  const Trajectory& motion = *first.trajectory;
  const auto without = receding_horizon(problem_, motion, 0.0, 1)->next(1, motion);
  EXPECT_EQ(without->initial_state().q, motion.q.row(1).transpose());
  EXPECT_EQ(without->initial_state().v, motion.v.row(1).transpose());
  EXPECT_EQ(without->final_state().q, problem_->final_state().q);  // at rest
  const auto with = receding_horizon(problem_, motion, 0.01, 1)->next(1, motion);
  const Eigen::VectorXd range = (motion.q.colwise().maxCoeff() - motion.q.colwise().minCoeff()).transpose();
  const Eigen::VectorXd moved = with->initial_state().q - without->initial_state().q;
  EXPECT_GT(moved.norm(), 0.0);
  EXPECT_TRUE((moved.cwiseAbs().array() <= 0.01 * range.array()).all());
  EXPECT_EQ(receding_horizon(problem_, motion, 0.01, 1)->next(1, motion)->initial_state().q, with->initial_state().q);
  EXPECT_NE(receding_horizon(problem_, motion, 0.01, 2)->next(1, motion)->initial_state().q, with->initial_state().q);
}

TEST_F(SequenceOfProblems, OfTheOrbitMovesItsEndAlongTheCircle) {
  const std::shared_ptr<const Problem> orbit = make_problem("orbital_transfer");
  Trajectory motion;
  motion.node_times = Eigen::VectorXd::LinSpaced(3, 0.0, 2.0);
  motion.q = Eigen::MatrixXd::Ones(3, 2);
  motion.v = Eigen::MatrixXd::Ones(3, 2);
  const auto next = receding_horizon(orbit, motion, 0.0, 1)->next(1, motion);
  EXPECT_EQ(next->final_state().q, orbit->final_state().q + orbit->final_state().v);
  EXPECT_EQ(next->final_state().v, orbit->final_state().v);
}

TEST_F(SequenceOfProblems, BeginsWithTheFirstOrderStatesOfTheLastSolution) {
  const std::shared_ptr<const Problem> burning = make_problem("orbital_transfer_with_mass");
  Trajectory motion;
  motion.node_times = Eigen::VectorXd::LinSpaced(3, 0.0, 2.0);
  motion.q = motion.v = Eigen::MatrixXd::Ones(3, 2);
  motion.y = Eigen::MatrixXd::Constant(3, 1, 0.9);
  const auto next = receding_horizon(burning, motion, 0.0, 1)->next(1, motion);
  EXPECT_EQ(next->initial_state().y, Eigen::VectorXd::Constant(1, 0.9));
  EXPECT_EQ(next->bounds().first.y.upper, Eigen::VectorXd::Constant(1, 0.9));
}

TEST_F(SequenceOfProblems, IsSolvedWarmInFewerIterationsThanCold) {
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    const SolvedCase first = solved_first(method);
    SequenceRun run(first, receding_horizon(problem_, *first.trajectory, 0.01, 1), {}, 1);
    for (int step = 0; step < 5; ++step) {
      const SequenceStep solved = run.next(true);
      EXPECT_EQ(solved.warm.status, "solved");
      EXPECT_EQ(solved.is_warm_worse(), false);
      EXPECT_LE(solved.warm.iterations, 8);
      EXPECT_EQ(solved.number, step + 1);
    }
  }
}

TEST_F(SequenceOfProblems, OfTheOrbitTakesNoMoreIterationsByDmocThanWhereVelocitiesAreUnknowns) {
  problem_ = make_problem("orbital_transfer");
  intervals_ = 64;
  const auto iterations_of = [&](const std::string& method) {
    const SolvedCase first = solved_first(method);
    SequenceRun run(first, receding_horizon(problem_, *first.trajectory, 0.01, 1), {}, 1);
    int iterations = 0;
    for (int step = 0; step < 20; ++step) iterations += run.next(false).warm.iterations;
    return iterations;
  };
  constexpr int differences = 2;  // by rounding, of about 60
  EXPECT_LE(iterations_of("dmoc"), iterations_of("tangent") + differences);
}

TEST_F(SequenceOfProblems, CarriesTheBarrierParameterWhereThereIsABarrier) {
  const SolvedCase without = solved_first("dmoc");
  SequenceRun unbounded(without, receding_horizon(problem_, *without.trajectory, 0.01, 1), {}, 1);
  EXPECT_FALSE(unbounded.next(false).start_barrier_parameter);

  problem_ = make_problem("cart_pole");
  const SolvedCase first = solved_first("dmoc");
  SequenceRun carries(first, receding_horizon(problem_, *first.trajectory, 0.01, 1), {}, 1);
  EXPECT_EQ(carries.next(false).start_barrier_parameter, first.solution.barrier_parameter);
  EXPECT_LT(carries.next(false).start_barrier_parameter, 1e-8);
}

TEST_F(SequenceOfProblems, GoesFromTheLowerToTheUpperValueOfItsQuantity) {
  const SweptQuantity quantity{"final_q1", 0.2, 0.7};
  const auto neighbours = homotopy(problem_, {}, quantity, 5);
  EXPECT_DOUBLE_EQ(neighbours->next(1, {})->final_state().q[0], 0.3);
  EXPECT_DOUBLE_EQ(neighbours->next(5, {})->final_state().q[0], 0.7);
}

SequenceStep step_of(int number, int iterations, const std::optional<StepSolve>& cold,
                     const std::string& status = "solved") {
  return {.scheme = {"orbital_transfer", "dmoc", "gauss", 1},
          .intervals = 64,
          .sequence = "homotopy",
          .number = number,
          .warm = {.status = status, .iterations = iterations, .microseconds = 10.0 * iterations},
          .cold = cold};
}

TEST(SequenceSummary, TellsQuantilesAndHowOftenWarmIsWorse) {
  std::vector<SequenceStep> steps;
  for (int i = 1; i <= 200; ++i) steps.push_back(step_of(i, i, std::nullopt));
  steps[0].cold = StepSolve{.status = "solved", .iterations = 0};                                   // warm is worse
  steps[1].cold = StepSolve{.status = "solved", .iterations = 30};                                  // better
  steps[2].cold = StepSolve{.status = "step failed", .iterations = 1};                              // better
  steps.push_back(step_of(201, 7, StepSolve{.status = "solved", .iterations = 9}, "step failed"));  // worse
  const Table table = sequence_summary(steps);
  ASSERT_EQ(table.rows().size(), 1U);
  const Row& row = table.rows().front();
  EXPECT_EQ(row.text("steps"), "201");
  EXPECT_EQ(row.text("solved"), "200");
  EXPECT_EQ(row.number("median_iterations"), 100.5);
  EXPECT_DOUBLE_EQ(row.needed("p99_iterations"), 198.01);
  EXPECT_EQ(row.number("largest_iterations"), 200.0);
  EXPECT_DOUBLE_EQ(row.needed("p99_microseconds"), 1980.1);
  EXPECT_EQ(row.number("compared_with_cold"), 4.0);
  EXPECT_EQ(row.number("warm_is_worse"), 0.5);
}

}  // namespace
}  // namespace dmocbench
