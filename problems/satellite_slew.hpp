#pragma once

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// A rigid satellite turns from rest to rest with the least torque; derived classes choose the coordinates q of its
/// attitude, the rotation matrix R.
///
/// Torques u about the axes of the body do work on ω, the angular velocity in the frame of the body; C = ½|u|². It
/// turns by an angle about an axis that is fixed in space, or any other way that costs less. About the principal axis i
/// alone the optimum is 6 J_i² α²/T³.
class SatelliteSlew : public Problem {
 public:
  /// R, 3 × 3.
  [[nodiscard]] virtual ExpressionMatrix attitude(const ExpressionVector& q) const = 0;
  /// The same in numbers.
  [[nodiscard]] Eigen::Matrix3d attitude_at(const Eigen::VectorXd& q) const {
    return attitude(q.cast<Expression>()).unaryExpr([](const Expression& entry) {
      return entry.constant_value().value();
    });
  }

  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_1", "u_2", "u_3"}; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }
  [[nodiscard]] BoundaryState initial_state() const override { return turned(0.0, 0.0); }
  [[nodiscard]] BoundaryState final_state() const override { return turned(parameter("angle"), 0.0); }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }
  [[nodiscard]] MotionPoint guess(double t) const override {
    const double s = t / horizon();
    const double angle = parameter("angle");
    const BoundaryState state = turned(angle * s * s * (3.0 - 2.0 * s), angle * 6.0 * s * (1.0 - s) / horizon());
    return {state.q, state.v, Eigen::VectorXd::Zero(3)};
  }

 protected:
  SatelliteSlew()
      : Problem({
            {"inertia_1", 1.0, "kg m^2", "moment of inertia J_1", 1e-3, 1e3},
            {"inertia_2", 1.5, "kg m^2", "moment of inertia J_2", 1e-3, 1e3},
            {"inertia_3", 2.0, "kg m^2", "moment of inertia J_3", 1e-3, 1e3},
            {"axis_1", 1.0, "", "first component of the axis of the slew", -1.0, 1.0},
            {"axis_2", 0.0, "", "second component of the axis", -1.0, 1.0},
            {"axis_3", 0.0, "", "third component of the axis", -1.0, 1.0},
            {"angle", std::numbers::pi, "rad", "angle alpha of the slew", 0.1, 3.1415926535897936},
            horizon_parameter(2.0, "slew"),
        }) {}

  /// q and q̇ where the body has turned by an angle about the axis of the slew and goes on at a rate.
  [[nodiscard]] virtual BoundaryState turned(double angle, double rate) const = 0;

  /// The card of a choice of coordinates.
  [[nodiscard]] ProblemCard card_of(const std::string& coordinates, const std::string& source,
                                    const std::string& unit_of_q) const {
    return {
        .description = "slew of a rigid satellite from rest to rest; coordinates of its attitude: " + coordinates,
        .title = "Satellite (" + coordinates + ")",
        .axis_units = {.state = unit_of_q, .control = "N m", .momentum = "N m s", .cost = "N² m² s", .energy = "N m"},
        .source = source + "; closed form about a principal axis",
        .guess = "a turn about the axis with the angle alpha (3 s^2 - 2 s^3), s = t/T; u = 0",
        .reference =
            with_default_parameters(*this, {.objective = 6.0 * std::numbers::pi * std::numbers::pi / 8.0,
                                            .digits = 16,
                                            .certificate = "closed form 6 J_1^2 pi^2/T^3: u_1 is linear in time"}),
        .picture = [this](const ControlledState& x) -> Picture {
          const ExpressionMatrix r = attitude(x.q);
          return {{"d1_x", "", r(0, 0)},  {"d1_y", "", r(1, 0)},  {"d1_z", "", r(2, 0)},
                  {"d2_x", "", r(0, 1)},  {"d2_y", "", r(1, 1)},  {"d2_z", "", r(2, 1)},
                  {"u_1", "N m", x.u[0]}, {"u_2", "N m", x.u[1]}, {"u_3", "N m", x.u[2]}};
        }};
  }
  /// Of the slew, of length 1.
  [[nodiscard]] Eigen::Vector3d axis() const {
    return Eigen::Vector3d(parameter("axis_1"), parameter("axis_2"), parameter("axis_3")).normalized();
  }
  /// a × as a matrix.
  [[nodiscard]] static ExpressionMatrix cross_matrix(const ExpressionVector& a) {
    return ExpressionMatrix{{0.0, -a[2], a[1]}, {a[2], 0.0, -a[0]}, {-a[1], a[0], 0.0}};
  }
  /// The rotation by the quaternion q/|q|.
  [[nodiscard]] static ExpressionMatrix rotation_by(const ExpressionVector& q) {
    const ExpressionMatrix turn = cross_matrix(q.tail(3));
    const ExpressionMatrix one = Eigen::Matrix3d::Identity().cast<Expression>();
    return one + 2.0 / q.dot(q) * (q[0] * turn + turn * turn);
  }
  /// A chart of attitudes that moves with time, as a quaternion of length √(1 + |θ|²/4): q⁰(t) (1, θ/2). q⁰ turns
  /// evenly by half of the slew, and (1, θ/2), Cayley's map, by 2 arctan(|θ|/2) about θ, so that an attitude is out of
  /// reach only half a turn away from q⁰.
  [[nodiscard]] ExpressionVector chart_at(const ExpressionVector& theta, const Expression& t) const {
    const Expression half_angle = 0.25 * parameter("angle") * t / horizon();
    const Expression scalar = cos(half_angle);
    const ExpressionVector vector = sin(half_angle) * axis().cast<Expression>();
    const ExpressionVector turn = 0.5 * theta;
    ExpressionVector chart(4);
    chart << scalar - vector.dot(turn), vector + scalar * turn + cross_matrix(vector) * turn;
    return chart;
  }
  /// J_1, J_2, J_3.
  [[nodiscard]] ExpressionVector inertia() const {
    return ExpressionVector{{varying("inertia_1"), varying("inertia_2"), varying("inertia_3")}};
  }
  /// ½ωᵀJω.
  [[nodiscard]] Expression energy_of(const ExpressionVector& omega) const {
    return 0.5 * omega.dot(inertia().cwiseProduct(omega));
  }
};

}  // namespace dmocbench
