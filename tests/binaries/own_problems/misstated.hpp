#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A driven mass with everything that a problem may state besides; `mistake` spoils one of the statements.
class Misstated : public Problem {
 public:
  Misstated()
      : Problem({{"mistake", 0.0, "", "the statement that is spoilt, 0 for none", 0.0, 8.0, true},
                 {"mass", 1.0, "kg", "which a solve chooses", 0.5, 2.0, false, true}}) {}
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"q"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"charge"}; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    return ExpressionVector::Constant(is(1) ? 2 : 1, x.u[0] * x.u[0]);
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    const Expression miss = is(2) ? Expression(1.0) : varying("mass") - 1.5;
    return x.u[0] * x.u[0] + miss * miss;
  }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return ExpressionVector::Constant(1, x.u[0] - x.q[0]);
  }
  [[nodiscard]] ExpressionVector integrands(const ControlledState& x) const override {
    return ExpressionVector::Constant(1, x.q[0]);
  }
  [[nodiscard]] BoundaryState initial_state() const override { return at(0.0); }
  [[nodiscard]] BoundaryState final_state() const override { return at(1.0); }
  [[nodiscard]] double horizon() const override { return 1.0; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_first_order(0);
    bounds.path = Bounds::all(1, is(3) || is(4) ? 1.0 : -20.0, is(3) ? -1.0 : is(4) ? 1.0 : 20.0);
    bounds.integrals = Bounds::all(1, is(5) ? 2.0 : 0.4, is(5) ? 1.0 : 0.6);
    bounds.interior.push_back({.relative_time = is(6) ? 1.0 : 0.5, .v = Bounds::all(is(7) ? 2 : 1, 0.0, 3.0)});
    if (is(8)) bounds.interior.push_back(bounds.interior.front());
    return bounds;
  }

 private:
  [[nodiscard]] bool is(int mistake) const { return parameter("mistake") == mistake; }
  static BoundaryState at(double q) {
    BoundaryState state = BoundaryState::at_rest(Eigen::VectorXd::Constant(1, q));
    state.y = Eigen::VectorXd::Zero(1);
    return state;
  }
};

}  // namespace dmocbench
