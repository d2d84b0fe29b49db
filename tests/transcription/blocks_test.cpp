#include "methods/transcription/blocks.hpp"

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "problems/two_link_with_motors.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/wider_problems.hpp"

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

TEST(Blocks, AddsPerIntervalWhatTheSavingsRemarkCounts) {
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

TEST(Blocks, GivesDmocThreeFifthsAndTwoThirdsOfTheVariables) {
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

TEST(Blocks, CountsTheWholeProgramAsNodesPlusIntervals) {
  const auto problem = make_problem("orbital_transfer");  // n = 2, m = 1
  constexpr std::size_t intervals = 10;
  const Counts dmoc = counts(*problem, {"dmoc", 2}, intervals);
  EXPECT_EQ(dmoc.variables, 2 * (intervals + 1) + intervals * (2 + 2));
  EXPECT_EQ(dmoc.rows, 2 * (intervals + 1) + intervals * 2);
  const Counts collocation = counts(*problem, {"tangent", 2}, intervals);
  EXPECT_EQ(collocation.variables, 4 * (intervals + 1) + intervals * (4 + 2));
  EXPECT_EQ(collocation.rows, intervals * 8);
}

TEST(Blocks, WithSharedControlsHasOneFewerPerIntervalAndTheSameRows) {
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

TEST(Blocks, SharedControlsOfNeighboursAreTheSameUnknown) {
  const auto program =
      transcribe(*make_problem("two_link_manipulator"), {"tangent", 3, "lobatto_shared"}, Grid::uniform(5));
  for (Eigen::Index i = 0; i < 2; ++i) {
    EXPECT_EQ(program->blocks().unknown(Quantity::control, 2).at(i),
              program->blocks().unknown(Quantity::control, 0).at(i) + 1);
  }
}

/// Blocks follow each other without gaps and are as long as the places of the structure say.
template <class Kind>
void expect_partition(const std::vector<Block<Kind>>& blocks, const Places& places) {
  std::size_t next = 0;
  for (const Block<Kind>& block : blocks) {
    EXPECT_EQ(block.head, next);
    EXPECT_GT(block.width, 0);
    next += static_cast<std::size_t>(block.width) * block.length;
    const Place first = places[block.head];
    EXPECT_EQ(first.kind == Place::Kind::border, block.support == Support::border);
    EXPECT_EQ(first.kind == Place::Kind::interval, block.support == Support::intervals);
    EXPECT_EQ(first.index, block.node);
  }
  EXPECT_EQ(next, places.size());
}

/// An interval has everything that is its own, and what all intervals or its two nodes have: each once.
/// `is_of_one_node` marks members that no interval has.
void expect_places_of_intervals(const std::vector<SeriesPlace>& series, const Places& places, std::size_t intervals,
                                const std::vector<bool>& is_of_one_node) {
  std::vector<std::size_t> found(places.size(), 0);
  for (std::size_t k = 0; k < intervals; ++k) {
    for (const SeriesPlace& place : series) {
      const std::size_t number = place.at(k);
      ASSERT_LT(number, places.size());
      ++found[number];
      const Place at = places[number];
      const std::size_t last = at.kind == Place::Kind::node ? k + 1 : k;
      EXPECT_TRUE(at.kind == Place::Kind::border || at.index == k || at.index == last);
      EXPECT_EQ(at.kind == Place::Kind::border, place.is_global);
    }
  }
  for (std::size_t number = 0; number < found.size(); ++number) {
    const Place at = places[number];
    const bool is_end = at.index == 0 || at.index == intervals;
    std::size_t expected = at.kind == Place::Kind::node && !is_end ? 2 : 1;
    if (at.kind == Place::Kind::border) expected = intervals;
    EXPECT_EQ(found[number], is_of_one_node[number] ? 0 : expected) << number;
  }
}

template <class Kind>
std::vector<bool> members_of_one_node(const std::vector<Block<Kind>>& blocks, std::size_t count) {
  std::vector<bool> marks(count, false);
  for (const Block<Kind>& block : blocks) {
    for (Eigen::Index i = 0; i < block.width && block.support == Support::one_node; ++i) marks[block.at(i)] = true;
  }
  return marks;
}

void expect_consistent(const Transcription& program) {
  const ProgramBlocks& blocks = program.blocks();
  const IntervalStructure& structure = blocks.structure();
  expect_partition(blocks.unknowns(), structure.unknowns);
  expect_partition(blocks.rows(), structure.rows);
  expect_places_of_intervals(blocks.unknown_places(), structure.unknowns, blocks.intervals(),
                             members_of_one_node(blocks.unknowns(), program.variable_count()));
  std::vector<bool> others = members_of_one_node(blocks.rows(), program.constraint_count());
  const RowBlock& conditions = blocks.row(Equation::boundary_condition);
  for (Eigen::Index i = 0; i < conditions.width; ++i) others[conditions.at(i)] = true;
  expect_places_of_intervals(blocks.row_places(), structure.rows, blocks.intervals(), others);
  EXPECT_EQ(blocks.unknown_places().size(), program.functions().inputs.unknowns);
  EXPECT_EQ(blocks.row_places().size(), program.functions().inputs.rows);
  if (const auto& ends = program.end_functions()) {
    EXPECT_EQ(blocks.end_unknown_places().size(), ends->inputs.unknowns);
    EXPECT_EQ(blocks.end_row_places().size(), ends->inputs.rows);
  }
}

/// True if a method has such a program.
bool is_consistent_if_offered(const Problem& problem, const Scheme& scheme, CostForm form) {
  SCOPED_TRACE(problem.name() + ", " + scheme.label());
  std::unique_ptr<Transcription> program;
  try {
    program = std::make_unique<Transcription>(problem, *make_element(scheme.method), scheme.tableau(), Grid::uniform(7),
                                              "tape", form);
  } catch (const Error&) {
    return false;
  }
  expect_consistent(*program);
  return true;
}

TEST(Blocks, PartitionTheNumbersOfEveryProblemByEveryMethod) {
  for (const std::string& name : problem_names()) {
    const auto problem = make_problem(name);
    int programs = 0;
    for (const std::string& method : all_methods()) {
      for (const CostForm form : {CostForm::bolza, CostForm::mayer}) {
        programs += is_consistent_if_offered(*problem, {method, 1}, form) ? 1 : 0;
      }
    }
    EXPECT_GT(programs, 0) << name;
  }
}

TEST(Blocks, PartitionTheNumbersOfStatementsWithEverythingByEveryTableau) {
  const TwoLinkWithMotors arm;
  const tests::Restated passing(arm, [](tests::Restated::Statement& s) {
    s.interior = {{.relative_time = 0.4, .v = tests::all_between(2, 1.0, 2.0)},
                  {.relative_time = 0.7, .q = tests::all_between(2, -1.0, 1.0)}};
  });
  const tests::UnknownMass unknown_mass;
  const tests::Everything everything;
  for (const Problem* problem :
       {static_cast<const Problem*>(&passing), static_cast<const Problem*>(&unknown_mass), &everything.problem()}) {
    int programs = 0;
    for (const std::string& method : all_methods()) {
      for (const std::string& family : tableau_names()) {
        const int stages = tableau_stages(family).front() + 1;
        programs += is_consistent_if_offered(*problem, {method, stages, family}, CostForm::mayer) ? 1 : 0;
      }
    }
    EXPECT_GT(programs, 0);
  }
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

TEST(Blocks, IntervalStructureHoldsForEveryEntryOfTheJacobian) {
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
