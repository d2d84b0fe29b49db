#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/runtime/instruction_set.hpp"
#include "tests/expression/operations.hpp"
#include "tests/expression/random_program.hpp"
#include "tests/expression/series_table.hpp"
#include "tests/support/restored_settings.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using tests::RandomPoints;
using tests::SeriesTable;

constexpr double promise_of_instruction_sets = 1e-13;  // of the sum of magnitudes

void expect_all_agree(const Schedule& schedule, const SeriesTable& inputs, std::size_t count) {
  const SeriesTable baseline = tests::evaluate(Tape(schedule, InstructionSet::baseline), inputs, count);
  for (const InstructionSet set : available_instruction_sets()) {
    const SeriesTable found = tests::evaluate(Tape(schedule, set), inputs, count);
    for (std::size_t k = 0; k < count; ++k) {
      const auto terms = tests::replay_interval(schedule, inputs, k);
      for (std::size_t j = 0; j < found.size(); ++j) {
        ASSERT_NEAR(found[j][k], baseline[j][k], promise_of_instruction_sets * terms[j].magnitude)
            << name_of(set) << ", output " << j << ", interval " << k;
      }
    }
  }
}

struct CompareSets {
  template <class Formula>
  void operator()(const char* name, const Formula& formula, const tests::Domain& domain) const {
    SCOPED_TRACE(name);
    const ExpressionVector x = input_vector(0, 2);
    constexpr std::size_t count = 203;
    RandomPoints random;
    SeriesTable inputs(2, std::vector<double>(count));
    for (auto& column : inputs) {
      for (double& entry : column) entry = random.number(domain.low, domain.high);
    }
    expect_all_agree(Schedule(ExpressionVector{{formula(x[0], x[1])}}), inputs, count);
  }
};

TEST(InstructionSets, AgreeOnEveryOperation) { tests::visit_operations(CompareSets{}); }

TEST(InstructionSets, AgreeOnEveryPower) { tests::visit_powers(CompareSets{}); }

TEST(InstructionSets, AgreeOnRandomFormulasAndTheirSecondDerivatives) {
  RandomPoints random;
  for (int number = 0; number < 60; ++number) {
    SCOPED_TRACE(number);
    const tests::RandomProgram program(random, 3, 20, 1);
    const ExpressionVector x = input_vector(0, 3);
    const Expression f = program.run(std::span<const Expression>(x.data(), 3))[0];
    constexpr std::size_t count = 67;
    SeriesTable inputs(3, std::vector<double>(count));
    for (std::size_t i = 0; i < 3; ++i) {
      for (double& entry : inputs[i]) entry = program.point()[i] + random.number(-1e-3, 1e-3);
    }
    expect_all_agree(Schedule(ExpressionVector(hessian(f, x).reshaped())), inputs, count);
  }
}

TEST(InstructionSets, BaselineIsAlwaysThereAndNamesAreDistinct) {
  const auto& sets = available_instruction_sets();
  ASSERT_FALSE(sets.empty());
  EXPECT_EQ(sets.front(), InstructionSet::baseline);
  EXPECT_EQ(name_of(InstructionSet::baseline), "baseline");
  EXPECT_EQ(name_of(InstructionSet::avx2), "avx2");
  EXPECT_EQ(name_of(InstructionSet::avx512), "avx512");
}

class PreferredInstructionSet : public testing::Test {
 protected:
  tests::EnvironmentVariable variable_{"DMOCBENCH_INSTRUCTION_SET"};
};

TEST_F(PreferredInstructionSet, IsTheWidestUnlessTheEnvironmentNamesAnother) {
  variable_.unset();
  EXPECT_EQ(preferred_instruction_set(), available_instruction_sets().back());
  for (const InstructionSet available : available_instruction_sets()) {
    variable_.set(std::string(name_of(available)));
    EXPECT_EQ(preferred_instruction_set(), available);
    EXPECT_EQ(Tape(Schedule()).instruction_set(), available);
  }
}

TEST_F(PreferredInstructionSet, ThrowsWhenTheEnvironmentNamesNoneThatIsAvailable) {
  variable_.set("abacus");
  tests::expect_error_naming({"abacus", "baseline"}, [] { static_cast<void>(preferred_instruction_set()); });
  variable_.set("");
  EXPECT_THROW(static_cast<void>(preferred_instruction_set()), Error);
}

}  // namespace
}  // namespace dmocbench
