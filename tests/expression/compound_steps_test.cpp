#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "methods/expression/tape.hpp"
#include "tests/expression/random_program.hpp"
#include "tests/expression/series_table.hpp"

namespace dmocbench {
namespace {

using tests::RandomPoints;
using tests::SeriesTable;

using Operator = std::function<Expression(const Expression&, const Expression&)>;

const std::array<Operator, 3>& operators() {
  static const std::array<Operator, 3> all{std::plus<>(), std::minus<>(), std::multiplies<>()};
  return all;
}

SeriesTable random_series(std::size_t columns, std::size_t count) {
  RandomPoints random;
  SeriesTable result(columns, std::vector<double>(count));
  for (std::vector<double>& column : result) {
    for (double& entry : column) entry = random.number(-2.0, 2.0);
  }
  return result;
}

void expect_same_bits_as_replay(const Schedule& schedule, const SeriesTable& inputs) {
  const std::size_t count = inputs.front().size();
  for (const InstructionSet set : available_instruction_sets()) {
    const SeriesTable found = tests::evaluate(Tape(schedule, set), inputs, count);
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<double> point;
      point.reserve(inputs.size());
      for (const std::vector<double>& column : inputs) point.push_back(column[k]);
      const std::vector<double> expected = replay<double>(schedule, point);
      for (std::size_t j = 0; j < expected.size(); ++j) {
        ASSERT_EQ(found[j][k], expected[j]) << name_of(set) << ", output " << j << ", interval " << k;
      }
    }
  }
}

/// How many steps of a schedule an instruction carries out.
std::size_t operations_of(const CompoundStep& compound) {
  if (compound.code == instruction_code::sine_and_cosine) return 2;
  return compound.code < instruction_code::first_pair ? 1 : compound.operand_count - 1;
}

/// Three operations on four numbers, in every shape; one at a time, since formulas share their parts.
Expression shaped(int shape, const Operator& f, const Operator& g, const Operator& h) {
  const ExpressionVector x = input_vector(0, 4);
  const Expression pair = f(x[0], x[1]);
  if (shape == 0) return h(pair, g(x[2], x[3]));
  Expression triple = (shape & 2) != 0 ? g(pair, x[2]) : g(x[2], pair);
  if (shape < 4) return (shape & 1) != 0 ? h(triple, x[3]) : h(x[3], triple);
  return triple;
}

/// Formulas put some signs at the end, of a product with a difference say.
std::size_t negations(const Schedule& schedule) {
  const auto is_negation = [](const Schedule::Step& step) { return step.operation == Operation::negate; };
  return static_cast<std::size_t>(std::count_if(schedule.steps().begin(), schedule.steps().end(), is_negation));
}

TEST(CompoundSteps, EveryShapeIsOneInstructionAndChangesNoBit) {
  const SeriesTable inputs = random_series(4, Tape::block_width + 13);
  for (const Operator& f : operators()) {
    for (const Operator& g : operators()) {
      for (const Operator& h : operators()) {
        for (int shape = 0; shape < 7; ++shape) {
          const Expression formula = shaped(shape, f, g, h);
          const Schedule schedule(std::span(&formula, 1));
          EXPECT_EQ(compound_steps(schedule).size(), 1 + negations(schedule));
          expect_same_bits_as_replay(schedule, inputs);
        }
      }
    }
  }
}

TEST(CompoundSteps, AValueWithASecondReaderIsComputedOnceAndKept) {
  const Expression a = Expression::input(0);
  const Expression b = Expression::input(1);
  const Expression sum = a + b;
  EXPECT_EQ(compound_steps(Schedule(ExpressionVector{{sum * a}})).size(), 1U);
  EXPECT_EQ(compound_steps(Schedule(ExpressionVector{{sum * sum}})).size(), 2U);
  EXPECT_EQ(compound_steps(Schedule(ExpressionVector{{sum * a, sum * b}})).size(), 3U);
  EXPECT_EQ(compound_steps(Schedule(ExpressionVector{{sum * a, sum}})).size(), 2U);
}

TEST(CompoundSteps, OfTwoReadyOperandsTheOneThatFitsIsAbsorbed) {
  const ExpressionVector x = input_vector(0, 6);
  const Expression four = x[0] * x[1] + x[2] * x[3];  // an instruction can read no more
  const Schedule schedule(ExpressionVector{{four - x[4] * x[5]}});
  EXPECT_EQ(compound_steps(schedule).size(), 2U);
  expect_same_bits_as_replay(schedule, random_series(6, 9));
}

TEST(CompoundSteps, ASineAndACosineOfOneNumberAreFoundTogether) {
  const Expression x = Expression::input(0);
  const Schedule both(ExpressionVector{{sin(x), cos(x)}});
  const Schedule swapped(ExpressionVector{{cos(x), sin(x)}});
  ASSERT_EQ(compound_steps(both).size(), 1U);
  ASSERT_EQ(compound_steps(swapped).size(), 1U);
  EXPECT_EQ(compound_steps(Schedule(ExpressionVector{{sin(x), cos(2.0 * x)}})).size(), 3U);
  constexpr std::size_t count = Tape::block_width + 13;
  SeriesTable inputs = random_series(1, count);
  for (double& entry : inputs[0]) entry *= 50.0;
  for (const InstructionSet set : available_instruction_sets()) {
    const SeriesTable found = tests::evaluate(Tape(both, set), inputs, count);
    const SeriesTable exchanged = tests::evaluate(Tape(swapped, set), inputs, count);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_NEAR(found[0][k], std::sin(inputs[0][k]), 1e-15);
      EXPECT_NEAR(found[1][k], std::cos(inputs[0][k]), 1e-15);
      EXPECT_EQ(found[0][k], exchanged[1][k]);
      EXPECT_EQ(found[1][k], exchanged[0][k]);
    }
  }
}

TEST(CompoundSteps, CarryOutEveryStepOnceAfterItsOperands) {
  RandomPoints random;
  for (int number = 0; number < 100; ++number) {
    SCOPED_TRACE(number);
    constexpr std::size_t inputs = 4;
    const tests::RandomProgram program(random, inputs, 60, 5);
    const ExpressionVector x = input_vector(0, inputs);
    const std::vector<Expression> outputs = program.run(std::span<const Expression>(x.data(), inputs));
    const Schedule schedule(outputs);
    std::vector<bool> is_there(schedule.steps().size());
    for (std::size_t i = 0; i < is_there.size(); ++i) {
      is_there[i] = operand_count(schedule.steps()[i].operation) == 0;
    }
    std::size_t operations = 0;
    for (const CompoundStep& compound : compound_steps(schedule)) {
      for (std::size_t i = 0; i < compound.operand_count; ++i) EXPECT_TRUE(is_there[compound.operands[i]]);
      EXPECT_FALSE(is_there[compound.step]);
      is_there[compound.step] = true;
      if (compound.cosine) is_there[*compound.cosine] = true;
      operations += operations_of(compound);
    }
    EXPECT_EQ(operations, schedule.operation_count());
    for (const std::uint32_t output : schedule.outputs()) EXPECT_TRUE(is_there[output]);
  }
}

}  // namespace
}  // namespace dmocbench
