// Evaluations inside a solve allocate nothing.

#include <cstddef>

#include <gtest/gtest.h>

#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/counted_allocations.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

class Evaluations : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  void SetUp() override {
    if (!tests::counts_allocations()) GTEST_SKIP() << "malloc is not ours in this build";
  }
};

TEST_P(Evaluations, TheCounterSeesAllocationsOfEigenAndOfTheLibrary) {
  const std::size_t before = tests::allocations();
  const Eigen::VectorXd vector = Eigen::VectorXd::Ones(100);
  const auto number = std::make_unique<double>(vector.sum());
  EXPECT_EQ(tests::allocations() - before, 2U);
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
      const std::size_t before = tests::allocations();
      double sum = program->objective(x);
      program->gradient(x, gradient);
      program->constraints(x, values);
      program->jacobian(x, jacobian);
      program->hessian(x, 1.0, multipliers, hessian);
      EXPECT_EQ(tests::allocations() - before, 0U) << name << ", s = " << stages;
      sum += gradient.sum() + values.sum() + jacobian.sum() + hessian.sum();
      EXPECT_TRUE(std::isfinite(sum));
    }
  }
}

// The drivers of ADOL-C allocate; all else does not.
INSTANTIATE_TEST_SUITE_P(
    All, Evaluations,
    testing::Combine(testing::ValuesIn(paper_families()),
                     testing::Values("tape", "finite_differences", "forward_differences", "dense_differences")),
    [](const auto& instance) { return std::get<0>(instance.param) + "_" + std::get<1>(instance.param); });

}  // namespace
}  // namespace dmocbench
