#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "bench/extensions/step_control/kepler_ellipse.hpp"

namespace dmocbench {

/// The transfer from the pericentre of an ellipse with semi-major axis 1 to the pericentre of one with semi-major
/// axis 1.2 and the same eccentricity and direction, after one revolution, with the least C = ½|u|²: L = ½|q̇|² + 1/|q|,
/// f = u in the plane.
class EllipseTransfer final : public KeplerEllipse {
 public:
  explicit EllipseTransfer(double eccentricity) : KeplerEllipse(eccentricity) {}

  [[nodiscard]] std::string name() const override { return "ellipse_transfer"; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_x", "u_y"}; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }
  [[nodiscard]] BoundaryState final_state() const override {
    const BoundaryState start = initial_state();
    return {.q = last_axis * start.q, .v = start.v / std::sqrt(last_axis)};
  }
  /// The period of the ellipse between both.
  [[nodiscard]] double horizon() const override { return period * std::pow(0.5 * (1.0 + last_axis), 1.5); }
  /// The free motion along an ellipse that grows at a constant rate.
  [[nodiscard]] MotionPoint guess(double t) const override {
    const double rate = period / horizon();
    const double growth = (last_axis - 1.0) / horizon();
    const double axis = 1.0 + growth * t;
    const MotionPoint free = free_motion(rate * t);
    return {.q = axis * free.q, .v = growth * free.q + axis * rate * free.v, .u = Eigen::Vector2d::Zero()};
  }

 private:
  static constexpr double last_axis = 1.2;
};

}  // namespace dmocbench
