#pragma once

#include <utility>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// A quadrotor in a vertical plane, flown from one place to another.
///
/// q = (x, y, θ), θ counterclockwise from level; u = (u₁, u₂) the thrusts of the right and the left pair of rotors,
/// F = u₁ + u₂:
///   L = ½m(ẋ² + ẏ²) + ½Iθ̇² - mgy,  f = (-F sin θ, F cos θ, r(u₁ - u₂)),  C = u₁² + u₂²,
/// m = 0.486, I = 0.00383, r = 0.25. From (0, 0, 0) to (2, 1, 0) at rest in T = 1.5 s; by option 0 <= u <= mg.
class PlanarQuadrotor : public Problem {
 public:
  PlanarQuadrotor() : PlanarQuadrotor(flight_duration) {}

  [[nodiscard]] std::string name() const override { return "planar_quadrotor"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description =
                "flight of a quadrotor in a vertical plane from rest to rest in fixed time, with least control effort",
            .title = "Planar quadrotor",
            .axis_units = {.state = "m or rad", .control = "N", .momentum = "N s", .cost = "N² s", .energy = "N m"},
            .source = "Tedrake: Underactuated Robotics, chapter 3 (the planar quadrotor), with a flight of this suite",
            .guess = "q on the straight line from q(0) to q(T) with slope v, u_1 = u_2 = m g / 2 (hovering)",
            .configuration_units = {"m", "m", "rad"},
            .control_units = {"N", "N"},
            .reference = with_default_parameters(
                *this,
                {.objective = 19.81198431842,
                 .digits = 11,
                 .certificate = certificate,
                 .remark = "no published value is known; the optional bounds are not active; other "
                           "minima cost more and tumble on the way (23.05, 23.38, 25.58)"},
                {"bounded"}),
            .picture = [this](const ControlledState& x) -> Picture {
              const double r = parameter("arm");
              const Expression arm_x = r * cos(x.q[2]);
              const Expression arm_y = r * sin(x.q[2]);
              return {{"x", "m", x.q[0]},
                      {"y", "m", x.q[1]},
                      {"right_x", "m", x.q[0] + arm_x},
                      {"right_y", "m", x.q[1] + arm_y},
                      {"left_x", "m", x.q[0] - arm_x},
                      {"left_y", "m", x.q[1] - arm_y},
                      {"right_thrust", "N", x.u[0]},
                      {"left_thrust", "N", x.u[1]}};
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y", "theta"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_1", "u_2"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression m = varying("mass");
    return 0.5 * m * (x.v[0] * x.v[0] + x.v[1] * x.v[1]) + 0.5 * varying("inertia") * x.v[2] * x.v[2] -
           m * varying("gravity") * x.q[1];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression thrust = x.u[0] + x.u[1];
    return ExpressionVector{{-thrust * sin(x.q[2]), thrust * cos(x.q[2]), varying("arm") * (x.u[0] - x.u[1])}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return x.u[0] * x.u[0] + x.u[1] * x.u[1];
  }

  [[nodiscard]] BoundaryState initial_state() const override { return BoundaryState::at_rest(Eigen::Vector3d::Zero()); }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::Vector3d(2.0, 1.0, 0.0));
  }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    if (is_bounded()) bounds.u = Bounds::all(2, 0.0, weight());
    return bounds;
  }

  /// Hovering for a second costs 11.4.
  [[nodiscard]] double cost_scale() const override { return 0.1; }

  /// The straight line, hovering.
  [[nodiscard]] MotionPoint guess(double t) const override {
    MotionPoint point = Problem::guess(t);
    point.u.setConstant(0.5 * weight());
    return point;
  }

  /// Horizontal translations.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{1.0, 0.0, 0.0}};
  }

 protected:
  static constexpr double flight_duration = 1.5;  ///< s
  static constexpr const char* certificate =      ///< how the optimum was certified
      "Gauss and Lobatto with s = 4 on 192 intervals, a replay and the indirect method agree";
  /// A flight that lasts `duration` seconds unless it is set.
  explicit PlanarQuadrotor(double duration)
      : Problem({
            {"mass", 0.486, "kg", "mass m", 1e-3, 1e3},
            {"inertia", 0.00383, "kg m^2", "inertia I about the centre", 1e-6, 1e3},
            {"arm", 0.25, "m", "distance r of the rotors from the centre", 1e-3, 1e2},
            gravity_parameter(0.0),
            horizon_parameter(duration, "flight"),
            switch_parameter("bounded", false, "1: 0 <= u <= m g for both thrusts, 0: no bounds"),
        }) {}

  /// True if the rotors' thrusts are bounded.
  [[nodiscard]] bool is_bounded() const { return parameter("bounded") == 1.0; }
  /// mg in N.
  [[nodiscard]] double weight() const { return parameter("mass") * parameter("gravity"); }
};

}  // namespace dmocbench
