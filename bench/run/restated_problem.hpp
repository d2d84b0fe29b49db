#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "methods/mechanics/forwarding_problem.hpp"

namespace dmocbench {

/// A problem with its control bounded, with its final state free and the distance to it in the cost, or between other
/// ends.
class RestatedProblem final : public ForwardingProblem {
 public:
  /// The differences from the problem.
  struct Changes {
    std::optional<Bounds> control = std::nullopt;  ///< bounds on u
    /// w: the final state is free and the cost has the further term ½w(|q(T) - q^T|² + |q̇(T) - q̇^T|²).
    std::optional<double> final_weight = std::nullopt;
    /// Fixed quantities at an end take these values, free ones stay free. The guess is moved with the ends.
    std::optional<BoundaryState> initial = std::nullopt;
    std::optional<BoundaryState> final = std::nullopt;  ///< the state at T
    std::optional<double> cost_scale = std::nullopt;    ///< factor of the cost
  };
  /// `base` with these changes; `base` is shared and not modified.
  RestatedProblem(std::shared_ptr<const Problem> base, Changes changes)
      : ForwardingProblem(*base), base_(std::move(base)), changes_(std::move(changes)) {}

  [[nodiscard]] BoundaryState initial_state() const override {
    return changes_.initial.value_or(base_->initial_state());
  }
  [[nodiscard]] BoundaryState final_state() const override { return changes_.final.value_or(base_->final_state()); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = base_->bounds();
    if (changes_.initial) move(bounds.first, *changes_.initial);
    if (changes_.final) move(bounds.last, *changes_.final);
    if (changes_.control) bounds.u = *changes_.control;
    if (changes_.final_weight) {
      bounds.last = {.q = Bounds::none(configuration_size()), .v = Bounds::none(configuration_size())};
    }
    return bounds;
  }
  [[nodiscard]] Expression final_cost(const State& last) const override {
    Expression cost = base_->final_cost(last);
    if (!changes_.final_weight) return cost;
    const BoundaryState wanted = final_state();
    for (Eigen::Index i = 0; i < wanted.q.size(); ++i) {
      const Expression q = last.q[i] - wanted.q[i];
      const Expression v = last.v[i] - wanted.v[i];
      cost += 0.5 * *changes_.final_weight * (q * q + v * v);
    }
    return cost;
  }
  [[nodiscard]] double cost_scale() const override { return changes_.cost_scale.value_or(base_->cost_scale()); }
  /// The base's, with a straight line between the displacements of both ends added to q.
  [[nodiscard]] MotionPoint guess(double t) const override {
    MotionPoint point = base_->guess(t);
    const Eigen::VectorXd first = initial_state().q - base_->initial_state().q;
    const Eigen::VectorXd last = final_state().q - base_->final_state().q;
    if (first.isZero(0.0) && last.isZero(0.0)) return point;
    point.q += first + t / horizon() * (last - first);
    point.v += (last - first) / horizon();
    return point;
  }

 private:
  static void move(EndBounds& end, const BoundaryState& state) {
    const auto move_part = [](Bounds& bounds, const Eigen::VectorXd& values) {
      for (Eigen::Index i = 0; i < values.size(); ++i) {
        if (bounds.is_fixed(i)) bounds.lower[i] = bounds.upper[i] = values[i];
      }
    };
    move_part(end.q, state.q);
    move_part(end.v, state.v);
    move_part(end.y, state.y);
  }

  std::shared_ptr<const Problem> base_;
  Changes changes_;
};

}  // namespace dmocbench
