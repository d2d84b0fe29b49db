#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// Satellites that fly in a line along their orbit and reverse their order without coming near each other.
///
/// q = (x_1, y_1, .. x_k, y_k): positions relative to a point on a circular orbit with the mean motion ω, x away from
/// the planet and y along the orbit (equations of Hill, Clohessy and Wiltshire),
///   L = Σ_i ½|q̇_i|² + ω (x_i ẏ_i - y_i ẋ_i) + 3/2 ω² x_i²,   f = u,   C = ½|u|² + ½ c Σ_{i<j} |q_i - q_j|²,
/// with |q_i - q_j|² >= d² for all pairs. From rest to rest in T = 3; (x_i, y_i) = (0, y_i⁰) becomes (0, -y_i⁰). Solved
/// in units of 1 km and 1000 s.
///
/// By symmetry the second of three satellites stays, and q_1 = -q_3 has the distance d from it at T/2 only: a linear
/// boundary value problem. Grids state distances at stages, so that costs have errors of O(h²) with every tableau.
class Formation final : public Problem {
 public:
  Formation()
      : Problem({{"satellites", 3.0, "", "number k of satellites", 2.0, 12.0, true},
                 {"distance", 0.5, "km", "least distance d between two satellites", 0.0, 2.0},
                 {"mean_motion", 1.0, "1/(1000 s)", "mean motion of the orbit", 0.0, 10.0},
                 {"attraction", 1.0, "", "weight c of the distances in the cost", 0.0, 1e3}}) {}

  [[nodiscard]] std::string name() const override { return "formation"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "reversal of the order of satellites in formation, with a least distance between them",
            .title = "Satellites in formation",
            .axis_units = {.state = "km"},
            .source =
                "after Junge, Marsden, Ober-Bloebaum: Optimal reconfiguration of formation flying spacecraft - a "
                "decentralized approach, 2006",
            .guess = "half circles around the middle, without force",
            .time_unit = {.name = "s", .factor = 1000.0},
            .configuration_units = std::vector<std::string>(static_cast<std::size_t>(2 * count()), "km"),
            .reference = with_default_parameters(
                *this, {.objective = 7.53865012201,
                        .digits = 12,
                        .certificate = "the flow of the linear boundary value problem up to T/2; DMOC and "
                                       "tangent-space collocation with 4 Gauss stages and bounds at T/2 agree"}),
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
    return 0.5 * x.u.dot(x.u) + 0.5 * varying("attraction") * squared_distances(x.q).sum();
  }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return squared_distances(x.q).array() - varying("distance") * varying("distance");
  }

  [[nodiscard]] BoundaryState initial_state() const override { return BoundaryState::at_rest(line(1.0, 0.0)); }
  [[nodiscard]] BoundaryState final_state() const override { return BoundaryState::at_rest(line(-1.0, 0.0)); }
  [[nodiscard]] double horizon() const override { return 3.0; }
  [[nodiscard]] MotionPoint guess(double t) const override {
    const double rate = std::numbers::pi / horizon();
    const double angle = rate * t;
    return {.q = line(std::cos(angle), std::sin(angle)),
            .v = rate * line(-std::sin(angle), std::cos(angle)),
            .u = Eigen::VectorXd::Zero(2 * count())};
  }

 private:
  [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(parameter("satellites")); }
  /// Positions in a line through the middle, from (-across, -along) to (across, along).
  [[nodiscard]] Eigen::VectorXd line(double along, double across) const {
    Eigen::VectorXd q(2 * count());
    for (Eigen::Index i = 0; i < count(); ++i) {
      const double at = 2.0 * static_cast<double>(i) / static_cast<double>(count() - 1) - 1.0;
      q.segment(2 * i, 2) << at * across + 0.0, at * along + 0.0;  // no -0
    }
    return q;
  }
  /// |q_i - q_j|² of all pairs, in the order of `pair_names`.
  [[nodiscard]] ExpressionVector squared_distances(const ExpressionVector& q) const {
    ExpressionVector squares(count() * (count() - 1) / 2);
    Eigen::Index pair = 0;
    for (Eigen::Index i = 0; i < 2 * count(); i += 2) {
      for (Eigen::Index j = i + 2; j < 2 * count(); j += 2) {
        const Expression across = q[i] - q[j];
        const Expression along = q[i + 1] - q[j + 1];
        squares[pair++] = across * across + along * along;
      }
    }
    return squares;
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
        names.push_back("distance_" + std::to_string(i) + "_" + std::to_string(j));
      }
    }
    return names;
  }
};

}  // namespace dmocbench
