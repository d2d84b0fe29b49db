#include "methods/transcription/layout.hpp"

#include <set>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::all_schemes;
using tests::Scheme;
using tests::transcribe;

struct Counts {
  std::size_t variables;
  std::size_t rows;
};

Counts counts(const Problem& problem, const Scheme& scheme, long long intervals) {
  const auto program = transcribe(problem, scheme, Grid::uniform(intervals));
  return {program->variable_count(), program->constraint_count()};
}

TEST(Layout, AddsPerIntervalWhatTheSavingsRemarkCounts) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    const auto n = static_cast<std::size_t>(problem->configuration_size());
    const auto m = static_cast<std::size_t>(problem->control_size());
    for (const Scheme& scheme : all_schemes()) {
      SCOPED_TRACE(name + ", " + scheme.label());
      const auto s = static_cast<std::size_t>(scheme.stages);
      const Counts coarse = counts(*problem, scheme, 10);
      const Counts fine = counts(*problem, scheme, 11);
      const std::size_t factor = scheme.method == "dmoc" ? 1 : 2;
      EXPECT_EQ(fine.variables - coarse.variables, factor * s * n + s * m);
      EXPECT_EQ(fine.rows - coarse.rows, factor * s * n);
    }
  }
}

TEST(Layout, GivesDmocThreeFifthsAndTwoThirdsOfTheVariables) {
  const auto ratio = [](const std::string& name, int stages) {
    const auto problem = make_problem(name);
    const auto added = [&](const std::string& method) {
      return static_cast<double>(counts(*problem, {method, stages}, 11).variables -
                                 counts(*problem, {method, stages}, 10).variables);
    };
    EXPECT_EQ(added("hamiltonian"), added("tangent"));
    return added("dmoc") / added("hamiltonian");
  };
  for (const int s : {1, 2, 3}) {
    EXPECT_DOUBLE_EQ(ratio("orbital_transfer", s), 3.0 / 5.0);
    EXPECT_DOUBLE_EQ(ratio("two_link_manipulator", s), 4.0 / 6.0);
  }
}

TEST(Layout, CountsTheWholeProgramAsNodesPlusIntervals) {
  const auto problem = make_problem("orbital_transfer");  // n = 2, m = 1
  constexpr std::size_t intervals = 10;
  const Counts dmoc = counts(*problem, {"dmoc", 2}, intervals);
  EXPECT_EQ(dmoc.variables, 2 * (intervals + 1) + intervals * (2 + 2));
  EXPECT_EQ(dmoc.rows, 2 * (intervals + 1) + intervals * 2);
  const Counts collocation = counts(*problem, {"tangent", 2}, intervals);
  EXPECT_EQ(collocation.variables, 4 * (intervals + 1) + intervals * (4 + 2));
  EXPECT_EQ(collocation.rows, intervals * 8);
}

TEST(Layout, ColumnsAreDisjointAndCoverEveryUnknownOnce) {
  for (const NodeState state : {NodeState::configuration, NodeState::momentum}) {
    constexpr std::size_t intervals = 5;
    constexpr Eigen::Index n = 3;
    constexpr Eigen::Index m = 2;
    constexpr Eigen::Index s = 3;
    const bool second = state != NodeState::configuration;
    const Layout layout({.intervals = intervals,
                         .configuration_size = n,
                         .control_size = m,
                         .node_state = state,
                         .stages = s,
                         .rate_stages = s,
                         .control_stages = s,
                         .node_rows = second ? 0 : n,
                         .stage_equations = second ? 2 * n * s : n * (s - 1)});
    std::multiset<std::size_t> covered;
    const auto cover = [&](std::size_t head, std::size_t length) {
      for (std::size_t k = 0; k < length; ++k) covered.insert(head + k);
    };
    for (Eigen::Index i = 0; i < n; ++i) {
      cover(layout.configuration_head(i), intervals + 1);
      if (second) cover(layout.second_head(i), intervals + 1);
      for (Eigen::Index j = 0; j + 1 < s; ++j) {
        cover(layout.rate_head(j, i), intervals);
        if (second) cover(layout.second_rate_head(j, i), intervals);
      }
    }
    for (Eigen::Index j = 0; j < s; ++j) {
      for (Eigen::Index i = 0; i < m; ++i) cover(layout.control_head(j, i), intervals);
    }
    ASSERT_EQ(covered.size(), layout.variable_count());
    EXPECT_EQ(std::set<std::size_t>(covered.begin(), covered.end()).size(), covered.size());
    EXPECT_EQ(*covered.rbegin() + 1, layout.variable_count());
  }
}

