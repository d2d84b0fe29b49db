// What every solver owes: answers, limits, refusals and counts. What one of them cannot do stands in `contracts`.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <ostream>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "methods/judgement/confirm.hpp"
#include "methods/judgement/kkt_residual.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

using tests::everywhere;
using tests::HyperVector;
using tests::KnownProgram;
using tests::SmallProgram;
using tests::vector;

/// A solver, how accurate its answers are, and what it cannot do.
struct Contract {
  std::string label;
  std::string solver;
  NamedOptions named = {};
  double tolerance = 1e-10;
  double objective_error = 1e-8;
  double point_error = 2e-5;
  double multiplier_error = 1e-8;
  double residual = 1e-9;
  double valley_error = 1e-8;      ///< of Rosenbrock's minimiser
  bool solves_any_program = true;  ///< false: programs with an interval structure only
  bool gives_multipliers = true;
  bool tells_major_iterations = true;
  bool tells_minor_iterations = false;
  bool checks_derivatives = true;  ///< says "evaluation failed" where any derivative is not a number
  int most_iterations = 3;         ///< for the test of the limit; fewer than the solver needs
  int stopping_question = 4;       ///< of `stop_requested`, for the test of it
  std::vector<Status> infeasible{Status::infeasible};
  double violation_error = 1e-4;  ///< of the least violation of an infeasible program
};

const std::vector<Contract> contracts{
    {.label = "Ipopt", .solver = "ipopt"},
    {.label = "InteriorPointByIntervals",
     .solver = "interior_point",
     .solves_any_program = false,
     .most_iterations = 2,
     .stopping_question = 3},
    {.label = "InteriorPointSparse",
     .solver = "interior_point",
     .named = {{"factorisation", "sparse"}},
     .checks_derivatives = false,
     .infeasible = {Status::infeasible, Status::step_failed},
     .violation_error = 1e-2},
    {.label = "Sqp",
     .solver = "sqp",
     .tells_minor_iterations = true,
     .checks_derivatives = false,
     .violation_error = 1e-3},
    {.label = "SqpLimitedMemory",
     .solver = "sqp",
     .named = {{"hessian", "limited_memory"}},
     .tells_minor_iterations = true,
     .checks_derivatives = false,
     .violation_error = 1e-3},
    // Programs without intervals go to Ipopt at once; the others stand in auto_solver_test.
    {.label = "Auto", .solver = "auto"},
    // Far enough above rounding for SLSQP's line search to reach it on every machine.
    {.label = "Nlopt",
     .solver = "nlopt",
     .tolerance = 1e-8,
     .objective_error = 1e-7,
     .point_error = 2e-4,
     .multiplier_error = 1e-6,
     .residual = 1e-7,
     .valley_error = 1e-5,
     .gives_multipliers = false,
     .tells_major_iterations = false},
};

std::ostream& operator<<(std::ostream& stream, const Contract& contract) { return stream << contract.label; }

/// A program that takes several iterations, with a start.
class Trial {
 public:
  explicit Trial(const Contract& contract)
      : motion_(pendulum_, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(16)),
        has_intervals_(!contract.solves_any_program),
        start_(has_intervals_ ? sample(motion_, guessed_motion(pendulum_)) : vector({-1.2, 1.0})) {}
  [[nodiscard]] NonlinearProgram& program() {
    return has_intervals_ ? static_cast<NonlinearProgram&>(motion_) : valley_;
  }
  [[nodiscard]] Eigen::VectorXd& start() { return start_; }

 private:
  tests::Pendulum pendulum_;
  Transcription motion_;
  SmallProgram valley_ = tests::rosenbrock();
  bool has_intervals_;
  Eigen::VectorXd start_;
};

class EverySolver : public testing::TestWithParam<Contract> {
 protected:
  static const Contract& contract() { return GetParam(); }
  static SolverOptions options() {
    SolverOptions options;
    options.tolerance = contract().tolerance;
    return options;
  }
  static Solution solve(NonlinearProgram& program, const Eigen::VectorXd& start,
                        const SolverOptions& options = EverySolver::options()) {
    return make_solver(contract().solver, options, contract().named)->solve(program, start);
  }
  /// NLopt counts the points that it visits.
  static int iterations(const Solution& solution) {
    return contract().tells_major_iterations ? tests::value_of(solution.major_iterations)
                                             : tests::value_of(solution.evaluations).objective;
  }
  static std::vector<KnownProgram> known_programs() {
    return contract().solves_any_program ? tests::hock_schittkowski() : std::vector<KnownProgram>();
  }
};

