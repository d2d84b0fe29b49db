#pragma once

#include <functional>

#include "methods/error.hpp"
#include "methods/runtime/clock.hpp"

namespace dmocbench {

/// A computation was ended by a `StopScope`.
class Stopped : public Error {
 public:
  /// As `Error`.
  using Error::Error;
};

/// As long as it exists, work of this thread without counted iterations (tracing and differentiating formulas,
/// integrating, Newton steps after a solver) ends once `stop_requested` is true or more than `most_seconds` have
/// passed (0: no limit), and solvers take no longer than that. The same holds for the scopes around it.
class StopScope {
 public:
  /// Begins now; `most_seconds`: wall clock.
  StopScope(std::function<bool()> stop_requested, double most_seconds);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

  /// True if `stop_requested` is true or the time is over, here or in a scope around.
  [[nodiscard]] bool must_stop() const;
  /// True if `stop_requested` is true, here or in a scope around. Work may also end before its time is over, where the
  /// rest does not suffice for it.
  [[nodiscard]] bool stop_is_requested() const;
  /// The least of this scope and those around; infinite without a limit.
  [[nodiscard]] double seconds_left() const;

 private:
  std::function<bool()> stop_requested_;
  double most_seconds_;
  Clock::time_point begin_ = Clock::now();
  const StopScope* outer_;
};

/// Whether the scope of this thread requires a stop; false outside of all scopes.
[[nodiscard]] bool must_stop();
/// The same of `StopScope::stop_is_requested`.
[[nodiscard]] bool stop_is_requested();
/// The remaining time of this thread's scope: infinity without a limit, negative where it is over.
[[nodiscard]] double seconds_left();
/// Throws `Stopped` if the scope of this thread requires it; for loops whose rounds take microseconds or more.
void stop_if_requested();

}  // namespace dmocbench
