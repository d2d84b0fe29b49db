// What a tape may touch: the numbers it was given and its workspace, nothing beyond, and no new
// memory.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/expression/operations.hpp"
#include "tests/expression/series_table.hpp"
#include "tests/support/random_points.hpp"

namespace {
// NOLINTBEGIN(cppcoreguidelines-no-malloc): this is what the program's new and delete are made of
std::atomic<std::size_t> allocations{0};  // of all threads
}  // namespace

// Not inlined: the compiler would take what is inside for a mismatch of new and free.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new[](std::size_t size) { return operator new(size); }
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
// NOLINTEND(cppcoreguidelines-no-malloc)

namespace dmocbench {
namespace {

/// Every operation as an output, on two inputs; their values are irrelevant here.
Schedule all_operations() {
  const ExpressionVector x = input_vector(0, 2);
  std::vector<Expression> outputs{x[0], Expression(1.5)};
  const auto append = [&](const char*, const auto& formula, const tests::Domain&) {
    outputs.push_back(formula(x[0], x[1]));
    outputs.push_back(0.5 * formula(x[1], x[0]) + x[0]);
  };
  tests::visit_operations(append);
  tests::visit_powers(append);
  return Schedule(std::span<const Expression>(outputs));
}

/// Numbers between two pages that must not be touched, adjacent to the upper or to the lower one.
class GuardedColumn {
 public:
  enum class Side { lower, upper };
  GuardedColumn(std::size_t count, Side side)
      : page_(static_cast<std::size_t>(sysconf(_SC_PAGESIZE))),
        inner_((count * sizeof(double) + page_ - 1) / page_ * page_),
        memory_(static_cast<std::byte*>(
            mmap(nullptr, inner_ + 2 * page_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0))) {
    if (static_cast<void*>(memory_) == MAP_FAILED) throw std::bad_alloc();
    mprotect(memory_, page_, PROT_NONE);
    mprotect(memory_ + page_ + inner_, page_, PROT_NONE);
    std::byte* first = side == Side::lower ? memory_ + page_ : memory_ + page_ + inner_ - count * sizeof(double);
    numbers_ = reinterpret_cast<double*>(first);  // NOLINT: pages hold bytes
    std::fill_n(numbers_, count, 0.5);
  }
  GuardedColumn(const GuardedColumn&) = delete;
  GuardedColumn& operator=(const GuardedColumn&) = delete;
  ~GuardedColumn() { munmap(memory_, inner_ + 2 * page_); }

  [[nodiscard]] double* data() const { return numbers_; }

