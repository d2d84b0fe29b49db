#include "methods/runtime/stop_scope.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace dmocbench {

namespace {

/// The innermost scope of a thread; null outside of all scopes.
const StopScope*& innermost() {
  thread_local const StopScope* scope = nullptr;
  return scope;
}

}  // namespace

StopScope::StopScope(std::function<bool()> stop_requested, double most_seconds)
    : stop_requested_(std::move(stop_requested)),
      most_seconds_(most_seconds > 0.0 ? most_seconds : std::numeric_limits<double>::infinity()),
      outer_(std::exchange(innermost(), this)) {}

StopScope::~StopScope() { innermost() = outer_; }

double StopScope::seconds_left() const {
  const double left = most_seconds_ - seconds_since(begin_);
  return outer_ != nullptr ? std::min(left, outer_->seconds_left()) : left;
}

bool StopScope::must_stop() const {
  if ((stop_requested_ && stop_requested_()) || most_seconds_ - seconds_since(begin_) < 0.0) return true;
  return outer_ != nullptr && outer_->must_stop();
}

bool StopScope::stop_is_requested() const {
  return (stop_requested_ && stop_requested_()) || (outer_ != nullptr && outer_->stop_is_requested());
}

bool stop_is_requested() { return innermost() != nullptr && innermost()->stop_is_requested(); }

bool must_stop() { return innermost() != nullptr && innermost()->must_stop(); }

double seconds_left() {
  return innermost() != nullptr ? innermost()->seconds_left() : std::numeric_limits<double>::infinity();
}

void stop_if_requested() {
  if (must_stop()) throw Stopped("the solve was stopped or reached the time limit");
}

}  // namespace dmocbench
