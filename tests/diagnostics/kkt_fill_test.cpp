#include "methods/diagnostics/kkt_fill.hpp"

#include <gtest/gtest.h>

#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

TEST(KktFill, CountsWhatTheProgramHasInFreeVariables) {
  const auto problem = make_problem("two_link_manipulator");
  const auto program = tests::transcribe(*problem, {"dmoc", 1}, Grid::uniform(3));
  std::size_t expected = free_variable_count(*program) + program->constraint_count();  // the diagonal
  const auto is_free = [&](int j) { return program->variable_lower()[j] != program->variable_upper()[j]; };
  program->hessian_structure().for_each([&](Eigen::Index /*entry*/, int row, int column) {
    expected += row != column && is_free(row) && is_free(column) ? 1 : 0;
  });
  for (const int column : program->jacobian_structure().expand().columns) expected += is_free(column) ? 1 : 0;
  const KktFill fill = kkt_fill(*program);
  EXPECT_EQ(fill.nonzeros, expected);
  EXPECT_GE(fill.factor_nonzeros, fill.nonzeros);
}

TEST(KktFill, GrowsInProportionToTheNumberOfIntervals) {
  // A chain of intervals has a factor without long-range fill, whatever the method.
  const auto problem = make_problem("two_link_manipulator");
  for (const std::string& method : paper_families()) {
    const KktFill coarse = kkt_fill(*tests::transcribe(*problem, {method, 1}, Grid::uniform(64)));
    const KktFill fine = kkt_fill(*tests::transcribe(*problem, {method, 1}, Grid::uniform(256)));
    EXPECT_NEAR(static_cast<double>(fine.nonzeros) / static_cast<double>(coarse.nonzeros), 4.0, 0.1) << method;
    EXPECT_NEAR(static_cast<double>(fine.factor_nonzeros) / static_cast<double>(coarse.factor_nonzeros), 4.0, 0.4)
        << method;
  }
}

TEST(KktFill, IsLessForDmocThanForCollocation) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    const KktFill dmoc = kkt_fill(*tests::transcribe(*problem, {"dmoc", 1}, Grid::uniform(64)));
    const KktFill hamiltonian = kkt_fill(*tests::transcribe(*problem, {"hamiltonian", 1}, Grid::uniform(64)));
    EXPECT_LT(dmoc.nonzeros, hamiltonian.nonzeros) << name;
  }
}

}  // namespace
}  // namespace dmocbench
