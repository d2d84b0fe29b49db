// Sharing and folding decide what derivatives cost: the Hessian of the Lagrangian of one interval has few operations.
#include <gtest/gtest.h>

#include "methods/transcription/interval_functions.hpp"
#include "problems/registry.hpp"

namespace dmocbench {
namespace {

std::size_t hessian_operations(const char* name, int stages) {
  const auto problem = make_problem(name);
  const TracedProblem traced(*problem);
  return trace_interval(traced, *make_element("dmoc"), make_tableau("gauss", stages),
                        {.cost_scale = problem->cost_scale()})
      .hessian.schedule.operation_count();
}

TEST(OperationCount, MidpointHessianOfTheOrbitNeedsAtMostFifty) {
  EXPECT_LE(hessian_operations("orbital_transfer", 1), 50U);
}

TEST(OperationCount, MidpointHessianOfTheTwoLinkNeedsAtMostOneHundredAndThirty) {
  EXPECT_LE(hessian_operations("two_link_manipulator", 1), 130U);
}

TEST(OperationCount, StagesShareNothingThatGrowsFasterThanTheirPairs) {
  // Every entry of the Hessian sums over the stages; there are O(s^2) entries.
  const std::size_t one = hessian_operations("two_link_manipulator", 1);
  EXPECT_LT(hessian_operations("two_link_manipulator", 3), 27 * one);
}

}  // namespace
}  // namespace dmocbench
