#include "methods/solvers/iteration_scope.hpp"

#include <utility>

namespace dmocbench {

namespace {

/// The innermost scope of a thread; null outside of all scopes.
const IterationScope*& watching_scope() {
  thread_local const IterationScope* scope = nullptr;
  return scope;
}

}  // namespace

IterationScope::IterationScope(std::function<void(const Iteration&)> watch)
    : watch_(std::move(watch)), outer_(std::exchange(watching_scope(), this)) {}

IterationScope::IterationScope(double factor_of_objective) : IterationScope(std::function<void(const Iteration&)>()) {
  if (outer_ == nullptr || !outer_->watch_) return;
  watch_ = [this, factor_of_objective](Iteration iteration) {
    iteration.objective /= factor_of_objective;
    outer_->watch_(iteration);
  };
}

IterationScope::~IterationScope() { watching_scope() = outer_; }

bool iterations_are_watched() noexcept { return watching_scope() != nullptr && watching_scope()->watch_; }

void report_iteration(const Iteration& iteration) {
  if (iterations_are_watched()) watching_scope()->watch_(iteration);
}

}  // namespace dmocbench
