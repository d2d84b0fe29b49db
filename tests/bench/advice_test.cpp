#include "bench/run/advice.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "methods/choose.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "tests/support/problems_for_tests.hpp"

namespace dmocbench {
namespace {

/// A mass on a line from 0 to `distance`, with a unit.
class Moved final : public tests::SmallProblem {
 public:
  Moved(double distance, std::string unit)
      : SmallProblem("moved", at(0.0, 0.0), at(distance, 0.0), 1.0, 1), unit_(std::move(unit)) {}
  [[nodiscard]] ProblemCard card() const override { return {.configuration_units = {unit_}}; }

 private:
  std::string unit_;
};

/// A point of a plane from 0 to (x, y).
class MovedInPlane final : public tests::SmallProblem {
 public:
  MovedInPlane(double x, double y)
      : SmallProblem("moved_in_plane", BoundaryState::at_rest(Eigen::Vector2d::Zero()),
                     BoundaryState::at_rest(Eigen::Vector2d(x, y)), 1.0, 2) {}
  [[nodiscard]] ProblemCard card() const override { return {.configuration_units = {"m", "m"}}; }
};

std::string advice(std::shared_ptr<const Problem> problem, Status status, const std::string& solver,
                   const std::string& start = "guess") {
  SolvedCase solved;
  solved.the_case.problem = std::move(problem);
  solved.the_case.solver = solver;
  solved.solution.status = status;
  return in_words(next_to_try(solved, start));
}

bool names(const std::string& sentence, const std::string& word) { return sentence.find(word) != std::string::npos; }

TEST(Advice, SuspectsDegreesWhereAnAngleTurnsByAMultipleOf15) {
  EXPECT_TRUE(names(advice(std::make_shared<Moved>(180.0, "rad"), Status::iteration_limit, "auto"), "degrees"));
  EXPECT_FALSE(names(advice(std::make_shared<Moved>(180.0, "m"), Status::iteration_limit, "auto"), "degrees"));
  EXPECT_FALSE(names(advice(std::make_shared<Moved>(3.14, "rad"), Status::iteration_limit, "auto"), "degrees"));
}

/// A pendulum, whose unit is not stated, that turns by an angle.
class Turned final : public tests::SmallProblem {
 public:
  explicit Turned(double angle) : SmallProblem("turned", at(0.0, 0.0), at(angle, 0.0), 1.0, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0] + cos(x.q[0]); }
};

TEST(Advice, DoubtsTheUnitOfASolvedProblemOnlyWhereTheCoordinateIsAnAngle) {
  EXPECT_TRUE(names(in_words(doubt_about_units(Turned(180.0))), "degrees"));
  EXPECT_EQ(in_words(doubt_about_units(Turned(3.14))), "");
  EXPECT_TRUE(names(in_words(doubt_about_units(Moved(180.0, "rad"))), "degrees"));
  EXPECT_EQ(in_words(doubt_about_units(Moved(180.0, ""))), "");
  EXPECT_EQ(in_words(doubt_about_units(Moved(180.0, "deg"))), "");
}

TEST(Advice, NamesBoundsWhereAFormulaIsNotANumber) {
  EXPECT_TRUE(names(advice(std::make_shared<Moved>(180.0, "rad"), Status::evaluation_failed, "auto"), "bounds"));
}

TEST(Advice, NamesBoundsWhereASolveWanderedOffToAFormulaThatIsNotANumber) {
  SolvedCase solved;
  solved.the_case.problem = std::make_shared<Moved>(1.0, "m");
  solved.the_case.solver = "auto";
  solved.solution.status = Status::step_failed;
  EXPECT_FALSE(names(in_words(next_to_try(solved, "guess")), "bounds"));
  solved.solution.formula_undefined = true;
  EXPECT_TRUE(names(in_words(next_to_try(solved, "guess")), "bounds"));
}

TEST(Advice, NamesUnitsThatAreTenThousandTimesApart) {
  const std::string apart = advice(std::make_shared<MovedInPlane>(4e5, 0.3), Status::step_failed, "ipopt");
  EXPECT_TRUE(names(apart, "units") && names(apart, "q1") && names(apart, "q2")) << apart;
  EXPECT_FALSE(names(advice(std::make_shared<MovedInPlane>(4e2, 0.3), Status::step_failed, "ipopt"), "units"));
}

TEST(Advice, OffersAHorizonThenASolverThenAStartThenAGuess) {
  const auto problem = std::make_shared<Moved>(1.0, "m");
  EXPECT_TRUE(names(advice(problem, Status::infeasible, "auto"), "longer horizon"));
  EXPECT_TRUE(names(advice(problem, Status::iteration_limit, "ipopt"), "--solver auto"));
  EXPECT_TRUE(names(advice(problem, Status::iteration_limit, "auto"), "--start common"));
  EXPECT_TRUE(names(advice(problem, Status::iteration_limit, "auto", "common"), "guess"));
}

TEST(Advice, OffersLongerPhasesWhereTheHorizonIsARelativeTime) {
  const auto moved = std::make_shared<Moved>(1.0, "m");
  const auto phases = std::make_shared<PhasedProblem>(std::vector<PhasedProblem::Phase>{{"there", moved}});
  EXPECT_EQ(advice(phases, Status::infeasible, "auto"),
            "Try longer phases, or wider bounds: the ends may be out of reach.");
}

TEST(Advice, IsGivenForFailuresOnly) {
  for (const Status status : {Status::solved, Status::control_not_determined, Status::too_coarse, Status::interrupted})
    EXPECT_EQ(advice(std::make_shared<Moved>(1.0, "m"), status, "ipopt"), "");
}

TEST(Advice, NamesNoOtherStartWhereANewtonStepHardlyMovesTheAnswer) {
  SolvedCase solved;
  solved.the_case.problem = std::make_shared<Moved>(1.0, "m");
  solved.the_case.solver = "auto";
  solved.solution.status = Status::not_confirmed;
  solved.solution.correction = 1e-12;
  EXPECT_EQ(in_words(next_to_try(solved, "guess")), "");
  solved.solution.correction = 1e-2;
  EXPECT_TRUE(names(in_words(next_to_try(solved, "guess")), "--start common"));
}

TEST(Advice, ForASolvedMotionWhoseReplayEndsElsewhereDependsOnWhetherItsJumpsExplainIt) {
  SolvedCase solved;
  solved.the_case.problem = std::make_shared<Moved>(1.0, "m");
  solved.solution.status = Status::solved;
  solved.trajectory.emplace();
  solved.trajectory->q = Eigen::VectorXd::LinSpaced(11, 0.0, 1.0);
  solved.accuracy = Accuracy{.relative_jump = 1e-2};
  ReplayError replay{.q = Eigen::VectorXd::Constant(1, -0.3), .v = Eigen::VectorXd::Zero(1)};
  const Advice coarse = doubt_about_replay(solved, replay);
  EXPECT_EQ(coarse.remedy, Remedy::finer_grid);
  EXPECT_EQ(coarse.coordinate, "q1");
  EXPECT_DOUBLE_EQ(coarse.size, 0.3);
  EXPECT_TRUE(names(in_words(coarse), "--accuracy"));
  solved.accuracy->relative_jump = 1e-6;
  EXPECT_EQ(doubt_about_replay(solved, replay).remedy, Remedy::feedback);
  EXPECT_TRUE(names(in_words(doubt_about_replay(solved, replay)), "unstable"));
  solved.solution.status = Status::too_coarse;
  EXPECT_EQ(doubt_about_replay(solved, replay).remedy, Remedy::none);
  solved.solution.status = Status::solved;
  replay.q[0] = 0.05;
  EXPECT_EQ(doubt_about_replay(solved, replay).remedy, Remedy::none);
}

TEST(LikelyMeant, IsTheNameWithFewestLettersChangedAndNoneThatIsFar) {
  const std::vector<std::string> names{"hamiltonian", "tangent", "dmoc"};
  EXPECT_EQ(likely_meant("hamiltonain", names), "hamiltonian");
  EXPECT_EQ(likely_meant("tangnet", names), "tangent");
  EXPECT_EQ(likely_meant("dmco", names), "dmoc");
  EXPECT_EQ(likely_meant("DMOC", names), "dmoc");
  EXPECT_EQ(likely_meant("collocation", names), "");
  EXPECT_EQ(likely_meant("x", names), "");
}

}  // namespace
}  // namespace dmocbench
