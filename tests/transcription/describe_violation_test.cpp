// A solve that failed says which function, interval and quantity its point misses most.
#include "methods/transcription/describe_violation.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "methods/judgement/kkt_residual.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::all_between;
using tests::Restated;
using tests::says;
using tests::Scheme;
using Statement = Restated::Statement;

constexpr Eigen::Index violation_intervals = 12;

/// A point that a solver is said to have ended at.
struct Ended {
  explicit Ended(const Problem& stated, const Scheme& scheme, Status status = Status::iteration_limit)
      : problem(stated), transcription(tests::transcribe(stated, scheme, Grid::uniform(violation_intervals))) {
    solution.status = status;
    solution.primal = sample(*transcription, guessed_motion(stated));
  }
  std::string words() { return describe_violation(problem, *transcription, solution, 1e-8); }
  double& control(Eigen::Index i, Eigen::Index interval) {
    return solution.primal[transcription->blocks().unknown(Quantity::control, 0).index(i) + interval];
  }

  const Problem& problem;
  std::unique_ptr<Transcription> transcription;
  Solution solution;
};

class ViolationInWords : public testing::TestWithParam<Scheme> {};

TEST_P(ViolationInWords, NamesTheEquationAndTheIntervalWhereAControlWasSpoilt) {
  const tests::MovingFrame problem;
  Ended ended(problem, GetParam());
  ended.solution.primal =
      tests::solve(problem, GetParam(), Grid::uniform(violation_intervals), guessed_motion(problem)).solution.primal;
  EXPECT_EQ(ended.words(), "");
  ended.control(1, 5) += 1.0;  // u_1 acts on q_1 alone
  const std::string words = ended.words();
  EXPECT_FALSE(says(words, "hold")) << words;  // nothing is bounded
  EXPECT_PRED2(says, words, "lagrangian and force: the Euler-Lagrange equation of q[1] (q2) ");
  const bool is_here =
      says(words, "in interval 5 (t = 0.625 to 0.75)") || says(words, "between intervals 4 and 5 (t = 0.625)") ||
      says(words, "between intervals 5 and 6 (t = 0.75)");  // DMOC's equations of the nodes lie between intervals
  EXPECT_TRUE(is_here) << words;
}

TEST_P(ViolationInWords, UnreachableFinalStateIsNamedWithTheBoundsThatHold) {
  const tests::Pendulum reachable;
  const Restated problem(reachable, [](Statement& s) { s.u = all_between(1, -0.5, 0.5); });
  Ended ended(problem, GetParam());
  ended.solution = make_solver("ipopt")->solve(*ended.transcription, ended.solution.primal);
  ASSERT_EQ(ended.solution.status, Status::infeasible) << ended.solution.message;
  // At the point of least squares some controls are inside their bounds; here all are held.
  const Eigen::VectorXd& lower = ended.transcription->variable_lower();
  const Eigen::VectorXd& upper = ended.transcription->variable_upper();
  for (Eigen::Index j = 0; j < lower.size(); ++j) {
    double& x = ended.solution.primal[j];
    if (std::isfinite(lower[j]) && std::isfinite(upper[j])) x = x - lower[j] < upper[j] - x ? lower[j] : upper[j];
  }
  const std::string words = ended.words();
  EXPECT_PRED2(says, words, "The largest violation is ");
  EXPECT_PRED2(says, words, " of q[0] (q1) ");
  EXPECT_PRED2(says, words, "(t = ");
  EXPECT_PRED2(says, words, "bounds().u is active for u[0] (u1) at ");
  EXPECT_PRED2(says, words,
               "The solver found no trajectory near its last point that satisfies final_state within the bounds");
  const std::string before = "The largest violation is ";
  const double amount = std::stod(words.substr(words.find(before) + before.size()));
  EXPECT_NEAR(amount, constraint_violation(*ended.transcription, ended.solution.primal), 0.01 * amount);
}

