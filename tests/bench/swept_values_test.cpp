#include "bench/experiments/sweep/swept_values.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "problems/registry.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using tests::expect_error_naming;

std::vector<SweptQuantity> quantities(const std::vector<std::string>& texts, bool are_sampled = false) {
  std::vector<SweptQuantity> all;
  all.reserve(texts.size());
  for (const std::string& text : texts) all.push_back(parse_over(text, are_sampled));
  return all;
}

TEST(SweptValues, OfSeveralGridsAreEveryCombinationWithBothEnds) {
  const auto instances = instances_of(quantities({"a=0:1:3", "b=-2:2:2"}), std::nullopt, 1);
  const std::vector<std::vector<double>> expected{{0, -2}, {0, 2}, {0.5, -2}, {0.5, 2}, {1, -2}, {1, 2}};
  EXPECT_EQ(instances, expected);
}

TEST(SweptValues, OfSamplesAreThoseOfTheirSeedAndInTheirRanges) {
  const auto ranges = quantities({"a=0:1", "b=-2:-1"}, true);
  const auto instances = instances_of(ranges, 1000, 7);
  EXPECT_EQ(instances, instances_of(ranges, 1000, 7));
  EXPECT_NE(instances, instances_of(ranges, 1000, 8));
  double lowest = 1.0;
  double highest = 0.0;
  for (const std::vector<double>& values : instances) {
    EXPECT_TRUE(values[0] >= 0.0 && values[0] < 1.0 && values[1] >= -2.0 && values[1] < -1.0);
    lowest = std::min(lowest, values[0]);
    highest = std::max(highest, values[0]);
  }
  EXPECT_LT(lowest, 0.02);
  EXPECT_GT(highest, 0.98);
}

TEST(SweptValues, ThatCannotBeReadAreNamed) {
  for (const char* text : {"a=1:2:0", "a=1:2:1", "a=1:2:two", "a=1:2", "a=1", "a=2:1:3", "a=1:1:3", "a=nan:1:2",
                           "a=1:inf:2", "a=1:2:3:4", "a=:2:3"}) {
    SCOPED_TRACE(text);
    expect_error_naming({"--over a"}, [&] { static_cast<void>(parse_over(text, false)); });
  }
  expect_error_naming({"--over a", "--samples"}, [&] { static_cast<void>(parse_over("a=1:2:3", true)); });
  expect_error_naming({"--over"}, [&] { static_cast<void>(parse_over("1:2:3", false)); });
  expect_error_naming({"a is given twice"}, [&] {
    static_cast<void>(instances_of(quantities({"a=1:2:3", "a=1:2:3"}), std::nullopt, 1));
  });
  expect_error_naming({"100000", "1000000"}, [&] {
    static_cast<void>(instances_of(quantities({"a=1:2:1000", "b=1:2:1000"}), std::nullopt, 1));
  });
}

TEST(SweptValues, ThatAProblemDoesNotHaveAreNamed) {
  const auto two_link = make_problem("two_link_manipulator");
  const auto expect = [](const Problem& problem, const std::string& name, std::initializer_list<std::string> words) {
    expect_error_naming(words, [&] { require_quantities(problem, {SweptQuantity{name, 0.0, 1.0, 2}}); });
  };
  expect(*two_link, "colour", {"colour", "mass_1"});
  expect(*two_link, "final_q3", {"final_q3", "2 entries"});
  expect(*two_link, "final_q0", {"final_q0"});
  expect(*two_link, "final_w1", {"final_w1"});
  expect(*make_problem("brachistochrone"), "final_v1", {"final_v1", "does not prescribe"});
  EXPECT_NO_THROW(require_quantities(*two_link, {SweptQuantity{"initial_v2", 0.0, 1.0, 2}}));
}

TEST(SweptValues, BecomeThoseOfTheInstanceAndOfNothingElse) {
  const std::shared_ptr<const Problem> base = make_problem("two_link_manipulator");
  const auto instance =
      instance_of(base, {"mass_2=3"}, {SweptQuantity{"mass_1", 1, 2}, SweptQuantity{"final_q2", 0, 1}}, {1.5, 0.25});
  EXPECT_EQ(instance->final_state().q[1], 0.25);
  EXPECT_EQ(instance->final_state().q[0], base->final_state().q[0]);
  EXPECT_EQ(instance->bounds().last.q.lower[1], 0.25);
  EXPECT_EQ(instance->bounds().last.q.upper[1], 0.25);
  EXPECT_EQ(instance->initial_state().q, base->initial_state().q);
  EXPECT_EQ(instance->guess(instance->horizon()).q[1], 0.25);
  EXPECT_EQ(instance->guess(0.0).q, base->guess(0.0).q);
  EXPECT_THROW((void)instance_of(base, {}, {SweptQuantity{"mass_1", -1, 2}}, {-1.0}), Error);
}

TEST(SweptValues, OfParametersAreAllThatTheProblemHas) {
  const auto problem = make_problem("two_link_manipulator");
  const std::vector<SweptQuantity> varied{{"mass_2", 1, 2}, {"final_q2", 0, 1}};
  EXPECT_EQ(varied_parameters(*problem, varied), std::vector<std::string>{"mass_2"});
  const Eigen::VectorXd values = parameters_of_instance(*problem, varied, {1.5, 0.25});
  for (std::size_t i = 0; i < problem->parameters().size(); ++i) {
    const Parameter& parameter = problem->parameters()[i];
    EXPECT_EQ(values[static_cast<Eigen::Index>(i)], parameter.name == "mass_2" ? 1.5 : parameter.value);
  }
}

}  // namespace
}  // namespace dmocbench
