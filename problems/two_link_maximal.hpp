#pragma once

#include "problems/redundant_statement.hpp"
#include "problems/two_link_manipulator.hpp"

namespace dmocbench {

/// `two_link_manipulator` in maximal coordinates: q = (x_1, y_1, φ_1, x_2, y_2, φ_2), the centre and the orientation of
/// either link, joined by two constraints at the shoulder and two at the elbow;
///   L = Σ_i ½m_i(ẋ_i² + ẏ_i²) + ½J_iφ̇_i² - m_igy_i,  f = (0, 0, τ_1 - τ_2, 0, 0, τ_2),  C = ½(τ_1² + τ_2²).
class TwoLinkMaximal final : public RedundantStatement<TwoLinkManipulator> {
 public:
  [[nodiscard]] std::string name() const override { return "two_link_maximal"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    const ProblemCard of_angles = minimal().card();
    return {.description = "swing-up of a planar two-link arm, each link a separate body held by joints",
            .title = "Two-link manipulator (maximal coordinates)",
            .axis_units =
                {.state = "m or rad", .control = "N m", .momentum = "N s or N m s", .cost = "N² m² s", .energy = "N m"},
            .source = "two_link_manipulator in maximal coordinates with two constraints per joint",
            .guess = "as in two_link_manipulator",
            .reference = of_angles.reference,
            .picture = [](const ControlledState& x) -> Picture {
              // The elbow lies as far beyond the centre of link 1 as the shoulder, at the origin, before it.
              const Expression elbow_x = 2.0 * x.q[0];
              const Expression elbow_y = 2.0 * x.q[1];
              return {{"elbow_x", "m", elbow_x},
                      {"elbow_y", "m", elbow_y},
                      {"tip_x", "m", 2.0 * x.q[3] - elbow_x},
                      {"tip_y", "m", 2.0 * x.q[4] - elbow_y},
                      {"tau_1", "N m", x.u[0]},
                      {"tau_2", "N m", x.u[1]}};
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override {
    return {"x_1", "y_1", "phi_1", "x_2", "y_2", "phi_2"};
  }

  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    const Expression half_1 = 0.5 * varying("length_1");
    const Expression half_2 = 0.5 * varying("length_2");
    return ExpressionVector{{q[0] - half_1 * cos(q[2]), q[1] - half_1 * sin(q[2]),
                             q[3] - q[0] - half_1 * cos(q[2]) - half_2 * cos(q[5]),
                             q[4] - q[1] - half_1 * sin(q[2]) - half_2 * sin(q[5])}};
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const auto body = [&](Eigen::Index first, const Expression& m, const Expression& inertia) {
      const auto rate = [&](Eigen::Index j) { return x.v[first + j]; };
      return 0.5 * m * (rate(0) * rate(0) + rate(1) * rate(1)) + 0.5 * inertia * rate(2) * rate(2) -
             m * varying("gravity") * x.q[first + 1];
    };
    return body(0, varying("mass_1"), varying("inertia_1")) + body(3, varying("mass_2"), varying("inertia_2"));
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{0.0, 0.0, x.u[0] - x.u[1], 0.0, 0.0, x.u[1]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }

  /// Rotations of the whole arm.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    return ExpressionVector{{-q[1], q[0], 1.0, -q[4], q[3], 1.0}};
  }

  [[nodiscard]] ExpressionVector embedding(const ExpressionVector& theta) const override {
    const Expression half_1 = 0.5 * parameter("length_1");
    const Expression half_2 = 0.5 * parameter("length_2");
    const Expression x = half_1 * cos(theta[0]);
    const Expression y = half_1 * sin(theta[0]);
    return ExpressionVector{
        {x, y, theta[0], 2.0 * x + half_2 * cos(theta[1]), 2.0 * y + half_2 * sin(theta[1]), theta[1]}};
  }
};

}  // namespace dmocbench
