// A prepared solve allocates nothing after the first one. Counted at malloc, because Eigen does not go through operator
// new.

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "methods/solvers/prepared_solve.hpp"
#include "problems/registry.hpp"
#include "tests/support/solving.hpp"

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define DMOCBENCH_COUNTS_ALLOCATIONS 1
#else
#define DMOCBENCH_COUNTS_ALLOCATIONS 0
#endif

namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

#if DMOCBENCH_COUNTS_ALLOCATIONS
extern "C" void* __libc_malloc(std::size_t size);                           // NOLINT
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT
extern "C" void* __libc_realloc(void* memory, std::size_t size);            // NOLINT
extern "C" void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT
extern "C" void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}
extern "C" void* calloc(std::size_t count, std::size_t size) noexcept {
  ++allocations;
  return __libc_calloc(count, size);
}
extern "C" void* realloc(void* memory, std::size_t size) noexcept {
  ++allocations;
  return __libc_realloc(memory, size);
}
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++allocations;
  return __libc_memalign(alignment, size);
}
#endif

namespace dmocbench {
namespace {

class PreparedSolves : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!DMOCBENCH_COUNTS_ALLOCATIONS) GTEST_SKIP() << "malloc is not ours in this build";
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
      const std::size_t before = allocations;
      const Solution& again = prepared.solve(start);
      EXPECT_EQ(allocations - before, 0U) << label << ": " << again.message;
      EXPECT_EQ(again.primal, first.primal) << label;
      const std::size_t before_warm = allocations;
      static_cast<void>(prepared.solve(first.primal, first.multipliers));
      EXPECT_EQ(allocations - before_warm, 0U) << label << ", warm";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, PreparedSolves, testing::ValuesIn(element_names()));

}  // namespace
}  // namespace dmocbench
