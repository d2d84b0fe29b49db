#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Forwards every call to another problem, the original, and has its parameters. Derived classes override what they
/// state otherwise; their optimum is therefore not known, and they clone themselves.
class ForwardingProblem : public Problem {
 public:
  [[nodiscard]] std::string name() const override { return original_.name(); }
  /// The original's without its least cost.
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = original_.card();
    card.reference.reset();
    return card;
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override {
    return original_.configuration_names();
  }
  [[nodiscard]] std::vector<std::string> control_names() const override { return original_.control_names(); }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return original_.first_order_names(); }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    return original_.first_order_rates(x);
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return original_.lagrangian(x); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return original_.force(x); }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return original_.running_cost(x); }
  [[nodiscard]] BoundaryState initial_state() const override { return original_.initial_state(); }
  [[nodiscard]] BoundaryState final_state() const override { return original_.final_state(); }
  [[nodiscard]] double horizon() const override { return original_.horizon(); }
  [[nodiscard]] ProblemBounds bounds() const override { return original_.bounds(); }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return original_.path_constraints(x);
  }
  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    return original_.constraints(q);
  }
  [[nodiscard]] ExpressionVector velocity_constraints(const ExpressionVector& q,
                                                      const ExpressionVector& v) const override {
    return original_.velocity_constraints(q, v);
  }
  [[nodiscard]] ExpressionVector embedding(const ExpressionVector& theta) const override {
    return original_.embedding(theta);
  }
  [[nodiscard]] ExpressionVector moving_embedding(const ExpressionVector& theta, const Expression& t) const override {
    return original_.moving_embedding(theta, t);
  }
  [[nodiscard]] const Problem* redundant() const override { return original_.redundant(); }
  [[nodiscard]] const PhasedProblem* phased() const override { return original_.phased(); }
  [[nodiscard]] ExpressionVector integrands(const ControlledState& x) const override { return original_.integrands(x); }
  [[nodiscard]] ExpressionVector boundary_conditions(const State& first, const State& last) const override {
    return original_.boundary_conditions(first, last);
  }
  [[nodiscard]] Expression final_cost(const State& last) const override { return original_.final_cost(last); }
  [[nodiscard]] double cost_scale() const override { return original_.cost_scale(); }
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    return original_.symmetry(q);
  }
  [[nodiscard]] MotionPoint guess(double t) const override { return original_.guess(t); }
  [[nodiscard]] const std::vector<Parameter>& parameters() const noexcept override { return original_.parameters(); }
  [[nodiscard]] std::string settings() const override { return original_.settings(); }

 protected:
  /// It must outlive this.
  explicit ForwardingProblem(const Problem& original) : original_(original) {}
  /// The original problem.
  [[nodiscard]] const Problem& original() const noexcept { return original_; }

 private:
  const Problem& original_;
};

}  // namespace dmocbench
