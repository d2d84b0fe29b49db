#pragma once

#include <cmath>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A beam below a ceiling, the problem of Bryson and Denham with a bound on the state: the elastic line x(t) leaves one
/// clamp with slope 1 and comes back to the other with slope -1, bent as little as possible, x <= l between them.
///
/// L = ½ẋ², f = u, C = u², x(0) = x(1) = 0, ẋ(0) = 1, ẋ(1) = -1. Symmetric about t = ½, and for t <= ½:
///   l >= 1/4: the bound is not active, u = -2, J = 4;
///   1/6 <= l <= 1/4: x touches it at ½, u = -8(1 - 3l) + 24(1 - 4l)t, J = 4 + 12(1 - 4l)²;
///   l <= 1/6: x lies on it for 3l <= t <= 1 - 3l, u = -2/(3l)(1 - t/(3l)) before and 0 there, J = 8/(9l).
/// ψ^p = -2u; ψ^q = -ψ̇^p jumps where x reaches the bound and where it leaves it. (With the factor ½ that some authors
/// write before u², costs and costates are half of these.)
class Beam : public Problem {
 public:
  Beam() : Problem({{"bound", 0.1, "", "bound l of x", 1e-3, 1.0}}) {}

  [[nodiscard]] std::string name() const override { return "beam"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {
        .description = "elastic beam between two clamps and below a bound, with least bending",
        .title = "Beam below a bound",
        .axis_units = {.state = "dimensionless",
                       .control = "dimensionless",
                       .momentum = "dimensionless",
                       .energy = "dimensionless"},
        .source =
            "Bryson, Denham, Dreyfus (1963); Bryson, Ho: Applied Optimal Control, section 3.11; beam of "
            "OptimalControlProblems.jl",
        .guess = "the beam without a bound, x = t(1 - t), limited to x <= l",
        .time_unit = {.name = "", .factor = 1.0},
        .reference = ReferenceOptimum{.objective = least_cost(),
                                      .digits = 16,
                                      .certificate = "closed form, 8/(9 l) if x reaches the bound",
                                      .remark = "with a bound only at the nodes, the cost is lower by O(h^2), or equal "
                                                "if nodes lie at 3 l and 1 - 3 l, as with multiples of ten intervals"},
        .picture = [](const ControlledState& x) -> Picture {
          return {{"deflection", "", x.q[0]}, {"slope", "", x.v[0]}, {"bending", "", x.u[0]}};
        }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }

  [[nodiscard]] BoundaryState initial_state() const override { return clamp(1.0); }
  [[nodiscard]] BoundaryState final_state() const override { return clamp(-1.0); }
  [[nodiscard]] double horizon() const override { return 1.0; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.q = Bounds::none(1);
    bounds.q.upper[0] = parameter("bound");
    return bounds;
  }

  [[nodiscard]] MotionPoint guess(double t) const override {
    const double scale = std::min(1.0, 4.0 * parameter("bound"));
    MotionPoint point = Problem::guess(t);
    point.q[0] = scale * t * (1.0 - t);
    point.v[0] = scale * (1.0 - 2.0 * t);
    point.u[0] = -2.0 * scale;
    return point;
  }

  [[nodiscard]] std::optional<OptimalPoint> optimum(double t) const override {
    // Of the left half; the right one is its mirror image.
    const bool is_right = t > 0.5;
    OptimalPoint point = left_half(is_right ? 1.0 - t : t);
    if (is_right) {
      point.motion.v *= -1.0;
      point.psi_q *= -1.0;
    }
    return point;
  }

 private:
  [[nodiscard]] static BoundaryState clamp(double slope) {
    return {.q = Eigen::VectorXd::Zero(1), .v = Eigen::VectorXd::Constant(1, slope)};
  }
  [[nodiscard]] double least_cost() const {
    const double l = parameter("bound");
    if (l <= 1.0 / 6.0) return 8.0 / (9.0 * l);
    const double missing = std::max(0.0, 1.0 - 4.0 * l);
    return 4.0 + 12.0 * missing * missing;
  }
  /// 0 <= t <= ½.
  [[nodiscard]] OptimalPoint left_half(double t) const {
    const double l = parameter("bound");
    if (l <= 1.0 / 6.0) {
      if (t >= 3.0 * l) return OptimalPoint::of_numbers(l, 0.0, 0.0, 0.0, 0.0);
      const double left = 1.0 - t / (3.0 * l);
      const double bending = -2.0 / (3.0 * l) * left;
      return OptimalPoint::of_numbers(l * (1.0 - left * left * left), left * left, bending, 4.0 / (9.0 * l * l),
                                      -2.0 * bending);
    }
    const double bound = std::min(l, 0.25);
    const double a = 4.0 * (1.0 - 3.0 * bound);
    const double b = 4.0 * (1.0 - 4.0 * bound);
    const double bending = -2.0 * a + 6.0 * b * t;
    return OptimalPoint::of_numbers(t - a * t * t + b * t * t * t, 1.0 - 2.0 * a * t + 3.0 * b * t * t, bending,
                                    12.0 * b, -2.0 * bending);
  }
};

}  // namespace dmocbench
