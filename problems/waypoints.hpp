#pragma once

#include <algorithm>
#include <array>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A hovercraft on a tour of given points at given times, with the least effort: an example of InfiniteOpt.jl.
///
/// q = (x, y), L = ½|q̇|², f = u, C = |u|². From rest at (1, 1) by (4, 3) at 25 s and (6, 0) at 50 s to (1, 1) at 60 s,
/// with any velocity there. x and y are the cubic splines through the points, clamped at the start and natural at the
/// end, so that J = 12129/275000. With `width` the points become squares of twice that width.
class Waypoints final : public Problem {
 public:
  Waypoints() : Problem({{"width", 0.0, "m", "half the width of the squares around the points", 0.0, 1.0}}) {}

  [[nodiscard]] std::string name() const override { return "waypoints"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card{.description = "hovercraft that passes given points at given times, with least control effort",
                     .title = "Hovercraft through waypoints",
                     .axis_units = {.state = "m", .control = "N", .momentum = "N s", .cost = "N² s", .energy = "N m"},
                     .source = "Pulsipher, Zhang, Hongisto, Zavala: InfiniteOpt.jl, example hovercraft path planning",
                     .guess = "straight lines from point to point, without force",
                     .time_unit = {.name = "s", .factor = 1.0},
                     .picture = [](const ControlledState& x) -> Picture {
                       return {{"x", "m", x.q[0]}, {"y", "m", x.q[1]}, {"u_x", "N", x.u[0]}, {"u_y", "N", x.u[1]}};
                     }};
    if (has_default_parameters()) {
      card.reference = ReferenceOptimum{.objective = 12129.0 / 275000.0,
                                        .digits = 16,
                                        .certificate = "exact fractions from the cubic splines through the points"};
    }
    return card;
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_x", "u_y"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v.dot(x.v); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u.dot(x.u); }

  [[nodiscard]] BoundaryState initial_state() const override { return BoundaryState::at_rest(points.front().q()); }
  [[nodiscard]] BoundaryState final_state() const override { return BoundaryState::at_rest(points.back().q()); }
  [[nodiscard]] double horizon() const override { return points.back().t; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_velocity(0).free_velocity(1);
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const Eigen::Vector2d q = points[i].q();
      bounds.interior.push_back({.relative_time = points[i].t / horizon(),
                                 .q = {q.array() - parameter("width"), q.array() + parameter("width")}});
    }
    return bounds;
  }
  [[nodiscard]] MotionPoint guess(double t) const override {
    const auto* const later =
        std::ranges::find_if(points.begin() + 1, points.end() - 1, [t](const Point& p) { return t < p.t; });
    const Point& from = *(later - 1);
    const Eigen::Vector2d v = (later->q() - from.q()) / (later->t - from.t);
    return {.q = from.q() + (t - from.t) * v, .v = v, .u = Eigen::Vector2d::Zero()};
  }

 private:
  struct Point {
    double t, x, y;
    [[nodiscard]] Eigen::Vector2d q() const { return {x, y}; }
  };
  static constexpr std::array<Point, 4> points{{{0.0, 1.0, 1.0}, {25.0, 4.0, 3.0}, {50.0, 6.0, 0.0}, {60.0, 1.0, 1.0}}};
};

}  // namespace dmocbench
