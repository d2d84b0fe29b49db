#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "methods/expression/native_code.hpp"
#include "methods/expression/schedule.hpp"
#include "methods/runtime/instruction_set.hpp"

namespace dmocbench {

/// The machine code of a tape, from the moment on when it is worth its making.
///
/// All threads that evaluate the tape share this: the one whose evaluation reaches the number of intervals makes the
/// code, while the others go on without.
class LateCode {
 public:
  /// Operations that a tape has at most for which code is made. Code that is longer than the first-level cache is worth
  /// less and less, and what it was made of would fill the memory.
  static constexpr std::size_t most_operations = 16384;

  /// After how many intervals code for so many operations is made: as many as it needs from then on to save the time of
  /// its making, and half as many more, so that short solves are over before. Both times are
  /// about proportional to the number of operations, the making beside a fixed time for memory from the system;
  /// `build/bench/speed/speed --benchmark_filter="making|separate"` tells them.
  [[nodiscard]] static constexpr std::uint64_t worthwhile_intervals(std::size_t operations) noexcept {
    return 10'000 + 600'000 / static_cast<std::uint64_t>(operations);
  }

  /// Code for a schedule and the series of its tape, after so many intervals; at once if they are none.
  LateCode(Schedule schedule, TapeSeries series, InstructionSet set, std::uint64_t intervals);

  /// The code, if there is any yet.
  [[nodiscard]] const NativeCode* get() const noexcept { return ready_.load(std::memory_order_acquire); }
  /// The same, where so many further intervals are about to be evaluated: now is the time to make it if that is enough.
  [[nodiscard]] const NativeCode* get_for(std::size_t intervals);

 private:
  struct Source {
    Schedule schedule;
    TapeSeries series;
    InstructionSet set;
  };
  void make();

  std::unique_ptr<Source> source_;  // until code is made of it, by one thread
  std::uint64_t worthwhile_;
  std::atomic<std::uint64_t> evaluated_{0};
  std::unique_ptr<const NativeCode> code_;
  std::atomic<const NativeCode*> ready_{nullptr};
};

}  // namespace dmocbench