INSTANTIATE_TEST_SUITE_P(Contracts, EverySolver, testing::ValuesIn(contracts),
                         [](const auto& tested) { return tested.param.label; });

TEST_P(EverySolver, FindsTheKnownOptimaOfHockAndSchittkowski) {
  for (const KnownProgram& known : known_programs()) {
    SCOPED_TRACE("HS " + std::to_string(known.number));
    SmallProgram program(known.statement);
    const Solution solution = solve(program, known.start);
    EXPECT_EQ(solution.status, Status::solved) << solution.message;
    EXPECT_NEAR(solution.objective, known.objective, contract().objective_error);
    EXPECT_LT((solution.primal - known.optimum).norm(), contract().point_error);
    EXPECT_LT(tests::value_of(solution.kkt_residual), contract().residual);
    EXPECT_LT(tests::value_of(solution.constraint_violation), contract().residual);
    EXPECT_EQ(solution.multipliers_are_estimated, !contract().gives_multipliers);
    EXPECT_EQ(solution.major_iterations.value_or(0) > 0, contract().tells_major_iterations);
    EXPECT_EQ(solution.minor_iterations.has_value(), contract().tells_minor_iterations);
    if (contract().tells_minor_iterations) {
      EXPECT_GE(tests::value_of(solution.minor_iterations), tests::value_of(solution.major_iterations));
    }
  }
}

TEST_P(EverySolver, GivesMultipliersOfOurSign) {
  for (const KnownProgram& known : known_programs()) {
    // HS 7: ∇φ = (0, -1), ∂a = (0, 2√3) at the optimum, so ∇φ + λ∂a = 0 has λ = 1/(2√3).
    // HS 71: x₁x₂x₃x₄ >= 25 is active from below: more of it would cost more, so its multiplier is negative.
    const Eigen::VectorXd expected = known.number == 7    ? vector({0.5 / std::sqrt(3.0)})
                                     : known.number == 71 ? vector({-0.5522936596, 0.1614685642})
                                                          : Eigen::VectorXd();
    if (expected.size() == 0) continue;
    SmallProgram program(known.statement);
    const Solution solution = solve(program, known.start);
    ASSERT_EQ(solution.multipliers.size(), expected.size());
    EXPECT_LE((solution.multipliers - expected).lpNorm<Eigen::Infinity>(), contract().multiplier_error);
  }
}

TEST_P(EverySolver, ReportsWhatWeComputeAtItsAnswer) {
  const auto expect_computed = [](NonlinearProgram& program, const Solution& solution) {
    EXPECT_EQ(solution.status, Status::solved);
    EXPECT_EQ(solution.objective, program.objective(solution.primal));
    const KktResidual residual = kkt_residual(program, solution.primal, solution.multipliers);
    EXPECT_EQ(solution.kkt_residual, residual.stationarity);
    EXPECT_EQ(solution.constraint_violation, residual.constraint_violation);
    EXPECT_EQ(solution.message, sentence_of(solution.status));
    EXPECT_GT(solution.seconds, solution.evaluation_seconds);
    EXPECT_GT(solution.evaluation_seconds, 0.0);
  };
  Trial trial(contract());
  expect_computed(trial.program(), solve(trial.program(), trial.start()));
  for (const KnownProgram& known : known_programs()) {
    SmallProgram program(known.statement);
    expect_computed(program, solve(program, known.start));
  }
}

TEST_P(EverySolver, FollowsRosenbrocksValley) {
  if (!contract().solves_any_program) GTEST_SKIP() << "it has no interval structure";
  SmallProgram program = tests::rosenbrock();
  const Solution solution = solve(program, vector({-1.2, 1.0}));
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  EXPECT_LT((solution.primal - vector({1.0, 1.0})).norm(), contract().valley_error);
}

