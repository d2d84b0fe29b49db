// Outputs of machine code whose columns compete for the first-level cache.
#include "methods/expression/native/staged_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/expression/expression.hpp"
#include "methods/expression/tape.hpp"

namespace dmocbench {
namespace {

/// Columns in one memory, so many numbers apart.
class Columns {
 public:
  Columns(std::size_t count, std::size_t apart, std::size_t length)
      : memory_((count - 1) * apart + length, std::numeric_limits<double>::quiet_NaN()) {
    for (std::size_t j = 0; j < count; ++j) columns_.push_back(memory_.data() + j * apart);
  }

  [[nodiscard]] const std::vector<double*>& get() const { return columns_; }
  [[nodiscard]] const std::vector<double>& memory() const { return memory_; }

 private:
  std::vector<double> memory_;
  std::vector<double*> columns_;
};

TEST(StagedOutputs, AreNeededWhereManyColumnsBeginAMultipleOf4096BytesApart) {
  const auto are_needed = [](std::size_t count, std::size_t apart) {
    return StagedOutputs::are_needed(Columns(count, apart, 1).get());
  };
  for (const std::size_t apart : {512U, 1024U, 2048U, 5120U}) {
    EXPECT_TRUE(are_needed(30, apart)) << apart;
    EXPECT_FALSE(are_needed(12, apart)) << apart;
  }
  EXPECT_TRUE(are_needed(60, 256));
  EXPECT_TRUE(are_needed(30, 1025)) << "a number more spreads them over four places only";
  for (const std::size_t apart : {1000U, 1032U, 1088U}) EXPECT_FALSE(are_needed(30, apart)) << apart;
}

/// x + j and a sine of it: code with several stages, and more outputs than a cache has ways.
Schedule many_outputs(std::size_t count) {
  const ExpressionVector x = input_vector(0, 2);
  std::vector<Expression> outputs{x[1], Expression(3.0)};
  for (std::size_t j = 2; j < count; ++j) {
    const Expression sum = x[0] + static_cast<double>(j);
    outputs.push_back(j % 2 == 0 ? sum : x[1] * sin(sum));
  }
  return Schedule(outputs);
}

TEST(StagedOutputs, ReachTheirColumnsAndNothingBesideThem) {
  constexpr std::size_t count = 40;
  constexpr std::size_t apart = 1024;
  const Schedule schedule = many_outputs(count);
  std::vector<double> x(apart);
  for (std::size_t k = 0; k < apart; ++k) x[k] = 0.01 * static_cast<double>(k);
  const std::vector<Tape::Input> inputs{{.data = x.data()}, {.data = x.data()}};
  for (const InstructionSet set : available_instruction_sets()) {
    const Tape native(schedule, set, NativeCodeUse::always);
    const Tape interpreted(schedule, set, NativeCodeUse::never);
    Tape::Workspace of_native(native);
    Tape::Workspace of_interpreted(interpreted);
    // Whole blocks, a last block shorter than others, and one that is shorter than a vector.
    for (const auto& [begin, end] : {std::pair{0, 1024}, {0, 300}, {100, 1000}, {7, 266}, {5, 8}}) {
      const Columns found(count, apart, apart);
      const Columns expected(count, apart, apart);
      ASSERT_TRUE(StagedOutputs::are_needed(found.get()));
      native.evaluate(static_cast<std::size_t>(begin), static_cast<std::size_t>(end), inputs, found.get(), of_native);
      interpreted.evaluate(static_cast<std::size_t>(begin), static_cast<std::size_t>(end), inputs, expected.get(),
                           of_interpreted);
      EXPECT_TRUE(std::ranges::equal(found.memory(), expected.memory(),
                                     [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }))
          << name_of(set) << ", intervals " << begin << " to " << end;
    }
  }
}

TEST(StagedOutputs, AreLeftAgainWhereColumnsDoNotCompete) {
  constexpr std::size_t count = 40;
  const Tape tape(many_outputs(count), preferred_instruction_set(), NativeCodeUse::always);
  const std::vector<double> x(1024, 0.5);
  const std::vector<Tape::Input> inputs{{.data = x.data()}, {.data = x.data()}};
  Tape::Workspace workspace(tape);
  const Columns competing(count, 1024, 1024);
  const Columns spread(count, 1032, 1024);
  tape.evaluate(1024, inputs, competing.get(), workspace);
  tape.evaluate(1024, inputs, spread.get(), workspace);
  for (std::size_t j = 0; j < count; ++j) {
    EXPECT_TRUE(std::ranges::equal(std::span(competing.get()[j], 1024), std::span(spread.get()[j], 1024))) << j;
  }
}

}  // namespace
}  // namespace dmocbench
