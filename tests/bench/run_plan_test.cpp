#include "bench/run/run_plan.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "bench/run/case_batch.hpp"
#include "bench/run/case_list.hpp"
#include "bench/run/json_place.hpp"
#include "bench/run/result_file.hpp"
#include "problems/registry.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using tests::expect_error_naming;

/// Cases of two methods on some grids.
std::vector<Case> cases_on(std::size_t grids) {
  const std::shared_ptr<const Problem> problem = make_problem("double_integrator");
  std::vector<Case> cases;
  for (const char* const method : {"dmoc", "tangent"}) {
    for (std::size_t i = 0; i < grids; ++i) {
      cases.push_back({.problem = problem, .method = method});
      cases.back().grid = Grid::uniform(static_cast<Eigen::Index>(i) + 2);
    }
  }
  return cases;
}

std::string nothing(const Case& /*the_case*/) { return {}; }
std::string method_of(const Case& the_case) { return the_case.method; }
std::string grid_of(const Case& the_case) { return std::to_string(the_case.intervals()); }

TEST(Part, IsReadAsItIsWritten) {
  for (const char* const text : {"1/1", "3/16", "16/16", "1000000/1000000"}) {
    EXPECT_EQ(parse_part("--part", text).in_words(), text);
  }
}

TEST(Part, ThatCannotBeIsRefusedByName) {
  for (const char* const text : {"", "/", "1", "1/", "/4", "0/4", "5/4", "a/b", "1/4/4", "-1/4", "+1/4", " 1/4", "1/4 ",
                                 "1.0/4", "0x1/4", "1/0", "1/1000001", "1/99999999999999999999"}) {
    expect_error_naming({"--part", "i/n"}, [&] { static_cast<void>(parse_part("--part", text)); });
  }
}

TEST(Part, FilesAreInTheOrderOfTheirNumbers) {
  std::vector<std::string> names;
  for (std::size_t number = 1; number <= 100; ++number) names.push_back(Part{number, 100}.name());
  EXPECT_TRUE(std::ranges::is_sorted(names));
  EXPECT_EQ(names[2], "003-of-100");
}

TEST(Cases, AreMadeOnceForEachStart) {
  const auto number_as_horizon = [](const Motion& chosen, const Problem& /*problem*/, std::size_t number) {
    return Motion{chosen.at, static_cast<double>(number)};
  };
  const std::vector<Case> cases = from_starts(
      cases_on(1), [](const Case& the_case) { return the_case.method == "dmoc" ? 2LL : 1LL; }, number_as_horizon);
  ASSERT_EQ(cases.size(), 3U);
  EXPECT_EQ(cases[1].variant, (Variant{1, "1"}));
  EXPECT_EQ(cases[1].start({}).horizon, 1.0);
  EXPECT_EQ(cases[2].method, "tangent");
}

TEST(Cases, AreVariedCurveByCurve) {
  const auto labels_of = [](const Case& the_case) {
    return the_case.method == "dmoc" ? std::vector<std::string>{"a", "b"} : std::vector<std::string>{""};
  };
  const std::vector<Case> cases = vary(cases_on(2), labels_of);
  std::vector<std::string> labels;
  for (const Case& the_case : cases) labels.push_back(the_case.variant.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"a", "a", "b", "b", "", ""}));
  EXPECT_EQ(cases[2].variant.index, 1U);
}

TEST(Cases, AReferenceIsSolvedFirst) {
  std::vector<Case> curve = cases_on(3);
  EXPECT_EQ(reference_of(curve), 0U);
  curve[2].is_reference = true;
  EXPECT_EQ(reference_of(curve), 2U);
}

TEST(Spans, AreCutBetweenProgramsOnly) {
  std::vector<Case> cases;  // four starts of each of two methods
  for (Case& the_case : cases_on(1)) {
    for (std::size_t start = 0; start < 4; ++start) cases.emplace_back(the_case).variant.index = start;
  }
  const auto ends = [&](const SharedBy& shared, std::size_t least) {
    std::vector<std::size_t> found;
    for (const CaseSpan& span : spans_of_programs(cases, {{0, cases.size()}}, groups_of(cases, {shared}), least)) {
      EXPECT_EQ(span.first, found.empty() ? 0 : found.back());
      found.push_back(span.end);
    }
    return found;
  };
  EXPECT_EQ(ends(nothing, 4), (std::vector<std::size_t>{4, 8}));
  EXPECT_EQ(ends(method_of, 1), (std::vector<std::size_t>{4, 8}));
  EXPECT_EQ(ends(nothing, 5), std::vector<std::size_t>{8}) << "pieces would have fewer cases than wanted";
  EXPECT_EQ(ends(grid_of, 1), std::vector<std::size_t>{8}) << "cases of one grid need each other";
}

