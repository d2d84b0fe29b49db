#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Swing-up of a planar arm of two rigid links, section 4.2.2 of the paper (imp_twolink).
///
/// q = (θ₁, θ₂), the orientations of the links measured counterclockwise from the horizontal;
///   K = ⅛(m₁ + 4m₂)l₁²θ̇₁² + ⅛m₂l₂²θ̇₂² + ½m₂l₁l₂cos(θ₁ - θ₂)θ̇₁θ̇₂ + ½J₁θ̇₁² + ½J₂θ̇₂²,
///   V = ½m₁gl₁sin θ₁ + m₂gl₁sin θ₁ + ½m₂gl₂sin θ₂   (the paper prints θ₂ for sin θ₂ in the last term),
/// f = (τ₁ - τ₂, τ₂), C = ½(τ₁² + τ₂²), from hanging at rest to upright at rest.
class TwoLinkManipulator final : public Problem {
 public:
  TwoLinkManipulator();

  [[nodiscard]] std::string name() const override { return "two_link_manipulator"; }
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] std::string source() const override;
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"theta_1", "theta_2"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"tau_1", "tau_2"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override;
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override;
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override;
  [[nodiscard]] BoundaryState initial_state() const override;
  [[nodiscard]] BoundaryState final_state() const override;
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }
  /// Rotations of the whole arm: ξ = (1, 1). Gravity breaks the symmetry, so its torque counts among the forces.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override;
  [[nodiscard]] std::vector<PictureQuantity> picture(const ControlledState& x) const override;
};

}  // namespace dmocbench
