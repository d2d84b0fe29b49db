#pragma once

#include <numbers>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// Swing-up of a planar arm of two rigid links, section 4.2.2 of the paper (imp_twolink).
///
/// q = (θ₁, θ₂), the orientations of the links measured counterclockwise from the horizontal;
///   K = ⅛(m₁ + 4m₂)l₁²θ̇₁² + ⅛m₂l₂²θ̇₂² + ½m₂l₁l₂cos(θ₁ - θ₂)θ̇₁θ̇₂ + ½J₁θ̇₁² + ½J₂θ̇₂²,
///   V = ½m₁gl₁sin θ₁ + m₂gl₁sin θ₁ + ½m₂gl₂sin θ₂   (the paper prints θ₂ for sin θ₂ in the last term),
/// f = (τ₁ - τ₂, τ₂), C = ½(τ₁² + τ₂²), from hanging at rest to upright at rest. The paper gives no values; uniform
/// rods of unit mass and length on the Earth are natural.
class TwoLinkManipulator : public Problem {
 public:
  TwoLinkManipulator()
      : Problem({
            {"mass_1", 1.0, "kg", "mass of link 1", 1e-3, 1e3},
            {"mass_2", 1.0, "kg", "mass of link 2", 1e-3, 1e3},
            {"length_1", 1.0, "m", "length of link 1", 1e-3, 1e3},
            {"length_2", 1.0, "m", "length of link 2", 1e-3, 1e3},
            {"inertia_1", 1.0 / 12.0, "kg m^2", "inertia of link 1 about its centre", 1e-6, 1e6},
            {"inertia_2", 1.0 / 12.0, "kg m^2", "inertia of link 2 about its centre", 1e-6, 1e6},
            gravity_parameter(0.0),
            horizon_parameter(1.0, "swing-up"),
        }) {}

  [[nodiscard]] std::string name() const override { return "two_link_manipulator"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {
        .description = "swing-up of a planar two-link arm in fixed time, with least control effort",
        .title = "Two-link manipulator",
        .axis_units = {.state = "rad", .control = "N m", .momentum = "N m s", .cost = "N² m² s", .energy = "N m"},
        .source = "Ober-Bloebaum, Junge, Marsden: Discrete Mechanics and Optimal Control: an Analysis, section 4.2.2",
        .reference = with_default_parameters(*this, {.objective = 80.37902916907,
                                                     .digits = 13,
                                                     .certificate = by_indirect_method(13),
                                                     .remark = "the paper gives no data and shows the cost only in a "
                                                               "figure; other minima near 89.56, 167, 171, 192, 205"}),
        .picture = [this](const ControlledState& x) -> Picture {
          const Expression elbow_x = parameter("length_1") * cos(x.q[0]);
          const Expression elbow_y = parameter("length_1") * sin(x.q[0]);
          return {{"elbow_x", "m", elbow_x},
                  {"elbow_y", "m", elbow_y},
                  {"tip_x", "m", elbow_x + parameter("length_2") * cos(x.q[1])},
                  {"tip_y", "m", elbow_y + parameter("length_2") * sin(x.q[1])},
                  {"tau_1", "N m", x.u[0]},
                  {"tau_2", "N m", x.u[1]}};
        }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"theta_1", "theta_2"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"tau_1", "tau_2"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression m1 = varying("mass_1");
    const Expression m2 = varying("mass_2");
    const Expression l1 = varying("length_1");
    const Expression l2 = varying("length_2");
    const Expression g = varying("gravity");
    const Expression& theta_1 = x.q[0];
    const Expression& theta_2 = x.q[1];
    const Expression& omega_1 = x.v[0];
    const Expression& omega_2 = x.v[1];
    const Expression kinetic =
        0.125 * (m1 + 4.0 * m2) * l1 * l1 * omega_1 * omega_1 + 0.125 * m2 * l2 * l2 * omega_2 * omega_2 +
        0.5 * m2 * l1 * l2 * cos(theta_1 - theta_2) * omega_1 * omega_2 +
        0.5 * varying("inertia_1") * omega_1 * omega_1 + 0.5 * varying("inertia_2") * omega_2 * omega_2;
    const Expression potential = (0.5 * m1 + m2) * g * l1 * sin(theta_1) + 0.5 * m2 * g * l2 * sin(theta_2);
    return kinetic - potential;
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0] - x.u[1], x.u[1]}};
  }

  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * (x.u[0] * x.u[0] + x.u[1] * x.u[1]);
  }

  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::Vector2d::Constant(-std::numbers::pi / 2.0));
  }

  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::Vector2d::Constant(std::numbers::pi / 2.0));
  }

  [[nodiscard]] double horizon() const override { return parameter("horizon"); }

  /// Rotations of the whole arm: ξ = (1, 1). Gravity breaks the symmetry, so its torque counts among the forces.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{1.0, 1.0}};
  }
};

}  // namespace dmocbench
