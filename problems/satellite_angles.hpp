#pragma once

#include <cmath>

#include "problems/satellite_slew.hpp"

namespace dmocbench {

/// `SatelliteSlew` in Euler's angles.
///
/// q = (φ, θ, ψ), roll, pitch and yaw, R = R_z(ψ) R_y(θ) R_x(φ),
///   ω = (φ̇ - ψ̇ sin θ, θ̇ cos φ + ψ̇ cos θ sin φ, ψ̇ cos θ cos φ - θ̇ sin φ) = B(q) q̇,
///   L = ½ ωᵀJω,  f = Bᵀu,
/// singular where θ = ±90°.
class SatelliteAngles final : public SatelliteSlew {
 public:
  [[nodiscard]] std::string name() const override { return "satellite_angles"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return card_of("Euler angles", "satellite_directors in Euler's angles", "rad");
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"roll", "pitch", "yaw"}; }

  [[nodiscard]] ExpressionMatrix attitude(const ExpressionVector& q) const override {
    const Expression sin_roll = sin(q[0]), cos_roll = cos(q[0]);
    const Expression sin_pitch = sin(q[1]), cos_pitch = cos(q[1]);
    const Expression sin_yaw = sin(q[2]), cos_yaw = cos(q[2]);
    return ExpressionMatrix{{cos_yaw * cos_pitch, cos_yaw * sin_pitch * sin_roll - sin_yaw * cos_roll,
                             cos_yaw * sin_pitch * cos_roll + sin_yaw * sin_roll},
                            {sin_yaw * cos_pitch, sin_yaw * sin_pitch * sin_roll + cos_yaw * cos_roll,
                             sin_yaw * sin_pitch * cos_roll - cos_yaw * sin_roll},
                            {-sin_pitch, cos_pitch * sin_roll, cos_pitch * cos_roll}};
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return energy_of(rates(x.q) * x.v); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return rates(x.q).transpose() * x.u; }

  /// Rotations of space about the axis z.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{0.0, 0.0, 1.0}};
  }

 private:
  /// B.
  static ExpressionMatrix rates(const ExpressionVector& q) {
    return ExpressionMatrix{
        {1.0, 0.0, -sin(q[1])}, {0.0, cos(q[0]), cos(q[1]) * sin(q[0])}, {0.0, -sin(q[0]), cos(q[1]) * cos(q[0])}};
  }

  /// Angles without jumps from the beginning of the slew on.
  [[nodiscard]] BoundaryState turned(double angle, double rate) const override {
    constexpr int steps = 64;
    Eigen::Vector3d q = Eigen::Vector3d::Zero();
    for (int step = 1; step <= steps; ++step) {
      const Eigen::Matrix3d r = Eigen::AngleAxisd(angle * step / steps, axis()).toRotationMatrix();
      const Eigen::Vector3d principal(std::atan2(r(2, 1), r(2, 2)), -std::asin(r(2, 0)), std::atan2(r(1, 0), r(0, 0)));
      for (const Eigen::Index i : {0, 1, 2}) q[i] += std::remainder(principal[i] - q[i], 2.0 * std::numbers::pi);
    }
    const Eigen::Vector3d omega = rate * axis();
    const double across = std::sin(q[0]) * omega[1] + std::cos(q[0]) * omega[2];
    return {.q = q,
            .v = Eigen::Vector3d(omega[0] + std::tan(q[1]) * across,
                                 std::cos(q[0]) * omega[1] - std::sin(q[0]) * omega[2], across / std::cos(q[1]))};
  }
};

}  // namespace dmocbench