TEST_P(ViolationInWords, NamesWhatIsPrescribedOfTheMotion) {
  const tests::MovingFrame base;
  const Restated path(base, [](Statement& s) {
    s.path_constraints = [](const ControlledState& x) {
      ExpressionVector h(2);
      h << Expression(1.0) + x.q[0] * x.q[0], x.q[0] - 100.0 * (1.0 + x.t) + 1e-9 * x.u[0];  // of ends nothing is known
      return h;
    };
  });
  EXPECT_PRED2(says, Ended(path, GetParam()).words(), ", in path_constraints[1] in interval 11 (");

  const Restated velocity(base, [](Statement& s) {
    s.v = Bounds{Eigen::Vector2d(-tests::infinity, 100.0), Eigen::Vector2d(tests::infinity, 200.0)};
    s.first.free_velocity(1);
    s.last.free_velocity(1);
  });
  EXPECT_PRED2(says, Ended(velocity, GetParam()).words(), "bounds().v: the velocity of q[1] (q2) in interval ");

  const Restated conditions(base, [](Statement& s) {
    s.last = tests::free_end(2);
    s.conditions = [](const State&, const State& last) {
      ExpressionVector r(3);
      r << last.q[0] - 0.7, last.q[1] - 1e4, last.v[0];
      return r;
    };
  });
  EXPECT_PRED2(says, Ended(conditions, GetParam()).words(), ", in boundary_conditions[1].");

  const Restated bounded(base, [](Statement& s) {
    s.u = Bounds{Eigen::Vector2d(-tests::infinity, 1e6), Eigen::Vector2d(tests::infinity, 2e6)};
  });
  Ended pushed(bounded, GetParam());
  pushed.control(1, 3) = -1e6;
  EXPECT_PRED2(says, pushed.words(), "bounds().u: u[1] (u2) in interval 3 (");
}

TEST_P(ViolationInWords, HasWordsForEveryRowAndUnknownThatSayWhereItBelongs) {
  const tests::Everything everything;
  const Problem& problem = everything.problem();
  Ended ended(problem, GetParam());
  const auto place_in_words = [](const Place& place) -> std::string {
    const bool is_last = place.index == violation_intervals;
    if (place.kind == Place::Kind::border) return "";
    if (place.kind == Place::Kind::interval || place.index == 0 || is_last) {
      return " in interval " + std::to_string(is_last ? place.index - 1 : place.index) + " (t = ";
    }
    return " between intervals " + std::to_string(place.index - 1) + " and " + std::to_string(place.index) + " (t = ";
  };
  const IntervalStructure& structure = *ended.transcription->interval_structure();
  std::set<std::string> all;
  for (std::size_t i = 0; i < structure.rows.size(); ++i) {
    const std::string words = describe_constraint(problem, *ended.transcription, ended.solution.primal, i);
    EXPECT_PRED2(says, words, place_in_words(structure.rows[i]));
    all.insert(words);
  }
  for (const char* kind : {"the Euler-Lagrange equation of q[1] (q2)", "bounds().v: the velocity of q[1] (q2)",
                           "path_constraints[0]", "path_constraints[1]", "boundary_conditions[0]"}) {
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const std::string& words) { return says(words, kind); }))
        << kind;
  }
  for (std::size_t i = 0; i < structure.unknowns.size(); ++i) {
    const std::string words = describe_unknown(problem, *ended.transcription, ended.solution.primal, i);
    EXPECT_PRED2(says, words, place_in_words(structure.unknowns[i]));
  }
}

TEST_P(ViolationInWords, NamesTheFormulaThatIsNotANumberAndTheInterval) {
  const tests::DoubleIntegrator base;
  const Restated problem(base, [](Statement& s) {
    s.running_cost = [](const ControlledState& x) { return pow(x.u[0] + 1.0, 1.5) + x.u[0] * x.u[0]; };
  });
  Ended ended(problem, GetParam(), Status::evaluation_failed);
  ended.control(0, 7) = -1.0;
  EXPECT_PRED2(says, ended.words(), "a second derivative of running_cost is not a number in interval 7 (t = 0.");
  ended.control(0, 3) = -2.0;
  EXPECT_PRED2(says, ended.words(), "At the last point, running_cost is not a number in interval 3 (t = 0.");
}

/// Below q = -1/2 the Lagrangian has slopes, but no value.
class WithALogarithm final : public tests::SmallProblem {
 public:
  WithALogarithm() : SmallProblem("with_a_logarithm", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v[0] * x.v[0] + 0.01 * log(x.q[0] + 0.5);
  }
};

