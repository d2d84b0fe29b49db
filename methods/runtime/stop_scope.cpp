#include "methods/runtime/stop_scope.hpp"

#include <utility>

#include "methods/runtime/clock.hpp"

namespace dmocbench {

namespace {

/// What the innermost scope of a thread asks; null outside of all scopes.
const std::function<bool()>*& innermost() {
  thread_local const std::function<bool()>* question = nullptr;
  return question;
}

}  // namespace

StopScope::StopScope(std::function<bool()> stop_requested, double most_seconds)
    : must_stop_([stop = std::move(stop_requested), most_seconds, begin = Clock::now()] {
        return (stop && stop()) || (most_seconds > 0.0 && seconds_since(begin) > most_seconds);
      }),
      outer_(std::exchange(innermost(), &must_stop_)) {}

StopScope::~StopScope() { innermost() = outer_; }

void stop_if_requested() {
  if (innermost() != nullptr && (*innermost())()) {
    throw Stopped(
        "the set-up was stopped: its formulas are too long to be traced and differentiated in the time given");
  }
}

}  // namespace dmocbench
