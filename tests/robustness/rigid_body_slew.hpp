#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// A rigid body turned from rest to rest by torques in its own axes, its attitude a quaternion q = (q_0, q_1, q_2,
/// q_3); C = ½|u|². The angular velocity is ω = 2 vec(q* q̇)/|q|², and
///   L = ½ ωᵀJω + ½ (d|q|/dt)²
/// extends the body's Lagrangian to all q ≠ 0 so that the radius moves by itself, freely: it stays 1. Of the final
/// quaternion and its velocity one entry each is free, as the radius has them already.
class RigidBodySlew final : public SmallProblem {
 public:
  /// Half a turn about the first principal axis in one unit of time: J θ̈ = u, cost 6 J² π² = 6π².
  static RigidBodySlew roll() { return {"roll", {0.0, 1.0, 0.0, 0.0}, 1, unlimited}; }
  /// The same with torques below the least that can do it, 4 J π.
  static RigidBodySlew roll_too_weak() {
    return {"roll_too_weak", {0.0, 1.0, 0.0, 0.0}, 1, 0.9 * 4.0 * std::numbers::pi};
  }
  /// By 2 rad about (1, 2, 2)/3.
  static RigidBodySlew slanted() {
    const double half = 1.0;
    const double s = std::sin(half) / 3.0;
    return {"slanted", {std::cos(half), s, 2.0 * s, 2.0 * s}, 0, unlimited};
  }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const ExpressionVector rate = angular_velocity(x.q, x.v);
    Expression kinetic = 0.0;
    for (Eigen::Index i = 0; i < 3; ++i) kinetic += 0.5 * inertia[static_cast<std::size_t>(i)] * rate[i] * rate[i];
    const Expression radial = x.q.dot(x.v);
    return kinetic + 0.5 * radial * radial / x.q.dot(x.q);
  }
  /// (∂ω/∂q̇)ᵀ u: the virtual work of the torques.
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const ExpressionVector& q = x.q;
    const ExpressionVector& u = x.u;
    const Expression factor = 2.0 / q.dot(q);
    return ExpressionVector{
        {factor * (-q[1] * u[0] - q[2] * u[1] - q[3] * u[2]), factor * (q[0] * u[0] - q[3] * u[1] + q[2] * u[2]),
         factor * (q[3] * u[0] + q[0] * u[1] - q[1] * u[2]), factor * (-q[2] * u[0] + q[1] * u[1] + q[0] * u[2])}};
  }
  [[nodiscard]] double cost_scale() const override { return 1e-1; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_configuration(free_entry_);
    bounds.last.free_velocity(free_entry_);
    if (largest_torque_ < unlimited) bounds.u = Bounds::all(3, -largest_torque_, largest_torque_);
    return bounds;
  }
  /// On the great circle, at a constant rate.
  [[nodiscard]] MotionPoint guess(double t) const override {
    const Eigen::Vector4d first(1.0, 0.0, 0.0, 0.0);
    const Eigen::Vector4d last = final_state().q;
    const double angle = std::acos(last[0]);
    const Eigen::Vector4d across = (last - last[0] * first).normalized();
    const double part = angle * t / horizon();
    return {.q = std::cos(part) * first + std::sin(part) * across,
            .v = angle / horizon() * (std::cos(part) * across - std::sin(part) * first),
            .u = Eigen::Vector3d::Zero()};
  }

 private:
  static constexpr double unlimited = 1e6;
  static constexpr std::array<double, 3> inertia = {1.0, 2.0, 2.5};  // kg m²

  RigidBodySlew(const std::string& name, const Eigen::Vector4d& last, Eigen::Index free_entry, double largest_torque)
      : SmallProblem(name, BoundaryState::at_rest(Eigen::Vector4d(1.0, 0.0, 0.0, 0.0)), BoundaryState::at_rest(last),
                     1.0, 3),
        free_entry_(free_entry),
        largest_torque_(largest_torque) {}

  static ExpressionVector angular_velocity(const ExpressionVector& q, const ExpressionVector& v) {
    const Expression factor = 2.0 / q.dot(q);
    return ExpressionVector{{factor * (q[0] * v[1] - q[1] * v[0] + q[3] * v[2] - q[2] * v[3]),
                             factor * (q[0] * v[2] - q[2] * v[0] - q[3] * v[1] + q[1] * v[3]),
                             factor * (q[0] * v[3] - q[3] * v[0] + q[2] * v[1] - q[1] * v[2])}};
  }

  Eigen::Index free_entry_;
  double largest_torque_;
};

}  // namespace dmocbench::tests
