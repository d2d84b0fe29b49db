#include "methods/expression/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "tests/expression/random_program.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

Schedule schedule_of(const Expression& f) { return Schedule(std::span(&f, 1)); }

long count(const Schedule& schedule, Operation operation) {
  return std::count_if(schedule.steps().begin(), schedule.steps().end(),
                       [&](const Schedule::Step& step) { return step.operation == operation; });
}

double value(const Expression& f, const std::vector<double>& point) {
  return replay<double>(schedule_of(f), std::span<const double>(point))[0];
}

TEST(Schedule, CountsOperationsButNeitherConstantsNorInputs) {
  const ExpressionVector x = input_vector(0, 2);
  EXPECT_EQ(schedule_of(Expression(3.0)).operation_count(), 0U);
  EXPECT_EQ(schedule_of(x[1]).operation_count(), 0U);
  EXPECT_EQ(schedule_of(2.0 * x[0] + x[1]).operation_count(), 2U);
  EXPECT_EQ(schedule_of(sin(x[0]) * cos(x[0])).operation_count(), 3U);
  EXPECT_EQ(schedule_of(atan2(x[0], x[1])).operation_count(), 1U);
  EXPECT_EQ(schedule_of(pow(x[0], 2.5)).operation_count(), 1U);
}

TEST(Schedule, ComputesASharedPartOnce) {
  const ExpressionVector x = input_vector(0, 2);
  const Expression shared = exp(x[0] + x[1]);
  const Schedule schedule(ExpressionVector{{shared * x[0], shared * x[1], shared}});
  EXPECT_EQ(schedule.operation_count(), 4U);
  EXPECT_EQ(count(schedule, Operation::exponential), 1);
}

TEST(Schedule, PowersOfIntegersAreFewProducts) {
  const Expression x = Expression::input(0);
  EXPECT_EQ(schedule_of(pow(x, 16.0)).operation_count(), 4U);
  EXPECT_EQ(schedule_of(pow(x, 15.0)).operation_count(), 6U);
  EXPECT_EQ(schedule_of(pow(x, -2.0)).operation_count(), 2U);
  EXPECT_EQ(schedule_of(pow(x, 17.0)).operation_count(), 1U);
}

TEST(Schedule, AReciprocalWithOneReaderBecomesAQuotientAgain) {
  const ExpressionVector x = input_vector(0, 2);
  const Schedule schedule = schedule_of(x[0] / x[1]);
  EXPECT_EQ(schedule.operation_count(), 1U);
  EXPECT_EQ(count(schedule, Operation::divide), 1);
}

TEST(Schedule, AReciprocalWithSeveralReadersIsComputedOnce) {
  const ExpressionVector x = input_vector(0, 3);
  const Schedule schedule(ExpressionVector{{x[0] / x[2], x[1] / x[2]}});
  EXPECT_EQ(count(schedule, Operation::reciprocal), 1);
  EXPECT_EQ(count(schedule, Operation::divide), 0);
  EXPECT_EQ(schedule.operation_count(), 3U);
}

TEST(Schedule, AReciprocalThatIsAnOutputItselfStays) {
  const ExpressionVector x = input_vector(0, 2);
  const Schedule schedule(ExpressionVector{{x[0] / x[1], 1.0 / x[1]}});
  EXPECT_EQ(count(schedule, Operation::reciprocal), 1);
  EXPECT_EQ(count(schedule, Operation::multiply), 1);
  EXPECT_EQ(schedule.operation_count(), 2U);
}

TEST(Schedule, ASignCostsNothingBeforeANumericFactorOrADifference) {
  const ExpressionVector x = input_vector(0, 2);
  EXPECT_EQ(schedule_of(-3.0 * sin(x[0])).operation_count(), 2U);
  EXPECT_EQ(schedule_of(x[1] - x[0]).operation_count(), 1U);
  EXPECT_EQ(schedule_of(-(x[0] - x[1])).operation_count(), 1U);
  EXPECT_EQ(value(-3.0 * x[0], {2.0}), -6.0);
  EXPECT_EQ(value(x[1] - x[0], {2.0, 7.0}), 5.0);
  EXPECT_EQ(value(-(x[0] - x[1]), {2.0, 7.0}), 5.0);
}

TEST(Schedule, ADifferenceReadBothWaysIsComputedOnce) {
  const ExpressionVector x = input_vector(0, 2);
  const Schedule schedule(ExpressionVector{{x[0] - x[1], x[1] - x[0]}});
  EXPECT_EQ(count(schedule, Operation::subtract), 1);
  EXPECT_EQ(count(schedule, Operation::negate), 1);
}

