// The method stands in the code twice, for one iterate and for eight side by side. Both have to go the same way.

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/solvers/batch/batch_case.hpp"

namespace dmocbench::batch {
namespace {

constexpr std::size_t compared = 1000;

/// How many instances of a problem take as many iterations in a batch as alone, to the same cost and the same end.
std::size_t equal_solves(const std::string& problem, double share) {
  Case some(problem, "dmoc", 1, 16);
  const std::vector<BatchInstance> instances = some.instances(compared, share);
  const std::vector<Solution> solutions = some.solve(instances);
  std::size_t equal = 0;
  for (std::size_t i = 0; i < compared; ++i) {
    const Solution alone = some.solve_alone(instances[i]);
    const bool is_same_cost = std::abs(solutions[i].objective - alone.objective) <= 1e-10 * std::abs(alone.objective);
    if (is_same_cost && solutions[i].status == alone.status && solutions[i].major_iterations == alone.major_iterations)
      ++equal;
  }
  // What is solved one by one takes the same way anyway.
  EXPECT_LE(some.summary.solved_one_by_one, compared / 50) << problem;
  return equal;
}

/// Not by all: where a single solve corrects a step to second order a lane halves it (cart_pole), and a lane sums in
/// another order, so that close decisions may fall otherwise. Behind each bound stands what was measured, the same
/// within 8 of 1,000 by AVX-512, AVX2 and without either; 2 % of the instances are left as margin.
TEST(EqualIterations, AreTakenByBatchesAndSingleSolves) {
  EXPECT_GE(equal_solves("orbital_transfer", 0.05), 950U);      // 972
  EXPECT_GE(equal_solves("two_link_manipulator", 0.05), 905U);  // 923 to 931
  EXPECT_GE(equal_solves("cart_pole", 0.02), 780U);             // 803
  EXPECT_GE(equal_solves("hovercraft", 0.05), 960U);            // 982
}

}  // namespace
}  // namespace dmocbench::batch
