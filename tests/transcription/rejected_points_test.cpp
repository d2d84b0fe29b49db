// An integration that leaves the domain of a formula is a trial point that solvers reject, not the end of a solve.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "methods/transcription/describe_violation.hpp"
#include "methods/transcription/single_shooting.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

/// A particle that comes in fast towards a wall at q = ½, where force and cost tend to infinity; behind the wall they
/// are no numbers. Without the wall the least control would take it to q = 1.5.
class BesideAWall final : public tests::SmallProblem {
 public:
  explicit BesideAWall(bool brakes)
      : SmallProblem("beside_a_wall", at(0.0, 10.0), at(0.0, 0.0), 1.0, 1), brakes_(brakes) {}
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return one(x.u[0] + 0.1 * log(0.5 - x.q[0]));
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * x.u[0] * x.u[0] + 5.0 / sqrt(0.5 - x.q[0]);
  }
  /// A hard brake within the first of 16 intervals, then rest at q = 0.3; or this motion without its control.
  [[nodiscard]] MotionPoint guess(double t) const override {
    constexpr double brake = 160.0;
    const double time = std::min(t, 1.0 / 16.0);
    return {.q = Eigen::VectorXd::Constant(1, 10.0 * time - 0.5 * brake * time * time),
            .v = Eigen::VectorXd::Constant(1, 10.0 - brake * time),
            .u = Eigen::VectorXd::Constant(1, brakes_ && t < 1.0 / 16.0 ? -brake : 0.0)};
  }

 private:
  bool brakes_;
};

/// A program that counts the points at which a value is not a number.
class WatchedProgram final : public NonlinearProgram {
 public:
  explicit WatchedProgram(NonlinearProgram& program) : program_(program) {}
  [[nodiscard]] int rejected() const noexcept { return rejected_; }

  [[nodiscard]] std::size_t variable_count() const override { return program_.variable_count(); }
  [[nodiscard]] std::size_t constraint_count() const override { return program_.constraint_count(); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return program_.variable_lower(); }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return program_.variable_upper(); }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return program_.constraint_lower(); }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return program_.constraint_upper(); }
  [[nodiscard]] const BlockPattern& jacobian_structure() const override { return program_.jacobian_structure(); }
  [[nodiscard]] const BlockPattern& hessian_structure() const override { return program_.hessian_structure(); }
  [[nodiscard]] const RoundingFloors& rounding_floors() const override { return program_.rounding_floors(); }
  [[nodiscard]] const IntervalStructure* interval_structure() const override { return program_.interval_structure(); }
  [[nodiscard]] double objective(const VectorIn& x) override { return program_.objective(x); }
  void gradient(const VectorIn& x, VectorOut result) override { program_.gradient(x, result); }
  void constraints(const VectorIn& x, VectorOut result) override {
    program_.constraints(x, result);
    if (!result.allFinite()) ++rejected_;
  }
  void jacobian(const VectorIn& x, VectorOut values) override { program_.jacobian(x, values); }
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override {
    program_.hessian(x, objective_factor, multipliers, values);
  }

 private:
  NonlinearProgram& program_;
  int rejected_ = 0;
};

/// A method of shooting by a solver.
struct Shot {
  const char* method;
  const char* solver;
};

class RejectedPoints : public testing::TestWithParam<Shot> {
 protected:
  /// The solution in the unknowns of multiple shooting, from the guess; `rejected` counts the points on the way.
  static Solution solved(const Problem& problem, Transcription& program, int& rejected) {
    SolverOptions options;
    options.tolerance = 1e-8;
    const bool is_single = std::string(GetParam().method).starts_with("single");
    NamedOptions named;
    if (is_single && GetParam().solver == std::string("interior_point")) named["factorisation"] = "sparse";
    const auto solver = make_solver(GetParam().solver, options, named);
    const Eigen::VectorXd start = sample(program, guessed_motion(problem));
    if (!is_single) {
      WatchedProgram watched(program);
      Solution solution = solver->solve(watched, start);
      rejected = watched.rejected();
      return solution;
    }
    SingleShooting condensed(program);
    WatchedProgram watched(condensed);
    Solution solution = condensed.expanded(solver->solve(watched, condensed.reduced(start)));
    rejected = watched.rejected();
    return solution;
  }
  static std::unique_ptr<Transcription> program_of(const Problem& problem) {
    return tests::transcribe(problem, tests::Scheme{GetParam().method, 1}, Grid::uniform(16));
  }
};

TEST_P(RejectedPoints, AreMetOnTheWayAndEndNoSolve) {
  const BesideAWall problem(true);
  const auto program = program_of(problem);
  int rejected = 0;
  const Solution solution = solved(problem, *program, rejected);
  ASSERT_TRUE(is_solved(solution.status)) << solution.message;
  EXPECT_GT(rejected, 0);
  EXPECT_LT(solution.primal.head(17).maxCoeff(), 0.5);
}

TEST_P(RejectedPoints, AreAnEvaluationThatFailedWhereTheyAreTheStart) {
  const BesideAWall problem(false);
  const auto program = program_of(problem);
  int rejected = 0;
  const Solution solution = solved(problem, *program, rejected);
  EXPECT_EQ(solution.status, Status::evaluation_failed);
  const std::string words = describe_violation(problem, *program, solution, 1e-6);
  EXPECT_NE(words.find("in interval"), std::string::npos) << words;
  EXPECT_NE(words.find("not a number"), std::string::npos) << words;
}

INSTANTIATE_TEST_SUITE_P(All, RejectedPoints,
                         testing::Values(Shot{"multiple_shooting_rk4_1", "ipopt"},
                                         Shot{"multiple_shooting_rk4_1", "nlopt"},
                                         Shot{"multiple_shooting_rk4_1", "interior_point"},
                                         Shot{"single_shooting_rk4_1", "ipopt"}, Shot{"single_shooting_rk4_1", "nlopt"},
                                         Shot{"single_shooting_rk4_1", "interior_point"}));

}  // namespace
}  // namespace dmocbench
