#include "bench/run/start_provider.hpp"

#include <gtest/gtest.h>

#include "bench/run/interrupt.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/mechanics/embedded_problem.hpp"
#include "problems/spherical_pendulum_cartesian.hpp"
#include "tests/robustness/chain_on_cart.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

class StartProviders : public testing::Test {
 protected:
  StartProviders() {
    out_of_reach_ = std::make_shared<tests::Restated>(
        base_, [](tests::Restated::Statement& s) { s.u = tests::all_between(1, -0.1, 0.1); });
  }
  [[nodiscard]] Case with(const char* method) const {
    return {.problem = out_of_reach_, .method = method, .stages = 1, .solver = "ipopt"};
  }
  [[nodiscard]] StartProvider provider(StartProvider::Rules rules, SolverOptions options = {}) {
    StartProvider source(std::move(rules), std::move(options));
    source.on_progress = [this](const std::string&) { ++solves_; };
    return source;
  }
  tests::DoubleIntegrator base_;
  std::shared_ptr<const Problem> out_of_reach_;
  int solves_ = 0;
};

TEST_F(StartProviders, LookOnceForACommonStartThatThereIsNotAndFallBackToTheGuess) {
  StartProvider source = provider({});
  for (const char* method : {"dmoc", "tangent"}) {
    const Start start = source.start_for(with(method));
    EXPECT_EQ(start.motion.at(0.25).q, out_of_reach_->guess(0.25).q);
    EXPECT_FALSE(start.branch);
    EXPECT_NE(start.note.find("has no common start"), std::string::npos) << start.note;
    EXPECT_EQ(solves_, 18) << "three methods on three grids by two solvers";
  }
}

TEST_F(StartProviders, LookForNoCommonStartWhereSolvesBeginAtTheGuess) {
  StartProvider source = provider({.start = "guess"});
  const Start start = source.start_for(with("dmoc"));
  EXPECT_FALSE(start.branch);
  EXPECT_TRUE(start.note.empty()) << start.note;
  EXPECT_EQ(solves_, 0);
}

/// Standing still the chain falls apart by a factor of 1e9 or more over its horizon.
TEST_F(StartProviders, FindTheCommonStartOfAnUnstableSystemThatAReplayOfItsHorizonCannotJudge) {
  const tests::ChainOnCart unstable = tests::ChainOnCart::shifted(2);
  Case chain = with("dmoc");
  chain.problem = {std::shared_ptr<const Problem>(), &unstable};  // which it does not own
  chain.grid = Grid::uniform(96);
  StartProvider source = provider({.most_seconds = 300.0});
  const Start start = source.start_for(chain);
  EXPECT_TRUE(start.note.empty()) << start.note;
  ASSERT_TRUE(start.branch);
  const SolvedCase solved = solve_case(chain, start, *make_solver(chain.solver), SolverOptions{}.tolerance, 1);
  EXPECT_EQ(solved.branch, "same");
  ASSERT_TRUE(is_solved(solved.solution.status)) << solved.solution.message;
  EXPECT_LT(solved.accuracy->relative_jump, 1e-2);
  EXPECT_GT(replay_error(*chain.problem, *solved.trajectory).norm(), 1.0);
}

TEST_F(StartProviders, FindTheCommonStartByTheMethodsThatTakeAStatement) {
  Case sphere = with("dmoc");
  sphere.problem = std::make_shared<EmbeddedProblem>(std::make_shared<SphericalPendulumCartesian>());
  StartProvider source = provider({});
  const Start start = source.start_for(sphere);  // without tangent-space collocation, which takes no embedding
  EXPECT_TRUE(start.note.empty()) << start.note;
  EXPECT_TRUE(start.branch);
}

TEST_F(StartProviders, GiveUpWhenTheirTimeHasPassed) {
  StartProvider source = provider({.most_seconds = 0.0});
  EXPECT_NE(source.start_for(with("dmoc")).note.find("--start-seconds"), std::string::npos);
  EXPECT_EQ(solves_, 0);
}

/// The solver has nothing to complain about: what is missing is a motion that tells the branch.
TEST_F(StartProviders, SayThatThereIsNoCommonStartWhereAnAnswerIsSolvedButOfNoUse) {
  Case solvable = with("dmoc");
  solvable.problem = {std::shared_ptr<const Problem>(), &base_};  // which it does not own
  solvable.grid = Grid::uniform(16);
  StartProvider source = provider({.most_seconds = 0.0});
  const std::string sentence = tests::sentence_of_error([&] { static_cast<void>(source.solve(solvable)); });
  EXPECT_NE(sentence.find("no common start"), std::string::npos) << sentence;
  EXPECT_EQ(sentence.find("could not be solved"), std::string::npos) << sentence;
}

TEST_F(StartProviders, HeedAStopRequest) {
  SolverOptions options;
  options.stop_requested = [this] { return solves_ >= 2; };
  StartProvider source = provider({}, options);
  EXPECT_THROW(static_cast<void>(source.start_for(with("dmoc"))), Interrupted);
  EXPECT_LE(solves_, 3);
}

}  // namespace
}  // namespace dmocbench
