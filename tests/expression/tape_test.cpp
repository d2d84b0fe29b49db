#include "methods/expression/tape.hpp"

#include <cmath>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "tests/expression/operations.hpp"
#include "tests/expression/random_program.hpp"
#include "tests/expression/series_table.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using tests::Domain;
using tests::evaluate;
using tests::interval_counts;
using tests::RandomPoints;
using tests::RandomProgram;
using tests::replay_interval;
using tests::SeriesTable;
using tests::Terms;

constexpr double promise_of_tape = 1e-13;  // of the sum of magnitudes

SeriesTable random_series(RandomPoints& random, std::size_t columns, std::size_t count, const Domain& domain) {
  SeriesTable result(columns, std::vector<double>(count));
  for (std::vector<double>& column : result) {
    for (double& entry : column) entry = random.number(domain.low, domain.high);
  }
  return result;
}

void expect_equals_replay(const Schedule& schedule, const SeriesTable& inputs, std::size_t count) {
  for (const InstructionSet set : available_instruction_sets()) {
    SCOPED_TRACE(name_of(set));
    const SeriesTable found = evaluate(Tape(schedule, set), inputs, count);
    for (std::size_t k = 0; k < count; ++k) {
      const std::vector<Terms> expected = replay_interval(schedule, inputs, k);
      for (std::size_t j = 0; j < found.size(); ++j) {
        ASSERT_NEAR(found[j][k], expected[j].value, promise_of_tape * expected[j].magnitude)
            << "output " << j << ", interval " << k << " of " << count;
      }
    }
  }
}

struct CompareWithReplay {
  template <class Formula>
  void operator()(const char* name, const Formula& formula, const Domain& domain) const {
    SCOPED_TRACE(name);
    const ExpressionVector x = input_vector(0, 2);
    const Schedule schedule(ExpressionVector{{formula(x[0], x[1]), formula(x[1], x[0])}});
    RandomPoints random;
    for (const std::size_t count : interval_counts()) {
      expect_equals_replay(schedule, random_series(random, 2, count, domain), count);
    }
  }
};

TEST(Tape, EqualsReplayForEveryOperation) { tests::visit_operations(CompareWithReplay{}); }

TEST(Tape, EqualsReplayForEveryPower) { tests::visit_powers(CompareWithReplay{}); }

TEST(Tape, EqualsReplayForRandomFormulasAndTheirSecondDerivatives) {
  RandomPoints random;
  for (int number = 0; number < 60; ++number) {
    SCOPED_TRACE(number);
    constexpr std::size_t inputs = 3;
    const RandomProgram program(random, inputs, 20, 2);
    const ExpressionVector x = input_vector(0, inputs);
    const std::vector<Expression> f = program.run(std::span<const Expression>(x.data(), inputs));
    const ExpressionMatrix second = hessian(f[0] * f[1], x);
    ExpressionVector outputs(2 + second.size());
    outputs << f[0], f[1], second.reshaped();
    const std::size_t count = 60 + static_cast<std::size_t>(number) % 10;
    // Close to the point that the program was grown around: inside all domains.
    SeriesTable columns = random_series(random, inputs, count, {-1e-3, 1e-3});
    for (std::size_t i = 0; i < inputs; ++i) {
      for (double& entry : columns[i]) entry += program.point()[i];
    }
    expect_equals_replay(Schedule(outputs), columns, count);
  }
}

TEST(Tape, ResultOfAnIntervalDependsNeitherOnItsPlaceNorOnItsNeighbours) {
  const ExpressionVector x = input_vector(0, 1);
  const Schedule schedule(ExpressionVector{{sin(x[0]) * exp(x[0]), cos(x[0]) / x[0]}});
  RandomPoints random;
  for (const InstructionSet set : available_instruction_sets()) {
    const Tape tape(schedule, set);
    const SeriesTable alone = evaluate(tape, {{0.75}}, 1);
    for (const std::size_t count : interval_counts()) {
      if (count == 0) continue;
      for (const std::size_t place : {std::size_t{0}, count / 2, count - 1}) {
        SeriesTable inputs = random_series(random, 1, count, {-0.78, 0.78});
        inputs[0][place] = 0.75;
        const SeriesTable found = evaluate(tape, inputs, count);
        EXPECT_EQ(found[0][place], alone[0][0]) << name_of(set) << ", " << count;
        EXPECT_EQ(found[1][place], alone[1][0]) << name_of(set) << ", " << count;
      }
    }
  }
}

