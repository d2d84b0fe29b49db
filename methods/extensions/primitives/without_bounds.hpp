#pragma once

#include <optional>
#include <string>
#include <vector>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A problem without its bounds on q, q̇ and u along the motion; everything else is unchanged. The problem must outlive
/// it.
class WithoutBounds final : public Problem {
 public:
  /// The problem must outlive it.
  explicit WithoutBounds(const Problem& base) : base_(base) {}

  [[nodiscard]] std::string name() const override { return base_.name(); }
  [[nodiscard]] ProblemCard card() const override { return base_.card(); }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return base_.configuration_names(); }
  [[nodiscard]] std::vector<std::string> control_names() const override { return base_.control_names(); }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return base_.lagrangian(x); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return base_.force(x); }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return base_.running_cost(x); }
  [[nodiscard]] BoundaryState initial_state() const override { return base_.initial_state(); }
  [[nodiscard]] BoundaryState final_state() const override { return base_.final_state(); }
  [[nodiscard]] double horizon() const override { return base_.horizon(); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = base_.bounds();
    bounds.q = {};
    bounds.v = {};
    bounds.u = {};
    return bounds;
  }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return base_.path_constraints(x);
  }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return base_.first_order_names(); }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    return base_.first_order_rates(x);
  }
  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override { return base_.constraints(q); }
  [[nodiscard]] ExpressionVector integrands(const ControlledState& x) const override { return base_.integrands(x); }
  [[nodiscard]] ExpressionVector boundary_conditions(const State& first, const State& last) const override {
    return base_.boundary_conditions(first, last);
  }
  [[nodiscard]] Expression final_cost(const State& last) const override { return base_.final_cost(last); }
  [[nodiscard]] double cost_scale() const override { return base_.cost_scale(); }
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    return base_.symmetry(q);
  }
  [[nodiscard]] MotionPoint guess(double t) const override { return base_.guess(t); }

 private:
  const Problem& base_;
};

}  // namespace dmocbench
