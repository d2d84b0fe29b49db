// A prepared solve allocates nothing after the first one.

#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "methods/solvers/prepared_solve.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/counted_allocations.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

class PreparedSolves : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!tests::counts_allocations()) GTEST_SKIP() << "malloc is not ours in this build";
  }
};

TEST_P(PreparedSolves, AllocateNothingAfterTheFirstSolve) {
  // With bounds (cart_pole), a free horizon (brachistochrone) and inequalities (hang_glider), too.
  for (const std::string name :
       {"orbital_transfer", "two_link_manipulator", "cart_pole", "brachistochrone", "hang_glider"}) {
    const auto problem = make_problem(name);
    for (const Grid& grid : {Grid::uniform(64), tests::graded_grid(16)}) {
      Transcription program(*problem, *make_element(GetParam()), gauss_tableau(1), grid);
      PreparedSolve prepared(program);
      const Eigen::VectorXd start = sample(program, guessed_motion(*problem));
      const Solution first = prepared.solve(start);
      const std::string label = name + ", N = " + std::to_string(grid.intervals());
      const std::size_t before = tests::allocations();
      const Solution& again = prepared.solve(start);
      EXPECT_EQ(tests::allocations() - before, 0U) << label << ": " << again.message;
      EXPECT_EQ(again.primal, first.primal) << label;
      const std::size_t before_warm = tests::allocations();
      static_cast<void>(prepared.solve(first.primal, first.multipliers));
      EXPECT_EQ(tests::allocations() - before_warm, 0U) << label << ", warm";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, PreparedSolves, testing::ValuesIn(paper_families()));

}  // namespace
}  // namespace dmocbench
