#pragma once

#include <functional>

#include "methods/error.hpp"

namespace dmocbench {

/// A computation was ended by a `StopScope`.
class Stopped : public Error {
 public:
  using Error::Error;
};

/// As long as it exists, what this thread computes without iterations that could be counted (tracing and
/// differentiating formulas) ends with `Stopped` once `stop_requested` is true or more than `most_seconds` have passed
/// (0: no limit). The innermost scope counts.
class StopScope {
 public:
  StopScope(std::function<bool()> stop_requested, double most_seconds);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;
  StopScope(StopScope&&) = delete;
  StopScope& operator=(StopScope&&) = delete;

 private:
  std::function<bool()> must_stop_;
  const std::function<bool()>* outer_;
};

/// Throws `Stopped` if the scope of this thread says so; for loops whose rounds take microseconds or more.
void stop_if_requested();

}  // namespace dmocbench