/// No row of any method contains L itself, so that a solver fails there for another reason.
TEST_P(ViolationInWords, NamesALagrangianThatIsNotANumberWhereverASolveEnds) {
  const WithALogarithm problem;
  for (const Status status : {Status::iteration_limit, Status::step_failed, Status::infeasible, Status::diverged}) {
    Ended ended(problem, GetParam(), status);
    EXPECT_FALSE(says(ended.words(), "not a number")) << ended.words();
    const auto q = ended.transcription->blocks().unknown(Quantity::configuration).index(0);
    ended.solution.primal.segment(q + 4, 3).setConstant(-2.0);
    EXPECT_PRED2(says, ended.words(), "At the last point, lagrangian is not a number in interval ");
    EXPECT_PRED2(says, ended.words(), "The largest violation is ");
  }
}

/// Two constraints and a condition with names; its control is in the cost alone.
class Idle final : public tests::SmallProblem {
 public:
  Idle() : SmallProblem("idle", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1) {}
  [[nodiscard]] ProblemCard card() const override {
    return {.path_constraint_names = {"floor", "ceiling"}, .boundary_condition_names = {"gate"}};
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return one(-x.v[0]); }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return ExpressionVector{{x.q[0] + 1.0, 4000.0 * pow(x.t - 0.5, 2.0) - 500.0 - x.q[0]}};  // the ends keep to it
  }
  [[nodiscard]] ExpressionVector boundary_conditions(const State& first, const State& /*last*/) const override {
    return one(first.q[0]);
  }
};

TEST_P(ViolationInWords, TellsTheNamesOfConstraintsAndThatNoForceReadsAControl) {
  const Idle problem;
  Ended ended(problem, GetParam());
  EXPECT_PRED2(says, ended.words(), "path_constraints[1] (ceiling) in interval ");
  EXPECT_PRED2(says, ended.words(), "The force does not depend on any control");
  const auto last = static_cast<std::size_t>(ended.transcription->constraint_count()) - 1;
  EXPECT_EQ(describe_constraint(problem, *ended.transcription, ended.solution.primal, last),
            "boundary_conditions[0] (gate)");
}

/// A mass pushed by a force that grows at a rate, which grows at the rate of the control; its end is out of reach.
class ByWayOfTwoRates final : public tests::SmallProblem {
 public:
  explicit ByWayOfTwoRates(bool is_linked)
      : SmallProblem("by_way_of_two_rates", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1), is_linked_(is_linked) {}
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"push", "rate"}; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    return ExpressionVector{{is_linked_ ? x.y[1] : -x.y[0], x.u[0]}};
  }
  [[nodiscard]] BoundaryState initial_state() const override { return with_rest(SmallProblem::initial_state()); }
  [[nodiscard]] BoundaryState final_state() const override { return with_rest(SmallProblem::final_state()); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return one(x.y[0]); }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }

 private:
  static BoundaryState with_rest(BoundaryState end) {
    end.y = Eigen::VectorXd::Zero(2);
    return end;
  }
  bool is_linked_;
};

TEST_P(ViolationInWords, FollowsControlsThroughFirstOrderStates) {
  const ByWayOfTwoRates steered(true);
  EXPECT_EQ(Ended(steered, GetParam()).words().find("no control can steer"), std::string::npos);
  const ByWayOfTwoRates idle(false);
  EXPECT_PRED2(says, Ended(idle, GetParam()).words(), "directly or through a first-order state");
}

/// A pendulum without a control from 0 to 1, whose velocities at the ends are free: a boundary value problem.
class WithoutControl final : public tests::SmallProblem {
 public:
  WithoutControl() : SmallProblem("without_control", at(0.0, 0.0), at(1.0, 0.0), 1.0, 0) {}
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = SmallProblem::bounds();
    bounds.first.free_velocity(0);
    bounds.last.free_velocity(0);
    return bounds;
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0] - cos(x.q[0]); }
  [[nodiscard]] ExpressionVector force(const ControlledState& /*x*/) const override { return one(0.0); }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.v[0] * x.v[0]; }
};

TEST_P(ViolationInWords, SaysWhereAProblemHasNoFreedom) {
  const WithoutControl problem;
  EXPECT_PRED2(says, Ended(problem, GetParam()).words(), "The problem has no degree of freedom: ");
  const tests::Pendulum pendulum;
  EXPECT_FALSE(says(Ended(pendulum, GetParam()).words(), "no degree of freedom"));
}

/// Its cost falls without end as the control grows.
class Endless final : public tests::SmallProblem {
 public:
  Endless() : SmallProblem("endless", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1) {}
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return -x.u[0] * x.u[0]; }
};

