// Evaluations inside a solve allocate nothing. Counted at malloc, because Eigen does not go through operator new.

#include <atomic>
#include <cstddef>

#include <gtest/gtest.h>

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
extern "C" void* __libc_malloc(std::size_t size);  // NOLINT
extern "C" void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}
#endif

namespace dmocbench {
namespace {

class Evaluations : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  void SetUp() override {
    if (!DMOCBENCH_COUNTS_ALLOCATIONS) GTEST_SKIP() << "malloc is not ours in this build";
  }
};

TEST_P(Evaluations, TheCounterSeesAllocationsOfEigenAndOfTheLibrary) {
  const std::size_t before = allocations;
  const Eigen::VectorXd vector = Eigen::VectorXd::Ones(100);
  const auto number = std::make_unique<double>(vector.sum());
  EXPECT_EQ(allocations - before, 2U);
  EXPECT_EQ(*number, 100.0);
}

TEST_P(Evaluations, AllocateNothing) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    for (const int stages : {1, 2, 3}) {
      const auto& [method, derivatives] = GetParam();
      const auto program = std::make_unique<Transcription>(*problem, *make_element(method), gauss_tableau(stages),
                                                           Grid::uniform(70), derivatives);
      const Eigen::VectorXd x = sample(*program, guessed_motion(*problem));
      const auto rows = static_cast<Eigen::Index>(program->constraint_count());
      const Eigen::VectorXd multipliers = Eigen::VectorXd::Ones(rows);
      Eigen::VectorXd gradient(x.size());
      Eigen::VectorXd values(rows);
      Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program->jacobian_structure().size()));
      Eigen::VectorXd hessian(static_cast<Eigen::Index>(program->hessian_structure().size()));
      const std::size_t before = allocations;
      double sum = program->objective(x);
      program->gradient(x, gradient);
      program->constraints(x, values);
      program->jacobian(x, jacobian);
      program->hessian(x, 1.0, multipliers, hessian);
      EXPECT_EQ(allocations - before, 0U) << name << ", s = " << stages;
      sum += gradient.sum() + values.sum() + jacobian.sum() + hessian.sum();
      EXPECT_TRUE(std::isfinite(sum));
    }
  }
}

// The drivers of ADOL-C allocate; all else does not.
INSTANTIATE_TEST_SUITE_P(All, Evaluations,
                         testing::Combine(testing::ValuesIn(element_names()),
                                          testing::Values("tape", "finite_differences", "forward_differences")),
                         [](const auto& instance) {
                           return std::get<0>(instance.param) + "_" + std::get<1>(instance.param);
                         });

}  // namespace
}  // namespace dmocbench