TEST_P(EverySolver, KeepsFixedVariablesAtTheirValues) {
  for (KnownProgram& known : known_programs()) {
    if (known.number != 71) continue;
    known.statement.variable_lower[1] = known.statement.variable_upper[1] = 4.5;
    SmallProgram program(known.statement);
    const Solution solution = solve(program, known.start);
    EXPECT_EQ(solution.status, Status::solved) << solution.message;
    EXPECT_EQ(solution.primal[1], 4.5);
    EXPECT_GT(solution.objective, known.objective);
  }
}

TEST_P(EverySolver, SaysInfeasibleWhereTheConstraintsCannotBeMet) {
  if (!contract().solves_any_program) GTEST_SKIP() << "the program has no interval structure";
  SmallProgram program = tests::equality_program(
      [](const HyperVector& x) { return x[0] * x[0] + x[1] * x[1]; },
      [](const HyperVector& x) { return HyperVector{x[0] * x[0] + x[1] * x[1]}; }, 2, vector({-1.0}));
  const Solution solution = solve(program, vector({1.0, 0.5}));
  EXPECT_NE(std::ranges::find(contract().infeasible, solution.status), contract().infeasible.end())
      << name_of(solution.status);
  EXPECT_NEAR(tests::value_of(solution.constraint_violation), 1.0, contract().violation_error);
}

TEST_P(EverySolver, StopsAtTheIterationLimitWithItsLastPoint) {
  Trial trial(contract());
  SolverOptions limited = options();
  limited.most_iterations = contract().most_iterations;
  const Solution solution = solve(trial.program(), trial.start(), limited);
  EXPECT_EQ(solution.status, Status::iteration_limit);
  EXPECT_EQ(solution.message, sentence_of(Status::iteration_limit));
  EXPECT_EQ(iterations(solution), contract().most_iterations);
  ASSERT_EQ(solution.primal.size(), trial.start().size());
  // NLopt's best point may be the start.
  EXPECT_TRUE(!contract().tells_major_iterations || solution.primal != trial.start());
  EXPECT_GT(tests::value_of(solution.kkt_residual), contract().solves_any_program ? 1e-3 : contract().tolerance);
}

TEST_P(EverySolver, StopsAtTheTimeLimitByTheClockOnTheWall) {
  // Time passes while the processor is idle.
  Trial trial(contract());
  SolverOptions limited = options();
  limited.most_seconds = 1e-3;
  limited.stop_requested = [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return false;
  };
  const Solution solution = solve(trial.program(), trial.start(), limited);
  EXPECT_EQ(solution.status, Status::time_limit);
  EXPECT_EQ(solution.primal.size(), trial.start().size());
}

TEST_P(EverySolver, StopsWithTheTimeOfItsScope) {
  Trial trial(contract());
  const StopScope scope(nullptr, 1e-9);
  const Solution solution = solve(trial.program(), trial.start());
  EXPECT_EQ(solution.status, Status::time_limit);
  EXPECT_EQ(solution.primal.size(), trial.start().size());
}

TEST_P(EverySolver, StopsWhenAskedTo) {
  Trial trial(contract());
  SolverOptions stopped = options();
  int asked = 0;
  stopped.stop_requested = [&] { return ++asked == contract().stopping_question; };
  const Solution solution = solve(trial.program(), trial.start(), stopped);
  EXPECT_EQ(solution.status, Status::interrupted);
  EXPECT_EQ(asked, contract().stopping_question);
  if (contract().tells_minor_iterations) return;  // sqp is asked in each of them
  EXPECT_EQ(iterations(solution), contract().stopping_question - 1);
}