TEST(Tape, LastBlockMayBePartial) {
  const Expression x = Expression::input(0);
  const Tape tape(Schedule(ExpressionVector{{x * x + 1.0}}));
  for (std::size_t count = 0; count <= 2 * Tape::block_width + 1; ++count) {
    SeriesTable inputs(1, std::vector<double>(count));
    for (std::size_t k = 0; k < count; ++k) inputs[0][k] = static_cast<double>(k);
    const SeriesTable found = evaluate(tape, inputs, count);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_EQ(found[0][k], static_cast<double>(k * k + 1)) << count;
    }
  }
}

TEST(Tape, OneValueServesAllIntervalsWhereAnInputIsTheSameForAll) {
  const ExpressionVector x = input_vector(0, 2);
  const Tape tape(Schedule(ExpressionVector{{x[0] * x[1], x[1] - x[0]}}));
  Tape::Workspace workspace(tape);
  const std::vector<double> step{0.25};
  std::vector<double> varying(150);
  for (std::size_t k = 0; k < varying.size(); ++k) varying[k] = static_cast<double>(k);
  std::vector<double> product(150);
  std::vector<double> difference(150);
  const std::vector<double*> outputs{product.data(), difference.data()};
  // On one workspace, one way, the other and back: nothing of an earlier evaluation is left.
  for (const bool swapped : {false, true, false}) {
    const Tape::Input one{step.data(), true};
    const Tape::Input many{varying.data(), false};
    const std::vector<Tape::Input> inputs = swapped ? std::vector{many, one} : std::vector{one, many};
    tape.evaluate(150, inputs, outputs, workspace);
    for (std::size_t k = 0; k < 150; ++k) {
      EXPECT_EQ(product[k], 0.25 * varying[k]);
      EXPECT_EQ(difference[k], swapped ? 0.25 - varying[k] : varying[k] - 0.25);
    }
  }
}

TEST(Tape, OutputsMayBeConstantsInputsAndRepetitions) {
  const ExpressionVector x = input_vector(0, 2);
  const Expression sum = x[0] + x[1];
  const ExpressionVector outputs{{Expression(2.5), x[1], sum, x[1], sum, Expression(2.5), Expression(), sum * sum}};
  const Tape tape{Schedule(outputs)};
  for (const std::size_t count : interval_counts()) {
    RandomPoints random;
    const SeriesTable inputs = random_series(random, 2, count, {-1.0, 1.0});
    const SeriesTable found = evaluate(tape, inputs, count);
    for (std::size_t k = 0; k < count; ++k) {
      const double s = inputs[0][k] + inputs[1][k];
      const std::vector<double> expected{2.5, inputs[1][k], s, inputs[1][k], s, 2.5, 0.0, s * s};
      for (std::size_t j = 0; j < expected.size(); ++j) EXPECT_EQ(found[j][k], expected[j]) << j;
    }
  }
  EXPECT_EQ(tape.operation_count(), 2U);
}

TEST(Tape, ZeroAndMinusZeroAreDifferentConstants) {
  const Tape tape(Schedule(ExpressionVector{{Expression(0.0), Expression(-0.0)}}));
  const SeriesTable found = evaluate(tape, {}, 1);
  EXPECT_FALSE(std::signbit(found[0][0]));
  EXPECT_TRUE(std::signbit(found[1][0]));
}

TEST(Tape, WithoutOutputsHasNothingToDo) {
  const Tape none;
  Tape::Workspace workspace(none);
  EXPECT_NO_THROW(none.evaluate(10, {}, {}, workspace));
  EXPECT_EQ(none.output_count(), 0U);
  EXPECT_EQ(none.operation_count(), 0U);
}

