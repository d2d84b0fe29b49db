#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "methods/kkt/sparse_kkt.hpp"
#include "methods/transcription/transcription.hpp"
#include "tests/support/dense_kkt.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/system_choice.hpp"

namespace dmocbench::kkt {
namespace {

std::size_t place_of(const IntervalStructure& structure, std::size_t line) {
  const bool is_row = line >= structure.unknowns.size();
  const Place& place = is_row ? structure.rows[line - structure.unknowns.size()] : structure.unknowns[line];
  if (place.kind == Place::Kind::border) return 2 * structure.intervals + 1;
  return 2 * place.index + (place.kind == Place::Kind::interval ? 1U : 0U);
}

TEST(DissectionOrder, GivesEveryLineAPlaceOfItsOwn) {
  const tests::Everything everything;
  for (const tests::Scheme& scheme : tests::all_schemes(2)) {
    for (const Eigen::Index intervals : {1, 2, 9, 10, 11, 64, 100}) {
      SCOPED_TRACE(scheme.label() + ", N = " + std::to_string(intervals));
      const Transcription program(everything.problem(), *make_element(scheme.method), scheme.tableau(),
                                  Grid::uniform(intervals));
      std::vector<int> positions = dissection_order(program);
      ASSERT_EQ(positions.size(), program.variable_count() + program.constraint_count());
      std::ranges::sort(positions);
      for (std::size_t i = 0; i < positions.size(); ++i) ASSERT_EQ(positions[i], static_cast<int>(i));
    }
  }
}

/// What lies on either side of the middle is not coupled once the border and the node in the middle are left out.
TEST(DissectionOrder, PutsTheBorderLastAndTheMiddleOfTheHorizonBeforeIt) {
  const tests::Everything everything;
  constexpr Eigen::Index intervals = 64;
  for (const tests::Scheme& scheme : tests::all_schemes(2)) {
    SCOPED_TRACE(scheme.label());
    const Transcription program(everything.problem(), *make_element(scheme.method), scheme.tableau(),
                                Grid::uniform(intervals));
    const IntervalStructure& structure = *program.interval_structure();
    const std::vector<int> positions = dissection_order(program);
    std::vector<std::size_t> places(positions.size());  // in the order of elimination
    for (std::size_t line = 0; line < positions.size(); ++line) {
      places[static_cast<std::size_t>(positions[line])] = place_of(structure, line);
    }
    constexpr std::size_t middle = intervals;  // node N/2
    constexpr std::size_t border = 2 * intervals + 1;
    while (places.back() == border) places.pop_back();
    ASSERT_EQ(places.back(), middle);
    while (places.back() == middle) places.pop_back();
    const auto is_in_first_half = [](std::size_t place) { return place < middle; };
    EXPECT_TRUE(std::ranges::is_partitioned(places, is_in_first_half));
    EXPECT_EQ(std::ranges::count(places, middle) + std::ranges::count(places, border), 0);
  }
}

TEST(DissectionOrder, IsEmptyWithoutAStructure) { EXPECT_TRUE(dissection_order(tests::rosenbrock()).empty()); }

TEST(DissectionOrder, ChangesNeitherInertiaNorStep) {
  int minima = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    tests::SystemChoice choice(seed);
    const tests::RandomShape shape = choice.shape();
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + shape.label());
    tests::RandomStructuredProgram program(shape, seed);
    const tests::KktNumbers numbers = choice.numbers(program, shape.hessian);
    if (tests::DenseKkt(program, numbers).inertia().rank < 1e-6) continue;  // either order may call it singular
    Eigen::VectorXd primal(numbers.gradient.size());
    Eigen::VectorXd multipliers(numbers.rows.size());
    Eigen::VectorXd other_primal(numbers.gradient.size());
    Eigen::VectorXd other_multipliers(numbers.rows.size());
    SparseKkt found(program);
    SparseKkt along(program, SparseKkt::Order::along_the_horizon);
    const FactorisationStatus verdict =
        found.solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers});
    ASSERT_EQ(along.solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {other_primal, other_multipliers}),
              verdict);
    if (verdict != FactorisationStatus::solved) continue;
    ++minima;
    EXPECT_LT((primal - other_primal).norm(), 1e-7 * primal.norm());
    EXPECT_LT((multipliers - other_multipliers).norm(), 1e-7 * multipliers.norm());
  }
  EXPECT_GT(minima, 100);
}

}  // namespace
}  // namespace dmocbench::kkt
