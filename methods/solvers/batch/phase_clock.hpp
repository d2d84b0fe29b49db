#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "methods/runtime/clock.hpp"
#include "methods/solvers/batch/batch.hpp"

namespace dmocbench::batch {

/// Measures the time of one thread by phases: at any time it is in one of them.
class PhaseClock {
 public:
  /// While it exists, time counts for its phase; afterwards for the phase before.
  class Within {
   public:
    Within(PhaseClock& clock, BatchPhase phase) : clock_(clock), before_(clock.enter(phase)) {}
    ~Within() { clock_.enter(before_); }
    Within(const Within&) = delete;
    Within& operator=(const Within&) = delete;

   private:
    PhaseClock& clock_;
    BatchPhase before_;
  };

  /// Discards the time so far.
  void begin() noexcept {
    since_ = Clock::now();
    seconds_.fill(0.0);
  }
  /// Seconds by phase.
  [[nodiscard]] const BatchSeconds& seconds() noexcept {
    enter(phase_);
    return seconds_;
  }

 private:
  BatchPhase enter(BatchPhase phase) noexcept {
    const Clock::time_point now = Clock::now();
    seconds_[static_cast<std::size_t>(phase_)] += std::chrono::duration<double>(now - since_).count();
    since_ = now;
    return std::exchange(phase_, phase);
  }

  BatchPhase phase_ = BatchPhase::rest;
  Clock::time_point since_ = Clock::now();
  BatchSeconds seconds_{};
};

}  // namespace dmocbench::batch