TEST(Layout, WithSharedControlsHasOneFewerPerIntervalAndTheSameRows) {
  const auto problem = make_problem("two_link_manipulator");  // m = 2
  for (const Scheme& shared : tests::schemes_with_shared_controls(4)) {
    SCOPED_TRACE(shared.label());
    constexpr std::size_t intervals = 10;
    const Counts with = counts(*problem, shared, intervals);
    const Counts without = counts(*problem, {shared.method, shared.stages, "lobatto"}, intervals);
    EXPECT_EQ(without.variables - with.variables, 2 * (intervals - 1));
    EXPECT_EQ(without.rows, with.rows);
  }
}

TEST(Layout, SharedControlsOfNeighboursAreTheSameUnknown) {
  constexpr std::size_t intervals = 5;
  const Layout layout({.intervals = intervals,
                       .configuration_size = 2,
                       .control_size = 2,
                       .node_state = NodeState::velocity,
                       .stages = 3,
                       .rate_stages = 3,
                       .control_stages = 3,
                       .shares_controls = true,
                       .stage_equations = 12});
  std::set<std::size_t> covered;
  for (Eigen::Index i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k + 1 < intervals; ++k) {
      EXPECT_EQ(layout.control_head(2, i) + k, layout.control_head(0, i) + k + 1);
    }
    for (std::size_t k = 0; k < intervals; ++k) {
      for (const Eigen::Index stage : {0, 1, 2}) covered.insert(layout.control_head(stage, i) + k);
    }
  }
  EXPECT_EQ(covered.size(), 2 * (intervals + 1 + intervals));
  EXPECT_EQ(*covered.rbegin() + 1, layout.variable_count());
}

/// A row of interval k reads unknowns of nodes k and k + 1 and of interval k; a row of node k those beside it.
bool may_read(const Place& row, const Place& unknown) {
  const auto near = [](std::size_t a, std::size_t b, std::size_t below, std::size_t above) {
    return a + below >= b && a <= b + above;
  };
  if (row.kind == Place::Kind::interval) {
    return unknown.kind == Place::Kind::interval ? unknown.index == row.index : near(unknown.index, row.index, 0, 1);
  }
  return unknown.kind == Place::Kind::interval ? near(unknown.index, row.index, 1, 0)
                                               : near(unknown.index, row.index, 1, 1);
}

TEST(Layout, IntervalStructureHoldsForEveryEntryOfTheJacobian) {
  const auto problem = make_problem("two_link_manipulator");
  std::vector<Scheme> schemes = all_schemes();
  for (Scheme& shared : tests::schemes_with_shared_controls()) schemes.push_back(std::move(shared));
  for (const Scheme& scheme : schemes) {
    SCOPED_TRACE(scheme.label());
    const auto program = transcribe(*problem, scheme, Grid::uniform(9));
    const IntervalStructure* structure = program->interval_structure();
    ASSERT_NE(structure, nullptr);
    EXPECT_EQ(structure->intervals, 9U);
    ASSERT_EQ(structure->unknowns.size(), program->variable_count());
    ASSERT_EQ(structure->rows.size(), program->constraint_count());
    const SparsityPattern pattern = program->jacobian_structure().expand();
    for (std::size_t e = 0; e < pattern.size(); ++e) {
      const auto row = static_cast<std::size_t>(pattern.rows[e]);
      const auto column = static_cast<std::size_t>(pattern.columns[e]);
      EXPECT_TRUE(may_read(structure->rows[row], structure->unknowns[column]))
          << "row " << row << ", unknown " << column;
    }
  }
}

}  // namespace
}  // namespace dmocbench
