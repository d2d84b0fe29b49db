#pragma once

#include <numbers>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// A quadrotor in space, a rigid body, follows a curve that it cannot keep up with; its last state is free.
///
/// q = (x, y, z, φ, θ, ψ), place, roll, pitch and yaw, the body turned by R = R_z(ψ) R_y(θ) R_x(φ), its angular
/// velocity in the body's frame
///   ω = (φ̇ - ψ̇ sin θ, θ̇ cos φ + ψ̇ cos θ sin φ, ψ̇ cos θ cos φ - θ̇ sin φ) = B(q) q̇,
/// all divided by the mass, J in m² (a racing drone of 0.5 kg with moments of 0.0023, 0.0023, 0.004 kg m²):
///   L = ½(ẋ² + ẏ² + ż²) + ½ωᵀJω - g z,   f = (u₁ R e₃, BᵀJ(u₂, u₃, u₄)),
///   C = ½[(x - sin 2πs)² + (y - 2 sin 4πs)² + (z - 2s)² + φ² + θ² + ψ² + r(u₁² + |ω|²) + ρ(u₂² + u₃² + u₄²)],
///   s = t/T,
/// r = 0.1, ρ = 0.001, T = 1 s, from rest at q = 0: u₁ is the thrust by the mass in m/s², (u₂, u₃, u₄) the torque by
/// the moments of inertia in rad/s².
///
/// The published problem commands the angular velocity itself, (u₂, u₃, u₄) instead of ω, so that its angles have
/// no inertia: nine first-order equations, not a mechanical system. Here torques turn a body, twelve first-order
/// equations; the published cost of the angular velocity stays, and a cost of the torques is added. There the rate of
/// the first angle is moreover the usual rate of yaw; here the angles are Euler's. Thrust, curve, weights and T are the
/// same.
class RigidQuadrotor final : public Problem {
 public:
  RigidQuadrotor()
      : Problem({
            {"inertia_x", 0.0046, "m^2", "moment of inertia J_1 per mass about the body's x axis", 1e-6, 1e2},
            {"inertia_y", 0.0046, "m^2", "moment of inertia J_2 per mass about the body's y axis", 1e-6, 1e2},
            {"inertia_z", 0.008, "m^2", "moment of inertia J_3 per mass about the body's z axis", 1e-6, 1e2},
            gravity_parameter(0.0, 9.8),
            {"effort_weight", 0.1, "", "weight r of thrust and angular velocity", 1e-6, 1e3},
            {"torque_weight", 1e-3, "", "weight rho of the torques", 1e-9, 1e3},
            horizon_parameter(1.0, "flight"),
        }) {}

