#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A hang glider flies as far as it can through a thermal updraft, the glider of COPS.
///
/// q = (x, y), L = m(½|q̇|² - g y); with the updraft U(x) = u_c (1 - e) exp(-e), e = (x/r_c - 2.5)², the velocity
/// through the air is (ẋ, w), w = ẏ - U(x), of size v_r, and
///   f = ½ρS v_r (-c_L w - c_D ẋ, c_L ẋ - c_D w),   c_D = c_0 + c_1 c_L²,   u = c_L, 0 <= c_L <= 1.4,
/// C = 0, Φ = -x(T), T free, ẋ >= 0; from (0, 1000 m) to the altitude 900 m with the same velocity at both ends. Data:
/// m = 100 kg, g = 9.81 m/s², u_c = 2.5 m/s, r_c = 100 m, c_0 = 0.034, c_1 = 0.069662, S = 14 m², ρ = 1.13 kg/m³,
/// velocity (13.23, -1.288) m/s. Bulirsch, Nerz, Pesch and von Stryk, who posed it, have g = 9.80665 m/s² and
/// (13.2275675, -1.28750052) m/s. Solved in units of 100 m and 10 s, which leave accelerations in m/s², and of the mass
/// m; the cost is in m.
class HangGlider : public Problem {
 public:
  HangGlider()
      : Problem({
            {"gravity", 9.81, "m/s^2", "gravitational acceleration", 1.0, 1e2},
            {"forward_velocity", 13.23, "m/s", "horizontal velocity at both ends", 1.0, 1e2},
            {"climb_velocity", -1.288, "m/s", "vertical velocity at both ends", -1e1, 1e1},
            {"updraft", 2.5, "m/s", "speed u_c of the thermal", 0, 1e1},
            {"wing_load", 100.0 / 14.0, "kg/m^2", "mass m divided by wing area S", 1.0, 1e2},
        }) {}

  [[nodiscard]] std::string name() const override { return "hang_glider"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {
        .description = "hang glider through a thermal updraft to the largest distance",
        .title = "Hang glider",
        .axis_units = {.state = "100 m", .control = "dimensionless", .cost = "m"},
        .source =
            "Dolan, More, Munson: Benchmarking optimization software with COPS 3.0, ANL/MCS-TM-273, problem 11, after "
            "Bulirsch, Nerz, Pesch, von Stryk: Combining direct and indirect methods in optimal control (1993)",
        .guess = "q on the straight line to x = 1200 m in T = 100 s with slope v, c_L = 0.7, half its bound",
        .time_unit = {.name = "s", .factor = time_unit_in_seconds},
        .reference = reference_optimum(),
        .picture = [this](const ControlledState& x) -> Picture {
          return {{"x", "m", length_unit * x.q[0]},
                  {"y", "m", length_unit * x.q[1]},
                  {"updraft", "m/s", velocity_unit * updraft(x.q[0])},
                  {"c_l", "", x.u[0]}};
        }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"c_l"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v.dot(x.v) - varying("gravity") * x.q[1];
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    constexpr double air_density = 1.13;
    constexpr double drag_0 = 0.034;
    constexpr double drag_1 = 0.069662;
    // ½ρS/m times the square of the unit of velocity.
    const Expression factor = 0.5 * air_density / varying("wing_load") * velocity_unit * velocity_unit;
    const Expression& lift = x.u[0];
    const Expression drag = drag_0 + drag_1 * lift * lift;
    const Expression& forward = x.v[0];
    const Expression sink = x.v[1] - updraft(x.q[0]);
    const Expression pressure = factor * sqrt(forward * forward + sink * sink);
    return ExpressionVector{{-pressure * (lift * sink + drag * forward), pressure * (lift * forward - drag * sink)}};
  }

  [[nodiscard]] Expression running_cost(const ControlledState& /*x*/) const override { return 0.0; }
  [[nodiscard]] Expression final_cost(const State& last) const override { return -length_unit * last.q[0]; }

  [[nodiscard]] BoundaryState initial_state() const override {
    return {.q = Eigen::Vector2d(0.0, 1000.0 / length_unit), .v = end_velocity()};
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return {.q = Eigen::Vector2d(1200.0 / length_unit, 900.0 / length_unit), .v = end_velocity()};
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_configuration(0);
    bounds.horizon = {1.0, 100.0};
    // As in COPS: without ẋ >= 0 a glider that turns back in the thermal could gain altitude without end.
    bounds.v = Bounds::none(2);
    bounds.v.lower[0] = 0.0;
    bounds.u = Bounds::all(1, 0.0, 1.4);
    return bounds;
  }
  [[nodiscard]] double horizon() const override { return 10.0; }

  /// The optimum is about -1250 m.
  [[nodiscard]] double cost_scale() const override { return 1e-3; }

  [[nodiscard]] MotionPoint guess(double t) const override {
    MotionPoint point = Problem::guess(t);
    point.u[0] = 0.7;
    return point;
  }

 private:
  [[nodiscard]] std::optional<ReferenceOptimum> reference_optimum() const {
    const bool original = parameter("gravity") == 9.80665 && parameter("forward_velocity") == 13.2275675 &&
                          parameter("climb_velocity") == -1.28750052 &&
                          has_default_parameters({"gravity", "forward_velocity", "climb_velocity"});
    if (!original && !has_default_parameters()) return std::nullopt;
    ReferenceOptimum known{
        .objective = -1247.987601,
        .digits = 10,
        .certificate =
            "Gauss with 3 and with 2 stages on 1024 intervals, tolerance 1e-13, and the replays of both controls agree",
        .published = {{-1255.05, "COPS 3.0, trapezoidal rule, N = 100"},
                      {-1250.190, "PSOPT, example glider, 5 meshes"},
                      {-1247.918, "CTBenchmarks.jl, midpoint rule, N = 200"}},
        .remark =
            "the published values are specific to their grids: here the cost is -1247.918 with the midpoint rule on "
            "200 intervals and -1282.4, -1254.6, -1248.8, -1247.97 with the trapezoidal rule on 50, 100, 200, 400. "
            "Lobatto with four stages has false optima on 64 intervals, -1370 and -1445. A replay refutes them, and "
            "they do not exist on 128 intervals"};
    if (original) {
      known.objective = -1248.031025;
      known.published = {};
      known.remark = "gravity and end velocities of Bulirsch, Nerz, Pesch, von Stryk; the COPS data give -1247.9876";
    }
    return known;
  }

  static constexpr double length_unit = 100.0;          // m, the thermal's r_c
  static constexpr double time_unit_in_seconds = 10.0;  // s
  static constexpr double velocity_unit = length_unit / time_unit_in_seconds;

  [[nodiscard]] Eigen::Vector2d end_velocity() const {
    return Eigen::Vector2d(parameter("forward_velocity"), parameter("climb_velocity")) / velocity_unit;
  }
  /// U(x), x in r_c.
  [[nodiscard]] Expression updraft(const Expression& x) const {
    const Expression e = (x - 2.5) * (x - 2.5);
    return varying("updraft") / velocity_unit * (1.0 - e) * exp(-e);
  }
};

}  // namespace dmocbench