/// The oscillator q = cos 2t swings to -1 and back in T = 3.14, without a control to hold it.
TEST_P(ViolationInWords, NamesTheBoundOnTheMotionThatIsInTheWayAndNoFreeFinalState) {
  const tests::HarmonicOscillator base(3.14);
  const Restated walled(base, [](Statement& s) {
    s.q = Bounds{Eigen::VectorXd::Constant(1, -0.2), Eigen::VectorXd::Constant(1, tests::infinity)};
    s.u = all_between(1, -1e-3, 1e-3);
    s.last = tests::free_end(1);
  });
  Ended ended(walled, GetParam(), Status::infeasible);
  ended.solution = make_solver("ipopt")->solve(*ended.transcription, ended.solution.primal);
  ASSERT_EQ(ended.solution.status, Status::infeasible) << ended.solution.message;
  const std::string words = ended.words();
  EXPECT_PRED2(says, words, " The lower bound -0.2 of bounds().q: q[0] (q1)");
  EXPECT_FALSE(says(words, "final_state")) << words;
}

TEST_P(ViolationInWords, NamesAConditionWhoseDerivativesVanishWhereTheSolveEndedIfItHoldsThere) {
  const tests::Pendulum base;
  for (const double constant : {1.0, 2.0}) {  // with 2 it is at least 1
    const Restated conditioned(base, [=](Statement& s) {
      s.last.free_configuration(0);
      s.conditions = [=](const State& /*first*/, const State& last) {
        return ExpressionVector::Constant(1, constant - cos(last.q[0] - 1.0));
      };
    });
    Ended ended(conditioned, GetParam(), Status::step_failed);
    EXPECT_FALSE(says(ended.words(), "rank deficient")) << ended.words();  // the guess ends at pi
    const auto q = ended.transcription->blocks().unknown(Quantity::configuration).index(0);
    ended.solution.primal[q + violation_intervals] = 1.0;
    EXPECT_EQ(says(ended.words(), "boundary_conditions[0] is rank deficient: its derivatives vanish at node 12"),
              constant == 1.0)
        << ended.words();
  }
}

/// Two equations that say the same of the end, and differ by a constant from what both can meet.
TEST_P(ViolationInWords, NamesConstraintsThatDependOnEachOther) {
  const tests::Pendulum base;
  const Restated conditioned(base, [](Statement& s) {
    s.last.free_configuration(0);
    s.conditions = [](const State& /*first*/, const State& last) -> ExpressionVector {
      return ExpressionVector{{last.q[0] - 1.0, exp(last.q[0]) - 3.0}};
    };
  });
  Ended ended(conditioned, GetParam(), Status::step_failed);
  EXPECT_PRED2(says, ended.words(), "depend on each other");
  EXPECT_PRED2(says, ended.words(), "boundary_conditions[0]");
  EXPECT_PRED2(says, ended.words(), "boundary_conditions[1]");
}

TEST_P(ViolationInWords, NamesNoDependenceOfIndependentConstraints) {
  const tests::MovingFrame problem;
  Ended ended(problem, GetParam(), Status::step_failed);
  EXPECT_FALSE(says(ended.words(), "depend on each other")) << ended.words();
}

TEST_P(ViolationInWords, TellsThatACostMayHaveNoLowerBound) {
  const Endless problem;
  Ended ended(problem, GetParam());
  EXPECT_FALSE(says(ended.words(), "lower bound")) << ended.words();
  for (Eigen::Index k = 0; k < violation_intervals; ++k) ended.control(0, k) = 1e5;
  EXPECT_PRED2(says, ended.words(), "running_cost or final_cost may have no lower bound.");
}

TEST_P(ViolationInWords, NamesWhatIsNotANumber) {
  const tests::MovingFrame problem;
  Ended ended(problem, GetParam(), Status::evaluation_failed);
  ended.control(1, 7) = std::nan("");
  EXPECT_PRED2(says, ended.words(), "u[1] (u2) in interval 7 (t = 0.875 to 1) is not a number.");
}

TEST_P(ViolationInWords, HasNothingToSayOfASolvedProgramOrWithoutAPoint) {
  const tests::MovingFrame problem;
  Ended solved(problem, GetParam(), Status::solved);
  EXPECT_EQ(solved.words(), "");
  Ended without(problem, GetParam(), Status::too_large);
  without.solution.primal.resize(0);
  EXPECT_EQ(without.words(), "");
}

INSTANTIATE_TEST_SUITE_P(Schemes, ViolationInWords, testing::ValuesIn(tests::all_schemes(2)), tests::by_label);

}  // namespace
}  // namespace dmocbench
