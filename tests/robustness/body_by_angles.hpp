#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// The body of `RigidBodySlew` with its attitude by three angles q = (φ, θ, ψ), roll, pitch and yaw, R = R_z(ψ) R_y(θ)
/// R_x(φ): L = ½ ωᵀJω, C = ½|u|², from rest to rest in one unit of time. Roll and yaw turn about the same axis where
/// cos θ = 0; L_vv is singular there.
class BodyByAngles final : public SmallProblem {
 public:
  /// Half a turn about the first principal axis: cost 6 J² π² = 6π².
  static BodyByAngles roll() { return {"roll_by_angles", {std::numbers::pi, 0.0, 0.0}}; }
  /// Half a turn about the second one, across the singularity of the angles: cost 6 J² π² = 24π².
  static BodyByAngles pitch() { return {"pitch_by_angles", {0.0, std::numbers::pi, 0.0}}; }
  /// By 2 rad about (1, 2, 2)/3, as `RigidBodySlew::slanted`.
  static BodyByAngles slanted() {
    const double half = 1.0;
    const double c = std::cos(half);
    const double s = std::sin(half) / 3.0;
    const std::array<double, 4> q = {c, s, 2.0 * s, 2.0 * s};
    return {"slanted_by_angles",
            {std::atan2(2.0 * (q[0] * q[1] + q[2] * q[3]), 1.0 - 2.0 * (q[1] * q[1] + q[2] * q[2])),
             std::asin(2.0 * (q[0] * q[2] - q[3] * q[1])),
             std::atan2(2.0 * (q[0] * q[3] + q[1] * q[2]), 1.0 - 2.0 * (q[2] * q[2] + q[3] * q[3]))}};
  }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression roll = x.v[0] - sin(x.q[1]) * x.v[2];
    const Expression pitch = cos(x.q[0]) * x.v[1] + cos(x.q[1]) * sin(x.q[0]) * x.v[2];
    const Expression yaw = cos(x.q[1]) * cos(x.q[0]) * x.v[2] - sin(x.q[0]) * x.v[1];
    return 0.5 * (inertia[0] * roll * roll + inertia[1] * pitch * pitch + inertia[2] * yaw * yaw);
  }
  /// (∂ω/∂q̇)ᵀ u: the virtual work of the torques.
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression across = sin(x.q[0]) * x.u[1] + cos(x.q[0]) * x.u[2];
    return ExpressionVector{
        {x.u[0], cos(x.q[0]) * x.u[1] - sin(x.q[0]) * x.u[2], cos(x.q[1]) * across - sin(x.q[1]) * x.u[0]}};
  }
  [[nodiscard]] double cost_scale() const override { return 1e-1; }

 private:
  static constexpr std::array<double, 3> inertia = {1.0, 2.0, 2.5};  // kg m²

  BodyByAngles(const std::string& name, const Eigen::Vector3d& last)
      : SmallProblem(name, BoundaryState::at_rest(Eigen::Vector3d::Zero()), BoundaryState::at_rest(last), 1.0, 3) {}
};

}  // namespace dmocbench::tests
