#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A problem with its control bounded, with its final state free and the distance to it in the cost, or between other
/// ends.
class RestatedProblem final : public Problem {
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
      : base_(std::move(base)), changes_(std::move(changes)) {}

  [[nodiscard]] std::string name() const override { return base_->name(); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = base_->card();
    card.reference.reset();
    return card;
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return base_->configuration_names(); }
  [[nodiscard]] std::vector<std::string> control_names() const override { return base_->control_names(); }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return base_->lagrangian(x); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return base_->force(x); }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return base_->running_cost(x); }
  [[nodiscard]] BoundaryState initial_state() const override {
    return changes_.initial.value_or(base_->initial_state());
  }
  [[nodiscard]] BoundaryState final_state() const override { return changes_.final.value_or(base_->final_state()); }
  [[nodiscard]] double horizon() const override { return base_->horizon(); }
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
  [[nodiscard]] std::string settings() const override { return base_->settings(); }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return base_->path_constraints(x);
  }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return base_->first_order_names(); }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    return base_->first_order_rates(x);
  }
  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override { return base_->constraints(q); }
  [[nodiscard]] ExpressionVector embedding(const ExpressionVector& theta) const override {
    return base_->embedding(theta);
  }
  [[nodiscard]] ExpressionVector integrands(const ControlledState& x) const override { return base_->integrands(x); }
  [[nodiscard]] ExpressionVector boundary_conditions(const State& first, const State& last) const override {
    return base_->boundary_conditions(first, last);
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
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    return base_->symmetry(q);
  }
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
  }

  std::shared_ptr<const Problem> base_;
  Changes changes_;
};

}  // namespace dmocbench
