#include "problems/registry.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

TEST(Problems, HaveUniqueNamesInSnakeCase) {
  std::set<std::string> names;
  for (const std::string& name : problem_names()) {
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos);
    EXPECT_TRUE(name.front() >= 'a' && name.front() <= 'z') << name;
    EXPECT_EQ(make_problem(name)->name(), name);
  }
  EXPECT_TRUE(names.contains("orbital_transfer"));
  EXPECT_TRUE(names.contains("two_link_manipulator"));
}

TEST(Problems, UnknownNamesListTheKnownOnes) {
  for (const std::string& name : problem_names()) {
    tests::expect_error_naming({"\"pogo_stick\"", name}, [] { static_cast<void>(make_problem("pogo_stick")); });
  }
}

TEST(Problems, SayWhatTheyAreAndWhereTheyComeFrom) {
  for (const std::string& name : problem_names()) {
    const auto problem = make_problem(name);
    EXPECT_FALSE(problem->card().description.empty());
    EXPECT_FALSE(problem->card().source.empty());
    EXPECT_FALSE(problem->card().guess.empty());
    EXPECT_GT(problem->horizon(), 0.0);
    EXPECT_GT(problem->cost_scale(), 0.0);
    EXPECT_GT(problem->card().time_unit.factor, 0.0);
    std::set<std::string> parameters;
    for (const Parameter& parameter : problem->parameters()) {
      EXPECT_TRUE(parameters.insert(parameter.name).second) << parameter.name;
      EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
      EXPECT_NO_THROW(parameter.check(parameter.value));
    }
  }
}

TEST(Problems, GuessMotionsThatMeetTheConfigurationsAtBothEnds) {
  for (const std::string& name : problem_names()) {
    const auto problem = make_problem(name);
    EXPECT_LT((problem->guess(0.0).q - problem->initial_state().q).norm(), 1e-14) << name;
    EXPECT_LT((problem->guess(problem->horizon()).q - problem->final_state().q).norm(), 1e-14) << name;
  }
}

TEST(Problems, GuessVelocitiesThatAreTheSlopeOfTheGuessedConfiguration) {
  for (const std::string& name : problem_names()) {
    const auto problem = make_problem(name);
    const double e = 1e-5 * problem->horizon();
    for (const double fraction : {0.1, 0.5, 0.9}) {
      const double t = fraction * problem->horizon();
      const Eigen::VectorXd slope = (problem->guess(t + e).q - problem->guess(t - e).q) / (2.0 * e);
      EXPECT_LT((slope - problem->guess(t).v).norm(), 1e-8 * (1.0 + slope.norm())) << name;
      EXPECT_EQ(problem->guess(t).u.size(), problem->control_size());
    }
  }
}

TEST(Problems, AreRegularAlongTheirGuess) {
  for (const std::string& name : problem_names()) {
    const auto problem = make_problem(name);
    EquationsOfMotion motion{TracedProblem(*problem)};
    for (int i = 0; i <= 16; ++i) {
      const double t = problem->horizon() * i / 16.0;
      const MotionPoint point = problem->guess(t);
      EXPECT_TRUE(motion.acceleration(point.q, point.v, point.u, t).allFinite()) << name;
    }
  }
}

}  // namespace
}  // namespace dmocbench