 private:
  std::size_t page_;
  std::size_t inner_;
  std::byte* memory_;
  double* numbers_ = nullptr;
};

TEST(TapeMemory, NothingIsTouchedNextToInputsAndOutputs) {
  const Schedule schedule = all_operations();
  for (const InstructionSet set : available_instruction_sets()) {
    const Tape tape(schedule, set);
    Tape::Workspace workspace(tape);
    for (const auto side : {GuardedColumn::Side::lower, GuardedColumn::Side::upper}) {
      for (const std::size_t count : tests::interval_counts()) {
        const GuardedColumn x(count, side);
        const GuardedColumn y(count, side);
        const std::vector<Tape::Input> inputs{{x.data()}, {y.data()}};
        std::vector<std::unique_ptr<GuardedColumn>> columns;
        std::vector<double*> outputs;
        for (std::size_t j = 0; j < tape.output_count(); ++j) {
          columns.push_back(std::make_unique<GuardedColumn>(count, side));
          outputs.push_back(columns.back()->data());
        }
        tape.evaluate(count, inputs, outputs, workspace);
        EXPECT_TRUE(std::all_of(outputs[1], outputs[1] + count, [](double v) { return v == 1.5; }));
      }
    }
  }
}

TEST(TapeMemory, NumbersAroundOutputsKeepTheirValuesAndSoDoInputs) {
  constexpr double canary = 12345.678;
  constexpr std::size_t guard = 2 * Tape::block_width;
  const Schedule schedule = all_operations();
  for (const InstructionSet set : available_instruction_sets()) {
    const Tape tape(schedule, set);
    Tape::Workspace workspace(tape);
    for (const std::size_t count : tests::interval_counts()) {
      tests::RandomPoints random;
      tests::SeriesTable inputs(2, std::vector<double>(count));
      for (auto& column : inputs) std::generate(column.begin(), column.end(), [&] { return random.number(); });
      const tests::SeriesTable before = inputs;
      tests::SeriesTable guarded(tape.output_count(), std::vector<double>(count + 2 * guard, canary));
      std::vector<double*> outputs;
      outputs.reserve(guarded.size());
      for (auto& column : guarded) outputs.push_back(column.data() + guard);
      const std::vector<Tape::Input> places{{inputs[0].data()}, {inputs[1].data()}};
      tape.evaluate(count, places, outputs, workspace);
      const auto is_canary = [](double value) { return value == canary; };
      for (const auto& column : guarded) {
        EXPECT_TRUE(std::all_of(column.begin(), column.begin() + guard, is_canary)) << count;
        EXPECT_TRUE(std::all_of(column.end() - guard, column.end(), is_canary)) << count;
        EXPECT_TRUE(std::none_of(column.begin() + guard, column.end() - guard, is_canary)) << count;
      }
      EXPECT_EQ(inputs, before);
    }
  }
}

TEST(TapeMemory, UnreadInputsMayBeNull) {
  const Tape tape(Schedule(ExpressionVector{{sin(Expression::input(2))}}));
  Tape::Workspace workspace(tape);
  const double number = 0.5;
  double result = 0.0;
  const std::vector<Tape::Input> inputs{{nullptr, true}, {nullptr, false}, {&number, false}};
  tape.evaluate(1, inputs, std::vector<double*>{&result}, workspace);
  EXPECT_NEAR(result, std::sin(0.5), 1e-16);
}

TEST(TapeMemory, WithoutIntervalsNothingIsRead) {
  const ExpressionVector x = input_vector(0, 2);
  const Tape tape(Schedule(ExpressionVector{{x[0] + x[1]}}));
  Tape::Workspace workspace(tape);
  const std::vector<Tape::Input> inputs{{nullptr, true}, {nullptr, false}};
  EXPECT_NO_THROW(tape.evaluate(0, inputs, std::vector<double*>{nullptr}, workspace));
}

TEST(TapeMemory, EvaluationAllocatesNothing) {
  const Schedule schedule = all_operations();
  constexpr std::size_t count = 200;
  const std::vector<double> x(count, 0.5);
  const std::vector<Tape::Input> inputs{{x.data(), false}, {x.data(), true}};
  for (const InstructionSet set : available_instruction_sets()) {
    const Tape tape(schedule, set);
    Tape::Workspace workspace(tape);
    tests::SeriesTable columns(tape.output_count(), std::vector<double>(count));
    std::vector<double*> outputs;
    outputs.reserve(columns.size());
    for (auto& column : columns) outputs.push_back(column.data());
    const std::size_t before = allocations;
    tape.evaluate(count, inputs, outputs, workspace);
    tape.evaluate(count, inputs, outputs, workspace);
    EXPECT_EQ(allocations, before);
  }
  const std::size_t before = allocations;
  static_cast<void>(Tape::Workspace(Tape(schedule)));
  EXPECT_GT(allocations, before) << "the count does not count";
}

TEST(TapeMemory, ThreadsShareATapeEachWithItsOwnWorkspace) {
  const Tape tape(all_operations());
  constexpr std::size_t count = 150;
  tests::RandomPoints random;
  tests::SeriesTable inputs(2, std::vector<double>(count));
  for (auto& column : inputs) std::generate(column.begin(), column.end(), [&] { return random.number(0.2, 0.8); });
  const tests::SeriesTable alone = tests::evaluate(tape, inputs, count);
  std::vector<tests::SeriesTable> found(4);
  std::vector<std::thread> threads;
  threads.reserve(found.size());
  for (tests::SeriesTable& result : found) {
    threads.emplace_back([&] {
      for (int repetition = 0; repetition < 20; ++repetition) {
        result = tests::evaluate(tape, inputs, count);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const tests::SeriesTable& result : found) EXPECT_EQ(result, alone);
}

}  // namespace
}  // namespace dmocbench