TEST(Dealing, EveryCaseIsAloneWhereNothingIsShared) {
  const std::vector<Case> cases = cases_on(5);
  const std::vector<std::size_t> groups = groups_of(cases, {nothing});
  EXPECT_EQ(std::set(groups.begin(), groups.end()).size(), cases.size());
}

TEST(Dealing, WhatIsSharedInAnyRespectIsOneGroup) {
  const std::vector<Case> cases = cases_on(4);  // dmoc 2 3 4 5, tangent 2 3 4 5
  EXPECT_EQ(groups_of(cases, {method_of}), (std::vector<std::size_t>{0, 0, 0, 0, 4, 4, 4, 4}));
  EXPECT_EQ(groups_of(cases, {grid_of}), (std::vector<std::size_t>{0, 1, 2, 3, 0, 1, 2, 3}));
  EXPECT_EQ(groups_of(cases, {nothing, grid_of, method_of}), std::vector<std::size_t>(8, 0));
}

TEST(Dealing, PartsHaveAsManyGroupsUpToOneAndKeepThemWhole) {
  const std::vector<Case> cases = cases_on(25);
  const std::vector<std::size_t> groups = groups_of(cases, {grid_of});
  for (const std::size_t parts : {1U, 3U, 7U, 25U, 40U}) {
    const std::vector<std::size_t> part_of = dealt_out(cases, groups, parts);
    std::map<std::size_t, std::set<std::size_t>> groups_in;
    for (std::size_t number = 1; number <= parts; ++number) groups_in[number] = {};
    for (std::size_t i = 0; i < cases.size(); ++i) {
      EXPECT_EQ(part_of[i], part_of[groups[i]]);
      groups_in[part_of[i]].insert(groups[i]);
    }
    EXPECT_EQ(groups_in.size(), parts) << "a part has a number beyond " << parts;
    const auto sizes = [](const auto& of_part) { return of_part.second.size(); };
    const auto [least, most] = std::ranges::minmax_element(groups_in, {}, sizes);
    EXPECT_LE(sizes(*most) - sizes(*least), 1U);
  }
}

TEST(Dealing, MixesFineAndCoarseGrids) {
  constexpr std::size_t grids = 200;
  const std::vector<Case> cases = cases_on(grids);
  const std::vector<std::size_t> part_of = dealt_out(cases, groups_of(cases, {nothing}), 4);
  std::map<std::size_t, double> work;
  for (std::size_t i = 0; i < cases.size(); ++i) work[part_of[i]] += static_cast<double>(cases[i].intervals());
  const double mean = static_cast<double>(grids * (grids + 3)) / 4.0;
  for (const auto& [part, intervals] : work) EXPECT_NEAR(intervals / mean, 1.0, 0.25) << "part " << part;
}

TEST(Json, IsReadByTypeOrRefusedByFileKeyAndContent) {
  const nlohmann::ordered_json json{{"outer", {{"text", "a"}, {"number", 1}, {"flag", true}, {"list", {"x", 2}}}}};
  const JsonPlace outer = JsonPlace(json, "f.json").at("outer");
  EXPECT_EQ(outer.at("text").text(), "a");
  EXPECT_EQ(outer.at("number").number(), 1.0);
  EXPECT_TRUE(outer.at("flag").boolean());
  expect_error_naming({"f.json", "outer none", "missing"}, [&] { static_cast<void>(outer.at("none")); });
  expect_error_naming({"f.json", "outer text", "\"a\"", "number"},
                      [&] { static_cast<void>(outer.at("text").number()); });
  expect_error_naming({"outer number", "1", "text"}, [&] { static_cast<void>(outer.at("number").text()); });
  expect_error_naming({"outer flag", "true", "text"}, [&] { static_cast<void>(outer.at("flag").text()); });
  expect_error_naming({"outer text", "true or false"}, [&] { static_cast<void>(outer.at("text").boolean()); });
  expect_error_naming({"outer list 2", "2", "text"}, [&] { static_cast<void>(outer.at("list").texts()); });
  expect_error_naming({"outer", "object", "array"}, [&] { static_cast<void>(outer.entries()); });
  expect_error_naming({"outer text", "object"}, [&] { static_cast<void>(outer.at("text").at("deeper")); });
}

TEST(TableName, IsThatOfAFileInItsFolder) {
  for (const char* const name : {"objective", "a b", "x.csv", "é"}) EXPECT_NO_THROW(require_name_of_table(name));
  for (const char* const name : {"", ".", "..", ".hidden", "-x", "a/b", "/tmp/x", "a\nb", "\x1b[31m"}) {
    expect_error_naming({"--name"}, [&] { require_name_of_table(name); });
  }
}

}  // namespace
}  // namespace dmocbench
