#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Reconfiguration of k satellites that fly in formation and must not come near each other, after the application that
/// section 1 of the paper cites.
///
/// q = (x_1, y_1, .. x_k, y_k): positions relative to a point on a circular orbit with the mean motion ω, x away from
/// the planet and y along the orbit (Hill, Clohessy and Wiltshire),
///   L = Σ_i ½|q̇_i|² + ω (x_i ẏ_i - y_i ẋ_i) + 3/2 ω² x_i²,   f = u,   C = Σ_i ½|u_i|² + ½ c |Σ_i q_i / k|²:
/// c holds the centre of the formation at the point. |q_i - q_j|² >= d² for all pairs. From rest on a regular polygon
/// of radius 1 to rest at the opposite vertices, so that all would meet in the middle. Solved
/// in units of 1 km and of the time 1/ω_0 = 1000 s; T = 3.
class Formation final : public Problem {
 public:
  Formation()
      : Problem({{"satellites", 3.0, "", "number k of satellites", 2.0, 12.0, true},
                 {"distance", 0.6, "km", "the least distance d of two satellites", 0.0, 1.0},
                 {"mean_motion", 1.0, "1/(1000 s)", "of the orbit", 0.0, 10.0},
                 {"centring", 1.0, "", "weight c of the centre of the formation", 0.0, 1e3}}) {}

  [[nodiscard]] std::string name() const override { return "formation"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "satellites in formation change places with least distances between them",
            .source =
                "after Junge, Marsden, Ober-Bloebaum: Optimal reconfiguration of formation flying spacecraft - a "
                "decentralized approach, 2006",
            .guess = "all on half circles around the point, one behind the other, without force",
            .time_unit = {.name = "s", .factor = 1000.0},
            .path_constraint_names = pair_names(),
            .picture = [this](const ControlledState& x) -> Picture {
              Picture quantities;
              const std::vector<std::string> names = configuration_names();
              for (Eigen::Index i = 0; i < x.q.size(); ++i) {
                quantities.push_back({names[static_cast<std::size_t>(i)], "km", x.q[i]});
              }
              return quantities;
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return per_satellite("x_", "y_"); }
  [[nodiscard]] std::vector<std::string> control_names() const override { return per_satellite("u_x_", "u_y_"); }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression rate = varying("mean_motion");
    Expression sum = 0.5 * x.v.dot(x.v);
    for (Eigen::Index i = 0; i < 2 * count(); i += 2) {
      sum += rate * (x.q[i] * x.v[i + 1] - x.q[i + 1] * x.v[i]) + 1.5 * rate * rate * x.q[i] * x.q[i];
    }
    return sum;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    Expression across = 0.0;
    Expression along = 0.0;
    for (Eigen::Index i = 0; i < 2 * count(); i += 2) {
      across += x.q[i];
      along += x.q[i + 1];
    }
    const auto k = static_cast<double>(count());
    return 0.5 * x.u.dot(x.u) + 0.5 / (k * k) * varying("centring") * (across * across + along * along);
  }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    ExpressionVector apart(count() * (count() - 1) / 2);
    Eigen::Index pair = 0;
    for (Eigen::Index i = 0; i < count(); ++i) {
      for (Eigen::Index j = i + 1; j < count(); ++j) {
        const Expression across = x.q[2 * i] - x.q[2 * j];
        const Expression along = x.q[2 * i + 1] - x.q[2 * j + 1];
        apart[pair++] = across * across + along * along - varying("distance") * varying("distance");
      }
    }
    return apart;
  }

  [[nodiscard]] BoundaryState initial_state() const override { return BoundaryState::at_rest(polygon(0.0)); }
  [[nodiscard]] BoundaryState final_state() const override { return BoundaryState::at_rest(polygon(std::numbers::pi)); }
  [[nodiscard]] double horizon() const override { return 3.0; }
  [[nodiscard]] MotionPoint guess(double t) const override {
    const double rate = -std::numbers::pi / horizon();  // as Coriolis forces turn
    MotionPoint point = Problem::guess(t);
    point.q = polygon(rate * t);
    for (Eigen::Index i = 0; i < 2 * count(); i += 2) {
      point.v[i] = -rate * point.q[i + 1];
      point.v[i + 1] = rate * point.q[i];
    }
    return point;
  }

 private:
  [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(parameter("satellites")); }
  /// The vertices of the polygon, turned by an angle.
  [[nodiscard]] Eigen::VectorXd polygon(double angle) const {
    Eigen::VectorXd q(2 * count());
    for (Eigen::Index i = 0; i < count(); ++i) {
      const double at = angle + 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count());
      q.segment(2 * i, 2) << std::cos(at), std::sin(at);
    }
    return q;
  }
  [[nodiscard]] std::vector<std::string> per_satellite(const std::string& x, const std::string& y) const {
    std::vector<std::string> names;
    for (Eigen::Index i = 1; i <= count(); ++i) {
      names.push_back(x + std::to_string(i));
      names.push_back(y + std::to_string(i));
    }
    return names;
  }
  [[nodiscard]] std::vector<std::string> pair_names() const {
    std::vector<std::string> names;
    for (Eigen::Index i = 1; i <= count(); ++i) {
      for (Eigen::Index j = i + 1; j <= count(); ++j) {
        names.push_back("apart_" + std::to_string(i) + "_" + std::to_string(j));
      }
    }
    return names;
  }
};

}  // namespace dmocbench
