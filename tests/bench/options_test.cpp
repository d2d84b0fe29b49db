#include "bench/run/options.hpp"

#include <filesystem>
#include <functional>
#include <new>
#include <ranges>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "bench/run/command_line.hpp"
#include "bench/run/error_sentences.hpp"
#include "methods/error.hpp"
#include "methods/transcription/motions/grid.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using tests::expect_error_naming;
using Counts = std::vector<long long>;

Counts intervals(std::string_view text) { return parse_intervals("--intervals", text); }

TEST(Intervals, ARangeDoublesUpToItsEnd) {
  EXPECT_EQ(intervals("8:1024"), (Counts{8, 16, 32, 64, 128, 256, 512, 1024}));
  EXPECT_EQ(intervals("8:1023"), (Counts{8, 16, 32, 64, 128, 256, 512}));
  EXPECT_EQ(intervals("7:7"), (Counts{7}));
}

TEST(Intervals, ARangeThatDoublingDoesNotEndIsStatedWithTheNumbersThatItTakes) {
  for (const char* text : {"8:1024", "7:7", "3:12,48", "16,48,64"})
    EXPECT_EQ(remark_on_ranges("--intervals", text), "");
  EXPECT_EQ(remark_on_ranges("--intervals", "5,16:100,8:17"),
            "--intervals 16:100 takes 16, 32, 64; --intervals 8:17 takes 8, 16: a range doubles its start repeatedly");
}

TEST(Intervals, AListIsSortedAndEachEntryOccursOnce) {
  EXPECT_EQ(intervals("48,16"), (Counts{16, 48}));
  EXPECT_EQ(intervals("16,16"), (Counts{16}));
  EXPECT_EQ(intervals("96,8:64,48,32"), (Counts{8, 16, 32, 48, 64, 96}));
}

TEST(Intervals, TheLargestNumberIsAllowedAndEndsARange) {
  EXPECT_EQ(intervals(std::to_string(Grid::most_intervals)), (Counts{Grid::most_intervals}));
  EXPECT_EQ(intervals("3:" + std::to_string(Grid::most_intervals)).back(), 3LL << 22);
}

TEST(Intervals, RefusesAnythingElseAndQuotesIt) {
  for (const std::string entry : {"0", "-3", "abc", "1e12", "1.5", "16 ", "+4", "99999999999999999999", "0x10"}) {
    expect_error_naming({"\"" + entry + "\""}, [&] { static_cast<void>(intervals(entry)); });
    expect_error_naming({"\"" + entry + "\""}, [&] { static_cast<void>(intervals("16," + entry)); });
    expect_error_naming({"\"" + entry + "\""}, [&] { static_cast<void>(intervals("1:" + entry)); });
  }
  for (const char* text : {"", ",", ",16", "16,,32", ":", "8:", ":8", "8:16:32"}) {
    EXPECT_THROW(static_cast<void>(intervals(text)), Error) << text;
  }
  expect_error_naming({"--intervals", "8:4"}, [] { static_cast<void>(intervals("8:4")); });
  expect_error_naming({"--intervals", "64:100", "64,100"}, [] { static_cast<void>(intervals("64:100")); });
  expect_error_naming({"--intervals", "8-64", "8:64"}, [] { static_cast<void>(intervals("8-64")); });
  expect_error_naming({"--fit", "\"x\""}, [] { static_cast<void>(parse_intervals("--fit", "x")); });
}

TEST(NodeTimes, AreReadLineByLineWithoutEmptyLines) {
  EXPECT_EQ(parse_node_times("0\n0.25\r\n\n1e0 \n"), (std::vector<double>{0.0, 0.25, 1.0}));
}

TEST(NodeTimes, ALineThatIsNoNumberIsNamed) {
  expect_error_naming({"line 2", "half"}, [] { static_cast<void>(parse_node_times("0\nhalf\n1\n")); });
}

TEST(Assignment, IsCutAtTheFirstEqualsSign) {
  const auto [name, value] = parse_assignment("--option", "a=b=c");
  EXPECT_EQ(name, "a");
  EXPECT_EQ(value, "b=c");
}

TEST(Assignment, WithoutNameOrEqualsSignIsRefused) {
  for (const std::string text : {"mass", "=1", ""}) {
    expect_error_naming({"--set", "\"" + text + "\""}, [&] { static_cast<void>(parse_assignment("--set", text)); });
  }
}

TEST(Number, TakesTheWholeText) {
  EXPECT_EQ(parse_number("x", "-1.5e3"), -1500.0);
  for (const std::string text : {"", "1 km", "1,5", "0x10", "one"}) {
    expect_error_naming({"x", "\"" + text + "\""}, [&] { static_cast<void>(parse_number("x", text)); });
  }
}

