#pragma once

#include <cmath>

#include "problems/satellite_slew.hpp"

namespace dmocbench {

/// `SatelliteSlew` by a quaternion q = (q_0, q_1, q_2, q_3) with the constraint |q|² = 1.
///
/// R is the rotation by q/|q|, ω = 2 vec(q* q̇)/|q|² = B(q) q̇,
///   L = ½ ωᵀJω + ½ (J_1 + J_2 + J_3) (d|q|/dt)²,  f = Bᵀu:
/// the constraint keeps a radius that moves by itself. By DMOC with one Gauss stage the unit quaternions of two nodes
/// have h ω = 4 tan(φ/4) a at the stage, if φ and a are angle and axis of the rotation between them: Cayley's map of
/// unit quaternions is then the retraction of a Lie group integrator.
class SatelliteQuaternion final : public SatelliteSlew {
 public:
  [[nodiscard]] std::string name() const override { return "satellite_quaternion"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return card_of("quaternion", "satellite_directors by a quaternion", "dimensionless");
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"q_0", "q_1", "q_2", "q_3"}; }

  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    return ExpressionVector{{q.dot(q) - 1.0}};
  }
  /// The chart of `SatelliteSlew`, at every node another one.
  [[nodiscard]] ExpressionVector moving_embedding(const ExpressionVector& theta, const Expression& t) const override {
    return 1.0 / sqrt(1.0 + 0.25 * theta.dot(theta)) * chart_at(theta, t);
  }
  [[nodiscard]] ExpressionMatrix attitude(const ExpressionVector& q) const override { return rotation_by(q); }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression radial = x.q.dot(x.v);
    return energy_of(rates(x.q) * x.v) + 0.5 * inertia().sum() * radial * radial / x.q.dot(x.q);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return rates(x.q).transpose() * x.u; }

  /// Rotations of space about the axis x.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    return ExpressionVector{{-0.5 * q[1], 0.5 * q[0], -0.5 * q[3], 0.5 * q[2]}};
  }

 private:
  /// B.
  static ExpressionMatrix rates(const ExpressionVector& q) {
    const ExpressionMatrix one = Eigen::Matrix3d::Identity().cast<Expression>();
    ExpressionMatrix b(3, 4);
    b << -q.tail(3), q[0] * one - cross_matrix(q.tail(3));
    return 2.0 / q.dot(q) * b;
  }

  [[nodiscard]] BoundaryState turned(double angle, double rate) const override {
    BoundaryState state{.q = Eigen::VectorXd(4), .v = Eigen::VectorXd(4)};
    state.q << std::cos(0.5 * angle), std::sin(0.5 * angle) * axis();
    state.v << -0.5 * rate * std::sin(0.5 * angle), 0.5 * rate * std::cos(0.5 * angle) * axis();
    return state;
  }
};

}  // namespace dmocbench
