#pragma once

#include <cmath>
#include <numbers>

#include "problems/orbital_transfer.hpp"

namespace dmocbench {

/// The orbital transfer of the paper (section 4.2.1, orb_trans) in Cartesian coordinates.
///
/// q = (x, y), L = ½(ẋ² + ẏ²) + 1/r with r = sqrt(x² + y²), f = u (-y, x)/r, C = u², data and units of
/// `CircleToCircle`: `orbital_transfer` in another chart, hence with the same optimum. L_vv is constant here, so that
/// tangent-space and Hamiltonian collocation are one method. Both ends lie on the x-axis for every number of
/// revolutions d. Only the guess, a spiral, contains d, so that the solution must be checked for it.
class KeplerCartesian : public CircleToCircle {
 public:
  [[nodiscard]] std::string name() const override { return "kepler_cartesian"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = CircleToCircle::card();
    card.description = "the orbital transfer in Cartesian coordinates, where the mass matrix is constant";
    card.title = "Orbital transfer (Cartesian)";
    card.source += ", in other coordinates";
    card.guess =
        "a spiral: radius and angle on straight lines, d revolutions from circle to circle, with slope v, u = 0";
    card.picture = [this](const ControlledState& x) -> Picture {
      const Expression r = radius(x.q);
      const Expression thrust = acceleration_scale() * x.u[0];
      return {{"x", "km", initial_radius() * x.q[0]},
              {"y", "km", initial_radius() * x.q[1]},
              {"altitude", "km", initial_radius() * r - parameter("earth_radius")},
              {"thrust", "m/s^2", thrust},
              {"thrust_x", "m/s^2", -thrust * x.q[1] / r},
              {"thrust_y", "m/s^2", thrust * x.q[0] / r}};
    };
    return card;
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v.dot(x.v) + 1.0 / radius(x.q); }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression thrust_by_radius = x.u[0] / radius(x.q);
    return ExpressionVector{{-thrust_by_radius * x.q[1], thrust_by_radius * x.q[0]}};
  }

  [[nodiscard]] BoundaryState initial_state() const override {
    return {.q = Eigen::Vector2d(1.0, 0.0), .v = Eigen::Vector2d(0.0, 1.0)};
  }

  [[nodiscard]] BoundaryState final_state() const override {
    const double rho = radius_ratio();
    return {.q = Eigen::Vector2d(rho, 0.0), .v = Eigen::Vector2d(0.0, 1.0 / std::sqrt(rho))};
  }

  /// Rotations: ξ = (-y, x), the momentum is the angular momentum.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    return ExpressionVector{{-q[1], q[0]}};
  }

  [[nodiscard]] MotionPoint guess(double t) const override {
    const double rate = 2.0 * std::numbers::pi * parameter("revolutions") / horizon();
    const double growth = (radius_ratio() - 1.0) / horizon();
    const double r = 1.0 + growth * t;
    const Eigen::Vector2d outward(std::cos(rate * t), std::sin(rate * t));
    const Eigen::Vector2d along(-outward[1], outward[0]);
    return {.q = r * outward, .v = growth * outward + r * rate * along, .u = Eigen::VectorXd::Zero(1)};
  }

 private:
  [[nodiscard]] static Expression radius(const ExpressionVector& q) { return sqrt(q.dot(q)); }
};

}  // namespace dmocbench