TEST_P(EverySolver, SaysEvaluationFailedWhereTheStartIsNotANumber) {
  Trial trial(contract());
  trial.start()[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(solve(trial.program(), trial.start()).status, Status::evaluation_failed);
}

TEST_P(EverySolver, SaysEvaluationFailedWhereTheObjectiveOrAConstraintIsNotANumber) {
  if (!contract().solves_any_program) GTEST_SKIP() << "the programs have no interval structure";
  SmallProgram objective =
      tests::equality_program([](const HyperVector& x) { return log(x[0]); },
                              [](const HyperVector& x) { return HyperVector{x[0]}; }, 1, vector({2.0}));
  EXPECT_EQ(solve(objective, vector({-1.0})).status, Status::evaluation_failed);
  SmallProgram constraint =
      tests::equality_program([](const HyperVector& x) { return x[0] * x[0] + x[1]; },
                              [](const HyperVector& x) { return HyperVector{sqrt(x[0])}; }, 2, vector({2.0}));
  EXPECT_EQ(solve(constraint, vector({-1.0, 0.0})).status, Status::evaluation_failed);
}

/// Counts its evaluations. Values are right; one kind of derivative may be no number.
class WatchedProgram final : public SmallProgram {
 public:
  enum class Broken { nothing, gradient, jacobian, hessian };
  WatchedProgram(SmallProgram::Statement statement, Broken broken)
      : SmallProgram(std::move(statement)), broken_(broken) {}

  [[nodiscard]] const EvaluationCounts& calls() const { return calls_; }

  [[nodiscard]] double objective(const VectorIn& x) override {
    ++calls_.objective;
    return SmallProgram::objective(x);
  }
  void gradient(const VectorIn& x, VectorOut result) override {
    ++calls_.gradient;
    SmallProgram::gradient(x, result);
    spoil(Broken::gradient, result);
  }
  void constraints(const VectorIn& x, VectorOut result) override {
    ++calls_.constraints;
    SmallProgram::constraints(x, result);
  }
  void jacobian(const VectorIn& x, VectorOut values) override {
    ++calls_.jacobian;
    SmallProgram::jacobian(x, values);
    spoil(Broken::jacobian, values);
  }
  void hessian(const VectorIn& x, double factor, const VectorIn& multipliers, VectorOut values) override {
    ++calls_.hessian;
    SmallProgram::hessian(x, factor, multipliers, values);
    spoil(Broken::hessian, values);
  }

 private:
  void spoil(Broken kind, VectorOut values) const {
    if (kind == broken_) values[0] = std::numeric_limits<double>::quiet_NaN();
  }
  Broken broken_;
  EvaluationCounts calls_;
};

TEST_P(EverySolver, NeverSaysSolvedWhereADerivativeIsNotANumber) {
  using Broken = WatchedProgram::Broken;
  for (const KnownProgram& known : known_programs()) {
    if (known.number != 71) continue;
    for (const Broken broken : {Broken::gradient, Broken::jacobian, Broken::hessian}) {
      SCOPED_TRACE(static_cast<int>(broken));
      WatchedProgram program(known.statement, broken);
      const Solution solution = solve(program, known.start);
      if (program.calls().hessian == 0 && broken == Broken::hessian) continue;  // it has none
      EXPECT_FALSE(is_solved(solution.status));
      if (contract().checks_derivatives) {
        EXPECT_EQ(solution.status, Status::evaluation_failed) << solution.message;
      }
    }
  }
}

/// `evaluations` are the calls that the program sees, but for those by which the answer is judged.
TEST_P(EverySolver, IsCountedByWhatTheProgramSees) {
  for (const KnownProgram& known : known_programs()) {
    WatchedProgram program(known.statement, WatchedProgram::Broken::nothing);
    const Solution solution = solve(program, known.start);
    const EvaluationCounts counts = tests::value_of(solution.evaluations);
    const EvaluationCounts& calls = program.calls();
    WatchedProgram judged(known.statement, WatchedProgram::Broken::nothing);
    Solution again = solution;
    again.status = Status::solved;
    Confirmation confirmation(judged);
    confirmation.judge(contract().tolerance, again);
    EXPECT_TRUE(confirmation.scaling(contract().tolerance, known.start, again).is_one());
    EXPECT_EQ(counts.hessian + judged.calls().hessian, calls.hessian);
    EXPECT_GT(counts.objective, 0);
    EXPECT_GT(counts.jacobian, 0);
    EXPECT_LT(counts.objective, calls.objective);
    if (contract().solver == "ipopt" || contract().solver == "auto" ||
        contract().solver == "interior_point") {  // the others judge on the way too
      EXPECT_EQ(counts.total() + judged.calls().total(), calls.total());
    }
  }
}

TEST_P(EverySolver, RefusesAStartOfTheWrongSize) {
  SmallProgram program = tests::rosenbrock();
  EXPECT_EQ(tests::sentence_of_error([&] { static_cast<void>(solve(program, everywhere(3, 0.0))); }),
            "the start has 3 entries, but the program has 2 variables");
}

}  // namespace
}  // namespace dmocbench
