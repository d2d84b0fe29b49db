#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A unit mass from (0, 0) to (1, 1), from rest to rest in 1 s with least ∫ |u|² dt, past a disc of radius 0.01 about
/// (0.5, 0.499). Straight through the disc, between two stages, it costs 24; around it 24.0165807, by Green's function
/// of the clamped beam.
class ThinDisc : public Problem {
 public:
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_x", "u_y"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v.squaredNorm(); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u.squaredNorm(); }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    const Expression dx = x.q[0] - 0.5;
    const Expression dy = x.q[1] - 0.499;
    return ExpressionVector{{dx * dx + dy * dy - 1e-4}};
  }
  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::Vector2d(0.0, 0.0));
  }
  [[nodiscard]] BoundaryState final_state() const override { return BoundaryState::at_rest(Eigen::Vector2d(1.0, 1.0)); }
  [[nodiscard]] double horizon() const override { return 1.0; }
};

}  // namespace dmocbench