TEST(Schedule, OperandsComeBeforeTheirReadersAndEveryStepIsRead) {
  tests::RandomPoints random;
  for (int number = 0; number < 200; ++number) {
    const tests::RandomProgram program(random, 3, 25, 2);
    const ExpressionVector x = input_vector(0, 3);
    const std::vector<Expression> f = program.run(std::span<const Expression>(x.data(), 3));
    ExpressionVector outputs(11);
    outputs << f[0], f[1], hessian(f[0], x).reshaped();
    const Schedule schedule(outputs);
    const auto& steps = schedule.steps();
    std::vector<bool> is_read(steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const std::size_t operands = operand_count(steps[i].operation);
      if (operands > 0) {
        ASSERT_LT(steps[i].left, i);
        is_read[steps[i].left] = true;
      }
      if (operands > 1) {
        ASSERT_LT(steps[i].right, i);
        is_read[steps[i].right] = true;
      }
      if (steps[i].operation == Operation::input) {
        ASSERT_LT(steps[i].input_index, schedule.input_count());
      }
    }
    ASSERT_EQ(schedule.outputs().size(), 11U);
    for (const std::uint32_t position : schedule.outputs()) is_read.at(position) = true;
    EXPECT_TRUE(std::all_of(is_read.begin(), is_read.end(), [](bool read) { return read; }));
  }
}

TEST(Schedule, InputCountIsOneMoreThanTheLargestInputThatIsRead) {
  EXPECT_EQ(Schedule().input_count(), 0U);
  EXPECT_EQ(schedule_of(Expression(1.0)).input_count(), 0U);
  EXPECT_EQ(schedule_of(Expression::input(6)).input_count(), 7U);
  EXPECT_EQ(schedule_of(Expression::input(6) * 0.0 + Expression::input(2)).input_count(), 3U);
}

TEST(Schedule, OutlivesTheGraphAndItsThread) {
  Schedule schedule;
  std::thread([&] {
    const ExpressionVector x = input_vector(0, 2);
    schedule = schedule_of(sin(x[0]) / x[1]);
  }).join();
  const std::vector<double> point{0.5, 2.0};
  EXPECT_EQ(replay<double>(schedule, std::span<const double>(point))[0], std::sin(0.5) / 2.0);
}

TEST(Replay, OnExpressionsSubstitutesFormulas) {
  const ExpressionVector x = input_vector(0, 2);
  const Schedule schedule = schedule_of(sin(x[0]) / x[1] - 3.0 * x[0]);
  const std::vector<Expression> formulas{x[1] * x[1], exp(x[0])};
  const std::vector<Expression> found = replay<Expression>(schedule, std::span<const Expression>(formulas));
  EXPECT_TRUE(found[0].is_same(sin(x[1] * x[1]) / exp(x[0]) - 3.0 * (x[1] * x[1])));
}

TEST(Replay, OnExpressionsFoldsConstants) {
  const ExpressionVector x = input_vector(0, 2);
  const Schedule schedule = schedule_of(x[0] * exp(x[1]) + x[1]);
  const std::vector<Expression> numbers{Expression(0.0), x[1]};
  EXPECT_TRUE(replay<Expression>(schedule, std::span<const Expression>(numbers))[0].is_same(x[1]));
}

TEST(Replay, OnLongDoubleIsMoreAccurateThanOnDouble) {
  const Expression x = Expression::input(0);
  // 1/2 x² up to fourth order, by cancellation: double keeps no digit of it.
  const Schedule schedule = schedule_of(1.0 - cos(x));
  const long double point = 1e-8L;
  const long double found = replay<long double>(schedule, std::span<const long double>(&point, 1))[0];
  EXPECT_NEAR(static_cast<double>(found / (0.5L * point * point)), 1.0, 1e-3);
  const double coarse = 1e-8;
  EXPECT_EQ(replay<double>(schedule, std::span<const double>(&coarse, 1))[0], 0.0);
}

TEST(Replay, WithTooFewInputsThrows) {
  const Schedule schedule = schedule_of(Expression::input(0) + Expression::input(2));
  const std::vector<double> point{1.0, 2.0};
  tests::expect_error_naming({"3 inputs", "got 2"},
                             [&] { static_cast<void>(replay<double>(schedule, std::span<const double>(point))); });
  const std::vector<double> enough{1.0, 2.0, 3.0, 4.0};
  EXPECT_EQ(replay<double>(schedule, std::span<const double>(enough))[0], 4.0);
}

}  // namespace
}  // namespace dmocbench