TEST(Tape, SlotsAreReusedAlongAChain) {
  Expression x = Expression::input(0);
  for (int i = 0; i < 1000; ++i) x = sin(x) + Expression::input(1);
  const Tape tape(Schedule(ExpressionVector{{x}}));
  EXPECT_EQ(tape.operation_count(), 2000U);
  EXPECT_LE(tape.slot_count(), 2U);
}

TEST(Tape, SlotsHoldWhatIsAliveAtOnce) {
  // Of a balanced tree of 4^4 leaves, four of which are multiplied by one instruction, three per level wait at most
  // while the fourth is at work.
  std::vector<Expression> level;
  level.reserve(256);
  for (std::size_t i = 0; i < 256; ++i) level.push_back(sin(Expression::input(i)));
  while (level.size() > 1) {
    std::vector<Expression> next;
    for (std::size_t i = 0; i < level.size(); i += 2) next.push_back(level[i] * level[i + 1]);
    level = next;
  }
  const Tape tape{Schedule(std::span<const Expression>(level))};
  EXPECT_EQ(tape.operation_count(), 511U);
  EXPECT_LE(tape.slot_count(), 13U);
}

TEST(Tape, TooFewInputsOrOutputsThrow) {
  const ExpressionVector x = input_vector(0, 3);
  const Tape tape(Schedule(ExpressionVector{{x[0] + x[2], x[1]}}));
  ASSERT_EQ(tape.input_count(), 3U);
  Tape::Workspace workspace(tape);
  const double number = 1.0;
  std::vector<double> results(2);
  const std::vector<Tape::Input> inputs(3, {&number, true});
  const std::vector<double*> outputs{results.data(), results.data() + 1};
  EXPECT_NO_THROW(tape.evaluate(1, inputs, outputs, workspace));
  const std::span<const Tape::Input> fewer_inputs(inputs.data(), 2);
  const std::span<double* const> fewer_outputs(outputs.data(), 1);
  tests::expect_error_naming({"3 inputs", "got 2"}, [&] { tape.evaluate(1, fewer_inputs, outputs, workspace); });
  tests::expect_error_naming({"2 outputs", "1"}, [&] { tape.evaluate(1, inputs, fewer_outputs, workspace); });
}

TEST(Tape, AnotherTapesWorkspaceThrowsEvenIfItHasTheSameShape) {
  const Expression x = Expression::input(0);
  const Tape doubled(Schedule(ExpressionVector{{2.0 * x}}));
  const Tape tripled(Schedule(ExpressionVector{{3.0 * x}}));
  const Tape larger(Schedule(ExpressionVector{{sin(x) * cos(x)}}));
  const double number = 1.0;
  double result = 0.0;
  const std::vector<Tape::Input> inputs{{&number, false}};
  const std::vector<double*> outputs{&result};
  Tape::Workspace workspace(doubled);
  EXPECT_THROW(larger.evaluate(1, inputs, outputs, workspace), Error);
  EXPECT_THROW(tripled.evaluate(1, inputs, outputs, workspace), Error);
  EXPECT_NO_THROW(doubled.evaluate(1, inputs, outputs, workspace));
  EXPECT_EQ(result, 2.0);
}

TEST(Tape, ACopyTakesTheSameWorkspaceAndAMovedWorkspaceStillServes) {
  const Expression x = Expression::input(0);
  const Tape tape(Schedule(ExpressionVector{{2.0 * sin(x) + x}}));
  const Tape copy = tape;  // NOLINT(performance-unnecessary-copy-initialization): the copy is tested
  Tape::Workspace first(tape);
  Tape::Workspace second = std::move(first);
  const double number = 1.0;
  double result = 0.0;
  const std::vector<Tape::Input> inputs{{&number, true}};
  copy.evaluate(1, inputs, std::vector<double*>{&result}, second);
  EXPECT_NEAR(result, 2.0 * std::sin(1.0) + 1.0, 1e-15 * 4.0);
  // A copy's table of series would point into the slots of the original.
  static_assert(!std::is_copy_constructible_v<Tape::Workspace>);
  static_assert(!std::is_copy_assignable_v<Tape::Workspace>);
}

}  // namespace
}  // namespace dmocbench
