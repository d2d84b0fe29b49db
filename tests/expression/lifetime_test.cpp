// Memory and threads of a graph: nodes go with their last reader, deep graphs do not end the stack, and threads trace
// apart.

#include <atomic>
#include <cmath>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/expression/tape.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {
namespace {

constexpr int million = 1'000'000;

double value_of_schedule(const Schedule& schedule, const std::vector<double>& point) {
  return replay<double>(schedule, std::span<const double>(point))[0];
}

/// Every test leaves as many nodes as it found.
class Lifetime : public testing::Test {
 protected:
  void TearDown() override { EXPECT_EQ(live_nodes(), before_); }
  const std::size_t before_ = live_nodes();
};

TEST_F(Lifetime, TracingEndsWithItsStopScopeAndLeavesNothing) {
  const StopScope scope(nullptr, 1e-9);
  const Expression x = Expression::input(0);
  Expression sum;
  const auto add_many = [&] {
    for (int i = 0; i < million; ++i) sum += i * sin(i * x);
  };
  EXPECT_THROW(add_many(), Stopped);
}

TEST_F(Lifetime, NodesGoWithTheLastExpressionThatReadsThem) {
  const ExpressionVector x = input_vector(0, 3);
  EXPECT_EQ(live_nodes(), before_ + 3);
  Expression f = sin(x[0]) * x[1];
  EXPECT_EQ(live_nodes(), before_ + 5);
  f = x[2];
  EXPECT_EQ(live_nodes(), before_ + 3);
  const ExpressionMatrix second = hessian(exp(x[0] * x[1]) / (1.0 + x[2] * x[2]), x);
  EXPECT_GT(live_nodes(), before_ + 3);
}

TEST_F(Lifetime, CopiesAndMovesKeepExactlyWhatTheyRead) {
  Expression f = sin(Expression::input(0));
  Expression copy = f;
  Expression moved = std::move(f);
  EXPECT_TRUE(moved.is_same(copy));
  Expression& alias = copy;
  copy = alias;
  EXPECT_TRUE(moved.is_same(copy));
  EXPECT_EQ(live_nodes(), before_ + 2);
  copy = Expression::input(0);
  EXPECT_EQ(live_nodes(), before_ + 2);
  moved = copy;
  EXPECT_EQ(live_nodes(), before_ + 1);
}

TEST_F(Lifetime, SchedulesAndTapesKeepNothingAlive) {
  const Tape tape(Schedule(ExpressionVector{{sin(Expression::input(0)) + 1.5}}));
  EXPECT_EQ(live_nodes(), before_);
}

TEST_F(Lifetime, AnErrorLeavesNoNodesBehind) {
  const ExpressionVector x = input_vector(0, 2);
  EXPECT_THROW(static_cast<void>(gradient(x[0] * x[1], ExpressionVector{{x[0] + x[1]}})), Error);
}

TEST_F(Lifetime, AChainOfAMillionOperationsIsScheduledAndDestroyed) {
  const ExpressionVector x = input_vector(0, 2);
  Expression f = x[0];
  for (int i = 0; i < million / 2; ++i) f = sin(f) + x[1];
  const Schedule schedule(std::span(&f, 1));
  EXPECT_EQ(schedule.operation_count(), static_cast<std::size_t>(million));
  EXPECT_LE(Tape(schedule).slot_count(), 2U);
  double expected = 0.3;
  for (int i = 0; i < million / 2; ++i) expected = std::sin(expected) + 0.1;
  EXPECT_NEAR(value_of_schedule(schedule, {0.3, 0.1}), expected, 1e-14);
}

TEST_F(Lifetime, AChainOfAMillionOperationsIsDifferentiated) {
  const ExpressionVector x = input_vector(0, 2);
  Expression f = x[0];
  for (int i = 0; i < million / 2; ++i) f = 3.0 * x[1] - (f + 1.0);
  const ExpressionVector first = gradient(f, x);
  EXPECT_EQ(first[0].constant_value(), 1.0);  // half a million changes of sign
  EXPECT_EQ(first[1].constant_value(), 0.0);
}

TEST_F(Lifetime, ALongProductIsTracedAndDifferentiated) {
  // The adjoints of this chain are products of up to 200 000 factors.
  Expression f = Expression::input(0);
  constexpr int length = 200'000;
  for (int i = 0; i < length; ++i) f = sin(f);
  const Expression slope = gradient(f, ExpressionVector{{Expression::input(0)}})[0];
  double expected = 1.0;
  double at = 1e-3;
  for (int i = 0; i < length; ++i) {
    expected *= std::cos(at);
    at = std::sin(at);
  }
  EXPECT_NEAR(value_of_schedule(Schedule(std::span(&slope, 1)), {1e-3}), expected, 1e-12 * expected);
}

TEST_F(Lifetime, RepeatedSquaringTakesOneNodePerSquare) {
  Expression f = Expression::input(0);
  for (int i = 0; i < 100; ++i) f *= f;
  EXPECT_EQ(live_nodes(), before_ + 1 + 100);
  EXPECT_EQ(Schedule(std::span(&f, 1)).operation_count(), 100U);
}

TEST_F(Lifetime, ManyDistinctNegativeFactorsAreScheduledInReasonableTime) {
  Expression f;
  constexpr int length = 100'000;
  for (int i = 0; i < length; ++i) f = f * f - (2.0 + i) * Expression::input(static_cast<std::size_t>(i));
  EXPECT_GE(Schedule(std::span(&f, 1)).operation_count(), static_cast<std::size_t>(2 * length));
}

TEST(Threads, TraceTheSameFormulasAtTheSameTime) {
  const auto trace = [] {
    const ExpressionVector x = input_vector(0, 2);
    const Expression f = sin(x[0] * x[1]) / (2.0 + cos(x[1])) + exp(-x[0] * x[0]);
    return Schedule(ExpressionVector(hessian(f, x).reshaped()));
  };
  const std::vector<double> point{0.4, -1.3};
  const std::vector<double> expected = replay<double>(trace(), std::span<const double>(point));
  std::atomic<int> right{0};
  std::vector<std::thread> threads;
  constexpr int thread_count = 8;
  constexpr int repetitions = 200;
  threads.reserve(thread_count);
  for (int i = 0; i < thread_count; ++i) {
    threads.emplace_back([&] {
      for (int repetition = 0; repetition < repetitions; ++repetition) {
        const bool same = replay<double>(trace(), std::span<const double>(point)) == expected;
        right += same && live_nodes() == 0 ? 1 : 0;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, thread_count * repetitions);
}

TEST(Threads, CountTheirOwnNodes) {
  const Expression here = Expression::input(0) * Expression::input(1);
  const std::size_t before = live_nodes();
  std::size_t at_start = 1;
  std::size_t with_three = 0;
  std::thread([&] {
    at_start = live_nodes();
    const ExpressionVector x = input_vector(0, 3);
    with_three = live_nodes();
  }).join();
  EXPECT_EQ(at_start, 0U);
  EXPECT_EQ(with_three, 3U);
  EXPECT_EQ(live_nodes(), before);
}

TEST(Threads, MixingTheirExpressionsThrows) {
  const Expression here = Expression::input(0);
  int thrown = 0;
  std::size_t left = 1;
  std::thread([&] {  // this thread waits: nobody else touches `here`
    {
      const Expression there = Expression::input(1);
      const auto expect_throw = [&](const auto& mix) {
        try {
          static_cast<void>(mix());
        } catch (const Error&) {
          ++thrown;
        }
      };
      expect_throw([&] { return here + there; });
      expect_throw([&] { return there - here; });
      expect_throw([&] { return here * there; });
      expect_throw([&] { return there / here; });
      expect_throw([&] { return atan2(there, here); });
      expect_throw([&] { return sin(here); });
      expect_throw([&] { return -here; });
    }
    left = live_nodes();
  })
      .join();
  EXPECT_EQ(thrown, 7);
  EXPECT_EQ(left, 0U);
}

TEST(Threads, AnExpressionMayOutliveItsThread) {
  Expression kept;
  Expression part;
  const std::size_t before = live_nodes();
  std::thread([&] {
    const ExpressionVector x = input_vector(0, 2);
    kept = sin(x[0]) * x[1] + 2.0;
    part = sin(x[0]);
  }).join();
  const Schedule schedule(std::span(&kept, 1));
  EXPECT_EQ(value_of_schedule(schedule, {0.5, 3.0}), std::sin(0.5) * 3.0 + 2.0);
  kept = Expression();
  EXPECT_EQ(value_of_schedule(Schedule(std::span(&part, 1)), {0.5}), std::sin(0.5));
  part = Expression();
  EXPECT_EQ(live_nodes(), before);
}

}  // namespace
}  // namespace dmocbench
