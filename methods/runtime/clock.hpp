#pragma once

#include <chrono>

namespace dmocbench {

/// The clock by which everything is timed: it never goes back.
using Clock = std::chrono::steady_clock;

/// Seconds since a moment of this clock.
inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace dmocbench
