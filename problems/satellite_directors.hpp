#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// A rigid satellite turns from rest to rest, its attitude a matrix: no angle has a singularity.
///
/// q = (d_1, d_2, d_3), the columns of the rotation matrix R, with six constraints R'R = 1;
///   L = ½ Σ_i E_i |ḋ_i|²,  E_i = ½(J_1 + J_2 + J_3) - J_i,
///   ω_1 = ½(d_3·ḋ_2 - d_2·ḋ_3) and so on, the angular velocity in the frame of the body,
/// torques u about the axes of the body do work on these ω, also where R'R is not 1; C = ½|u|². It turns by an angle
/// about an axis that is fixed in space, or any other way that costs less. About the principal axis i alone the optimum
/// is 6 J_i² α²/T³.
class SatelliteDirectors final : public Problem {
 public:
  SatelliteDirectors()
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

  [[nodiscard]] std::string name() const override { return "satellite_directors"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "slew of a rigid satellite from rest to rest, with a rotation matrix as its attitude",
            .title = "Satellite (directors)",
            .axis_units = {.state = "dimensionless"},
            .source =
                "stated for this library, after the directors of Betsch and Leyendecker; closed form about a principal "
                "axis",
            .guess = "a turn about the axis with the angle alpha (3 s^2 - 2 s^3), s = t/T; u = 0",
            .reference =
                with_default_parameters(*this, {.objective = 6.0 * std::numbers::pi * std::numbers::pi / 8.0,
                                                .digits = 16,
                                                .certificate = "closed form 6 J_1^2 pi^2/T^3: u_1 is linear in time"}),
            .picture = [](const ControlledState& x) -> Picture {
              return {{"d1_x", "", x.q[0]},   {"d1_y", "", x.q[1]},   {"d1_z", "", x.q[2]},
                      {"d2_x", "", x.q[3]},   {"d2_y", "", x.q[4]},   {"d2_z", "", x.q[5]},
                      {"u_1", "N m", x.u[0]}, {"u_2", "N m", x.u[1]}, {"u_3", "N m", x.u[2]}};
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override {
    return {"d1_x", "d1_y", "d1_z", "d2_x", "d2_y", "d2_z", "d3_x", "d3_y", "d3_z"};
  }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_1", "u_2", "u_3"}; }

  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    ExpressionVector g(6);
    Eigen::Index next = 0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = i; j < 3; ++j) {
        g[next++] = director(q, i).dot(director(q, j)) - (i == j ? 1.0 : 0.0);
      }
    }
    return g;
  }
  /// R = R⁰(t) cay(θ): R⁰ turns evenly by half of the slew, and Cayley's map cay(θ) by 2 arctan(|θ|/2) about θ, so that
  /// an attitude is out of reach only half a turn away from R⁰.
  [[nodiscard]] ExpressionVector moving_embedding(const ExpressionVector& theta, const Expression& t) const override {
    const Expression angle = 0.5 * parameter("angle") * t / horizon();
    const ExpressionMatrix axis = cross_matrix(this->axis());
    const ExpressionMatrix one = Eigen::Matrix3d::Identity().cast<Expression>();
    const ExpressionMatrix centre = one + sin(angle) * axis + (1.0 - cos(angle)) * axis * axis;
    const ExpressionMatrix turn = cross_matrix(theta);
    const ExpressionMatrix cayley = one + (turn + 0.5 * turn * turn) / (1.0 + 0.25 * theta.dot(theta));
    return ExpressionMatrix(centre * cayley).reshaped();
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression half_sum = 0.5 * (varying("inertia_1") + varying("inertia_2") + varying("inertia_3"));
    Expression sum = 0.0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const ExpressionVector rate = director(x.v, i);
      sum += 0.5 * (half_sum - varying("inertia_" + std::to_string(i + 1))) * rate.dot(rate);
    }
    return sum;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    ExpressionVector f(9);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Eigen::Index j = (i + 1) % 3;
      const Eigen::Index k = (i + 2) % 3;
      const Expression half = 0.5 * x.u[i];
      f.segment(3 * j, 3) += half * director(x.q, k);
      f.segment(3 * k, 3) -= half * director(x.q, j);
    }
    return f;
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }

  [[nodiscard]] BoundaryState initial_state() const override { return turned(0.0, 0.0); }
  [[nodiscard]] BoundaryState final_state() const override { return turned(parameter("angle"), 0.0); }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }

  /// Rotations of space about the axis x.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    ExpressionVector generator(9);
    for (Eigen::Index i = 0; i < 9; i += 3) generator.segment(i, 3) << 0.0, -q[i + 2], q[i + 1];
    return generator;
  }

  [[nodiscard]] MotionPoint guess(double t) const override {
    const double s = t / horizon();
    const double angle = parameter("angle");
    const BoundaryState state = turned(angle * s * s * (3.0 - 2.0 * s), angle * 6.0 * s * (1.0 - s) / horizon());
    return {state.q, state.v, Eigen::VectorXd::Zero(3)};
  }

 private:
  static ExpressionVector director(const ExpressionVector& of, Eigen::Index i) { return of.segment(3 * i, 3); }

  /// Of the slew, of length 1.
  [[nodiscard]] Eigen::Vector3d axis() const {
    return Eigen::Vector3d(parameter("axis_1"), parameter("axis_2"), parameter("axis_3")).normalized();
  }
  /// a × as a matrix.
  static ExpressionMatrix cross_matrix(const ExpressionVector& a) {
    return ExpressionMatrix{{0.0, -a[2], a[1]}, {a[2], 0.0, -a[0]}, {-a[1], a[0], 0.0}};
  }

  /// Turned by an angle about the axis, with a rate.
  [[nodiscard]] BoundaryState turned(double angle, double rate) const {
    const Eigen::Vector3d axis = this->axis();
    const Eigen::Matrix3d attitude = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    BoundaryState state{.q = attitude.reshaped(), .v = Eigen::VectorXd(9)};
    for (Eigen::Index i = 0; i < 3; ++i) state.v.segment<3>(3 * i) = rate * axis.cross(attitude.col(i));
    return state;
  }
};

}  // namespace dmocbench
