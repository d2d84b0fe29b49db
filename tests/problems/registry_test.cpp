#include "problems/registry.hpp"

#include <set>

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "problems/acrobot.hpp"
#include "problems/beam.hpp"
#include "problems/cart_pole.hpp"
#include "problems/problem_library.hpp"
#include "tests/support/problems_for_tests.hpp"
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

TEST(Registry, KeepsTheOrderInWhichProblemsWereAddedAndWhereTheyComeFrom) {
  Registry others;
  others.add<Beam>();
  others.add<Acrobot>();
  Registry registry;
  registry.add<CartPole>();
  registry.add_all(others, "/a/library.so");
  EXPECT_EQ(registry.names(), (std::vector<std::string>{"cart_pole", "beam", "acrobot"}));
  EXPECT_EQ(registry.origin("cart_pole"), "");
  EXPECT_EQ(registry.origin("acrobot"), "/a/library.so");
  EXPECT_EQ(registry.make("beam")->name(), "beam");
  tests::expect_error_naming({"\"moon\"", "cart_pole", "acrobot"}, [&] { static_cast<void>(registry.make("moon")); });
}

/// A problem that cannot be made.
struct Broken final : Acrobot {
  Broken() { throw Error("no such rod"); }
};

TEST(Registry, RefusesOnlyTheProblemsWhoseNamesAreThereAlreadyOrThatCannotBeMade) {
  Registry others(Registry::Faults::kept);
  others.add<Beam>();
  others.add<Broken>();
  others.add<Acrobot>();
  EXPECT_EQ(others.names(), (std::vector<std::string>{"beam", "acrobot"}));
  Registry registry;
  registry.add<Beam>();
  registry.add_all(others, "/a/library.so");
  EXPECT_EQ(registry.names(), (std::vector<std::string>{"beam", "acrobot"}));
  EXPECT_EQ(registry.origin("beam"), "");
  EXPECT_EQ(registry.class_of("acrobot"), "Acrobot");
  ASSERT_EQ(registry.refused().size(), 2U);
  EXPECT_EQ(registry.refused()[0].reason, "the problem of class Broken cannot be used: no such rod (/a/library.so)");
  EXPECT_EQ(registry.refused()[1].name, "beam");
  EXPECT_NE(registry.refused()[1].reason.find("class Beam"), std::string::npos);
  tests::expect_error_naming({"beam"}, [&] { registry.add<Beam>(); });
}

/// A mass that is pushed, whose name has these letters.
template <char... letters>
struct Named final : tests::SmallProblem {
  Named() : SmallProblem({letters...}, at(0.0, 0.0), at(1.0, 0.0), 1.0, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }
};

TEST(Registry, TakesOnlyNamesThatCommandLinesAndFilesTake) {
  Registry registry;
  registry.add<Named<'a', '_', '1'>>();
  tests::expect_error_naming({"\"\""}, [&] { registry.add<Named<>>(); });
  tests::expect_error_naming({"\"all\""}, [&] { registry.add<Named<'a', 'l', 'l'>>(); });
  tests::expect_error_naming({"\"a/b\""}, [&] { registry.add<Named<'a', '/', 'b'>>(); });
  tests::expect_error_naming({"\"a,b\""}, [&] { registry.add<Named<'a', ',', 'b'>>(); });
  tests::expect_error_naming({"\"Beam\""}, [&] { registry.add<Named<'B', 'e', 'a', 'm'>>(); });
  tests::expect_error_naming({"\"1a\""}, [&] { registry.add<Named<'1', 'a'>>(); });
  EXPECT_EQ(registry.names(), std::vector<std::string>{"a_1"});
}

TEST(ProblemLibrary, OfAnotherBuildIsRefusedByItsFirstDifference) {
  const std::string tag(tag_of_this_build());
  EXPECT_NO_THROW(require_same_build("a.so", tag));
  const auto changed = [&tag](const std::string& from, const std::string& to) {
    std::string other = tag;
    return other.replace(other.find(from), from.size(), to);
  };
  tests::expect_error_naming({"a.so", "version=9.", "here version=0."},
                             [&] { require_same_build("a.so", changed("version=0.", "version=9.")); });
  tests::expect_error_naming({"sanitizer=none of ours"},
                             [&] { require_same_build("a.so", changed("sanitizer=", "sanitizer=none of ours")); });
  tests::expect_error_naming({"nothing"}, [&] { require_same_build("a.so", tag.substr(0, tag.find(";Eigen"))); });
  EXPECT_THROW(require_same_build("a.so", tag + "more=1;"), Error);
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
      EXPECT_TRUE(motion.acceleration(point.q, point.v, point.u, t, point.y).allFinite()) << name;
    }
  }
}

}  // namespace
}  // namespace dmocbench
