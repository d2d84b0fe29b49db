#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "methods/expression/native/native_code.hpp"
#include "methods/expression/schedule.hpp"
#include "methods/runtime/instruction_set.hpp"
#include "methods/runtime/native_code_use.hpp"

namespace dmocbench {

/// Machine code of a tape, made once enough evaluations repay it.
///
/// All threads that evaluate the tape share this: the one whose evaluation reaches the number of intervals makes the
/// code, while the others continue without it.
class LateCode {
 public:
  /// Longer tapes stay interpreted: their code would not fit the first-level cache, and to make it takes much memory.
  static constexpr std::size_t most_operations = 16384;

  /// Intervals evaluated before code is made: half as many again as repay it, so that short solves never make any. The
  /// time saved per interval is about proportional to the number of operations; so is the time to make the code, apart
  /// from a fixed time for memory from the system. `build/bench/speed/speed --benchmark_filter="making|separate"`
  /// measures both.
  [[nodiscard]] static constexpr std::uint64_t worthwhile_intervals(std::size_t operations) noexcept {
    return 10'000 + 600'000 / static_cast<std::uint64_t>(operations);
  }

  /// Code for a schedule and the series of its tape, made after `intervals` intervals; at once if that is 0.
  LateCode(Schedule schedule, TapeSeries series, InstructionSet set, std::uint64_t intervals);

  /// The code, if there is any yet.
  [[nodiscard]] const NativeCode* get() const noexcept { return ready_.load(std::memory_order_acquire); }
  /// The same before `intervals` further intervals: counts them, and makes the code if the threshold is reached.
  [[nodiscard]] const NativeCode* get_for(std::size_t intervals);

 private:
  struct Source {
    Schedule schedule;
    TapeSeries series;
    InstructionSet set{};
  };
  void make();

  std::unique_ptr<Source> source_;  // until code is made of it, by one thread
  std::uint64_t worthwhile_;
  std::atomic<std::uint64_t> evaluated_{0};
  std::unique_ptr<const NativeCode> code_;
  std::atomic<const NativeCode*> ready_{nullptr};
};

/// The machine code of a tape: a tape's only interface to this folder. Null where a tape stays interpreted: if `use`
/// requires so, there is no code for the set, or the schedule computes nothing or too much.
[[nodiscard]] std::shared_ptr<LateCode> late_code_for(const Schedule& schedule, TapeSeries series, InstructionSet set,
                                                      NativeCodeUse use);

}  // namespace dmocbench