TEST(Intervals, MoreThanFitIntoMemoryAreRefused) {
  const auto counts = std::views::iota(1, 1002);
  expect_error_naming({"--intervals", "1000"},
                      [&] { static_cast<void>(intervals(fmt::format("{}", fmt::join(counts, ",")))); });
}

TEST(Solvers, AreThoseOfSolveUnlessTheProblemIsThePapers) {
  ExperimentOptions options{.problems = {"cart_pole", "two_link_manipulator"}, .intervals = "16", .name = "any"};
  for (const Case& the_case : expand_cases(options))
    EXPECT_EQ(the_case.solver, is_of_paper(the_case.problem->name()) ? "ipopt" : "auto");
  options.solvers = {"sqp"};
  for (const Case& the_case : expand_cases(options)) EXPECT_EQ(the_case.solver, "sqp");
}

TEST(Problems, ThatAreUnknownMayBeInALibrary) {
  const ExperimentOptions options{.problems = {"crane_lift"}, .intervals = "16", .name = "any"};
  expect_error_naming({"there is no problem \"crane_lift\"", "--library"},
                      [&] { static_cast<void>(expand_cases(options)); });
}

ExperimentOptions by_galerkin(std::vector<int> stages) {
  return {.problems = {"two_link_manipulator"},
          .methods = {"galerkin"},
          .stages = std::move(stages),
          .intervals = "16",
          .name = "any"};
}

/// "galerkin_2_1 gauss 3": method and quadrature of each case.
std::vector<std::string> schemes_of(const ExperimentOptions& options) {
  std::vector<std::string> schemes;
  for (const Case& the_case : expand_cases(options)) {
    schemes.push_back(fmt::format("{} {} {}", the_case.method, the_case.tableau, the_case.stages));
  }
  return schemes;
}

TEST(GalerkinOptions, HaveAsManyPointsAndControlNodesAsTheDegreeUnlessTheySayOtherwise) {
  ExperimentOptions options = by_galerkin({2});
  options.quadratures = {"gauss", "lobatto"};
  EXPECT_EQ(schemes_of(options), (std::vector<std::string>{"galerkin_2_2 gauss 2", "galerkin_2_2 lobatto 3"}));
  options.controls = "shared";
  options.quadratures.clear();
  EXPECT_EQ(schemes_of(options), (std::vector<std::string>{"galerkin_2_2_shared gauss 2"}));
}

TEST(GalerkinOptions, TakeTheCombinationsOfSeveralNumbersThatExist) {
  ExperimentOptions options = by_galerkin({1, 2});
  options.points = {1, 2};
  options.control_nodes = {1, 2};
  EXPECT_EQ(schemes_of(options),
            (std::vector<std::string>{"galerkin_1_1 gauss 1", "galerkin_1_1 gauss 2", "galerkin_1_2 gauss 2",
                                      "galerkin_2_1 gauss 2", "galerkin_2_2 gauss 2"}));
}

TEST(GalerkinOptions, RefuseANumberThatIsInNoCombination) {
  const auto refuses = [](const std::string& because, const std::function<void(ExperimentOptions&)>& change) {
    ExperimentOptions options = by_galerkin({1, 2});
    change(options);
    expect_error_naming({because}, [&] { static_cast<void>(expand_cases(options)); });
  };
  refuses("degree 2 needs at least 2 quadrature points", [](ExperimentOptions& options) { options.points = {1}; });
  refuses("3 control nodes needs at least 3", [](ExperimentOptions& options) {
    options.points = {2};
    options.control_nodes = {1, 3};
  });
  refuses("radau", [](ExperimentOptions& options) { options.quadratures = {"radau"}; });
  refuses("--method galerkin", [](ExperimentOptions& options) {
    options.methods = {"dmoc"};
    options.points = {2};
  });
}

TEST(Sentences, OfLibrariesSayWhatTheyMean) {
  EXPECT_EQ(sentence_of(Error("ours")), "ours");
  EXPECT_NE(sentence_of(std::bad_alloc()).find("out of memory"), std::string::npos);
  EXPECT_NE(sentence_of(std::length_error("vector::reserve")).find("out of memory"), std::string::npos);
  const auto no_threads = std::make_error_code(std::errc::resource_unavailable_try_again);
  EXPECT_NE(sentence_of(std::system_error(no_threads)).find("DMOCBENCH_THREADS"), std::string::npos);
  const auto denied = std::make_error_code(std::errc::permission_denied);
  EXPECT_EQ(sentence_of(std::filesystem::filesystem_error("cannot copy", "a.csv", denied)), "a.csv: Permission denied");
}

}  // namespace
}  // namespace dmocbench