  [[nodiscard]] std::string name() const override { return "rigid_quadrotor"; }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "flight of a quadrotor, a rigid body, along a curve in fixed time; the final state is free",
            .title = "Quadrotor in space",
            .axis_units = {.state = "m or rad", .control = "m/s² or rad/s²", .momentum = "m/s or m²/s", .cost = "m² s"},
            .source =
                "Montoison, Caillau: Modeling and Optimization of Control Problems on GPUs (arXiv:2510.03932), problem "
                "quadrotor, after ExaModels.jl; with torques instead of angular velocities",
            .guess = "hovering: q on the straight line to (0, 0, 2 m) with slope v, u_1 = g, no torque",
            .reference = with_default_parameters(
                *this, {.objective = 4.27652988126,
                        .digits = 12,
                        .certificate = "Gauss with s = 3 and Lobatto with s = 4 on 128 intervals and a replay agree",
                        .remark = "no value of this problem is published; the published problem has no torques"}),
            .picture = [this](const ControlledState& x) -> Picture {
              const ExpressionVector curve = curve_at(x.t);
              return {{"x", "m", x.q[0]},         {"y", "m", x.q[1]},         {"z", "m", x.q[2]},
                      {"curve_x", "m", curve[0]}, {"curve_y", "m", curve[1]}, {"curve_z", "m", curve[2]},
                      {"thrust", "m/s^2", x.u[0]}};
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override {
    return {"x", "y", "z", "roll", "pitch", "yaw"};
  }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_1", "u_2", "u_3", "u_4"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    Expression turning = 0.0;
    const ExpressionVector omega = angular_velocity(x.q, x.v);
    const ExpressionVector moments = inertia();
    for (Eigen::Index i = 0; i < 3; ++i) turning += moments[i] * omega[i] * omega[i];
    return 0.5 * (x.v[0] * x.v[0] + x.v[1] * x.v[1] + x.v[2] * x.v[2]) + 0.5 * turning - varying("gravity") * x.q[2];
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Attitude at(x.q);
    const ExpressionVector moments = inertia();
    const Expression roll_torque = moments[0] * x.u[1];
    const Expression pitch_torque = moments[1] * x.u[2];
    const Expression yaw_torque = moments[2] * x.u[3];
    const Expression sideways = at.sin_roll * pitch_torque + at.cos_roll * yaw_torque;
    return ExpressionVector{{x.u[0] * (at.cos_roll * at.sin_pitch * at.cos_yaw + at.sin_roll * at.sin_yaw),
                             x.u[0] * (at.cos_roll * at.sin_pitch * at.sin_yaw - at.sin_roll * at.cos_yaw),
                             x.u[0] * at.cos_roll * at.cos_pitch,  //
                             roll_torque, at.cos_roll * pitch_torque - at.sin_roll * yaw_torque,
                             at.cos_pitch * sideways - at.sin_pitch * roll_torque}};
  }

  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    const ExpressionVector curve = curve_at(x.t);
    const ExpressionVector omega = angular_velocity(x.q, x.v);
    Expression tracking = 0.0;
    Expression effort = x.u[0] * x.u[0];
    Expression torque = 0.0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Expression off = x.q[i] - curve[i];
      tracking += off * off + x.q[3 + i] * x.q[3 + i];
      effort += omega[i] * omega[i];
      torque += x.u[1 + i] * x.u[1 + i];
    }
    return 0.5 * (tracking + varying("effort_weight") * effort + varying("torque_weight") * torque);
  }

  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Zero(6));
  }
  [[nodiscard]] BoundaryState final_state() const override {
    BoundaryState last = initial_state();
    last.q[2] = climb;
    return last;
  }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last = {.q = Bounds::none(6), .v = Bounds::none(6)};
    return bounds;
  }

  [[nodiscard]] MotionPoint guess(double t) const override {
    MotionPoint point = Problem::guess(t);
    point.u[0] = parameter("gravity");
    return point;
  }

  /// Horizontal translations.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{1.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
  }

 private:
  static constexpr double climb = 2.0;  // m

  struct Attitude {
    Expression sin_roll, cos_roll, sin_pitch, cos_pitch, sin_yaw, cos_yaw;
    explicit Attitude(const ExpressionVector& q)
        : sin_roll(sin(q[3])),
          cos_roll(cos(q[3])),
          sin_pitch(sin(q[4])),
          cos_pitch(cos(q[4])),
          sin_yaw(sin(q[5])),
          cos_yaw(cos(q[5])) {}
  };

  [[nodiscard]] ExpressionVector inertia() const {
    return ExpressionVector{{varying("inertia_x"), varying("inertia_y"), varying("inertia_z")}};
  }

  /// ω.
  [[nodiscard]] static ExpressionVector angular_velocity(const ExpressionVector& q, const ExpressionVector& v) {
    const Attitude at(q);
    const Expression turn = v[5] * at.cos_pitch;
    return ExpressionVector{
        {v[3] - v[5] * at.sin_pitch, v[4] * at.cos_roll + turn * at.sin_roll, turn * at.cos_roll - v[4] * at.sin_roll}};
  }

  [[nodiscard]] ExpressionVector curve_at(const Expression& t) const {
    using std::numbers::pi;
    const Expression s = t / horizon();
    return ExpressionVector{{sin(2.0 * pi * s), 2.0 * sin(4.0 * pi * s), climb * s}};
  }
};

}  // namespace dmocbench
