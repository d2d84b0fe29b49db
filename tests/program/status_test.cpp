#include "methods/program/status.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace dmocbench {
namespace {

constexpr int first = static_cast<int>(Status::not_run);
constexpr int last = static_cast<int>(Status::not_confirmed);

TEST(Status, NamesRoundTripAndAreDistinct) {
  std::set<std::string_view> names;
  for (int i = first; i <= last; ++i) {
    const auto status = static_cast<Status>(i);
    EXPECT_TRUE(names.insert(name_of(status)).second) << name_of(status);
    EXPECT_EQ(status_named(name_of(status)), status);
  }
}

TEST(Status, NamesCanStandInATable) {
  for (int i = first; i <= last; ++i) {
    const std::string name(name_of(static_cast<Status>(i)));
    EXPECT_FALSE(name.empty());
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz, "), std::string::npos) << name;
  }
}

TEST(Status, EveryOneHasASentenceOfItsOwn) {
  std::set<std::string_view> sentences;
  for (int i = first; i <= last; ++i) {
    const std::string_view sentence = sentence_of(static_cast<Status>(i));
    EXPECT_TRUE(sentences.insert(sentence).second) << sentence;
    EXPECT_TRUE(sentence.ends_with('.')) << sentence;
    EXPECT_NE(sentence.find(' '), std::string_view::npos) << sentence;
  }
}

TEST(Status, UnknownNamesMeanNotRun) {
  EXPECT_EQ(status_named("splendid"), Status::not_run);
  EXPECT_EQ(status_named(""), Status::not_run);
}

TEST(Status, OnlyWhatIsSolvedInCostAndStateIsAnAnswer) {
  for (int i = first; i <= last; ++i) {
    const auto status = static_cast<Status>(i);
    EXPECT_EQ(is_solved(status), name_of(status).starts_with("solved")) << name_of(status);
  }
}

}  // namespace
}  // namespace dmocbench
