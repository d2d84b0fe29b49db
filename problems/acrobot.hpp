#pragma once

#include <numbers>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// Swing-up of a double pendulum with a motor at the elbow only, the example of the PROPT guide.
///
/// q = (q₁, q₂), the upper link's angle from hanging down and the elbow's; with a = m₂l₁l_c₂,
///   K = ½(I₁ + I₂ + m₂l₁² + 2a cos q₂)q̇₁² + (I₂ + a cos q₂)q̇₁q̇₂ + ½I₂q̇₂²   (inertias about the joints),
///   V = -(m₁l_c₁ + m₂l₁)g cos q₁ - m₂gλ cos(q₁ + q₂),
/// f = (-b₁q̇₁, u - b₂q̇₂), C = u², |u| <= 10 N m, from hanging to upright at rest in T = 4 s.
///
/// The guide has λ = l₂ instead of λ = l_c₂, the distance of the lower link's centre of mass, as if that link weighed
/// twice its mass. The parameter `physical` chooses between the two.
///
/// Energy bounds the cost from below: the power of motor and friction at the elbow is uq̇₂ - b₂q̇₂² <= u²/(4b₂), hence
/// ∫u² >= 4b₂ΔV, 27.468 with the guide's potential and 19.62 with the physical one.
class Acrobot : public Problem {
 public:
  Acrobot()
      : Problem({
            switch_parameter("physical", false, "0: potential of the PROPT guide, 1: mechanical potential"),
            {"friction", 0.1, "N m s", "viscous friction b1 = b2 of the joints", 0.0, 1e2},
            switch_parameter("bounded", true, "1: the torque is at most 10 N m, 0: no bound"),
            horizon_parameter(4.0, "swing-up"),
        }) {}

  [[nodiscard]] std::string name() const override { return "acrobot"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "swing-up of a double pendulum with an elbow motor in fixed time, with least control effort",
            .title = "Acrobot swing-up",
            .axis_units = {.state = "rad", .control = "N m", .momentum = "N m s", .cost = "N² m² s", .energy = "N m"},
            .source = "PROPT guide, example Acrobot, after Tedrake: Underactuated Robotics, chapter 3",
            .configuration_units = {"rad", "rad"},
            .control_units = {"N m"},
            .reference = reference_optimum(),
            .picture = [](const ControlledState& x) -> Picture {
              const Expression elbow_x = length_1 * sin(x.q[0]);
              const Expression elbow_y = -length_1 * cos(x.q[0]);
              return {{"elbow_x", "m", elbow_x},
                      {"elbow_y", "m", elbow_y},
                      {"tip_x", "m", elbow_x + length_2 * sin(x.q[0] + x.q[1])},
                      {"tip_y", "m", elbow_y - length_2 * cos(x.q[0] + x.q[1])},
                      {"torque", "N m", x.u[0]}};
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"q_1", "q_2"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const double coupling = mass_2 * length_1 * centre_2;
    const Expression& omega_1 = x.v[0];
    const Expression& omega_2 = x.v[1];
    const Expression c2 = cos(x.q[1]);
    const Expression kinetic =
        0.5 * (inertia_1 + inertia_2 + mass_2 * length_1 * length_1 + 2.0 * coupling * c2) * omega_1 * omega_1 +
        (inertia_2 + coupling * c2) * omega_1 * omega_2 + 0.5 * inertia_2 * omega_2 * omega_2;
    return kinetic + upper_weight() * cos(x.q[0]) + lower_weight() * cos(x.q[0] + x.q[1]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression b = varying("friction");
    return ExpressionVector{{-b * x.v[0], x.u[0] - b * x.v[1]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }

  [[nodiscard]] BoundaryState initial_state() const override { return BoundaryState::at_rest(Eigen::Vector2d::Zero()); }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::Vector2d(std::numbers::pi, 0.0));
  }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    if (parameter("bounded") == 1.0) bounds.u = Bounds::all(1, -10.0, 10.0);  // N m
    return bounds;
  }

  /// Optima are between 40 and 100.
  [[nodiscard]] double cost_scale() const override { return 1e-2; }

  /// Rotations of the whole: ξ = (1, 0), the momentum about the shoulder, on which the motor does not act.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{1.0, 0.0}};
  }

 private:
  [[nodiscard]] std::optional<ReferenceOptimum> reference_optimum() const {
    if (!has_default_parameters({"physical"})) return std::nullopt;
    if (parameter("physical") == 1.0) {
      return ReferenceOptimum{
          .objective = 43.08989,
          .digits = 6,
          .certificate = "Gauss with s = 3 on 800 and s = 4 on 500 intervals agree; the replay meets the end to 4e-4",
          .remark =
              "the best minimum from about a hundred starts, many of them near it; not proven to be global. Another "
              "minimum is 93.09407"};
    }
    return ReferenceOptimum{
        .objective = 54.412699,
        .digits = 7,
        .certificate = "Gauss with s = 3 and s = 4 on 800 and Lobatto with s = 4 on 900 intervals and a replay agree",
        .published = {{4.4432421953665, "PROPT guide, 80 collocation points"}},
        .remark =
            "the published cost is impossible: no trajectory costs less than 4 b2 dV = 27.468. Coarse grids have such "
            "false optima: DMOC with s = 1 and N = 128 finds 23.16 near this trajectory. The reference is the best "
            "minimum from more than a hundred starts, many of them near it; it is not proven to be global. From the "
            "guess, every method converges to a different minimum"};
  }

  static constexpr double mass_1 = 1.0;           // kg
  static constexpr double mass_2 = 1.0;           // kg
  static constexpr double length_1 = 1.0;         // m
  static constexpr double length_2 = 2.0;         // m
  static constexpr double centre_1 = 0.5;         // m from the shoulder
  static constexpr double centre_2 = 1.0;         // m from the elbow
  static constexpr double inertia_1 = 1.0 / 3.0;  // kg m^2 about the shoulder
  static constexpr double inertia_2 = 1.0;        // kg m^2 about the elbow (a rod would have 4/3)
  static constexpr double gravity = 9.81;         // m/s^2

  /// (m₁l_c₁ + m₂l₁)g in N m.
  [[nodiscard]] static double upper_weight() { return (mass_1 * centre_1 + mass_2 * length_1) * gravity; }
  /// m₂gλ in N m.
  [[nodiscard]] double lower_weight() const {
    return mass_2 * gravity * (parameter("physical") == 1.0 ? centre_2 : length_2);
  }
};

}  // namespace dmocbench
