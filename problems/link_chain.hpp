#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// Swing-up of a chain of n uniform rods, a motor in every joint: the two-link manipulator of the paper (section 4.2.2,
/// imp_twolink) with any number of links.
///
/// q = (θ_1 .. θ_n), the orientations of the rods measured counterclockwise from the horizontal; with
/// a_ij = n - max(i, j) + ½ for i ≠ j and a_ii = n - i + ¼,
///   L = ½ Σ_i J θ̇_i² + ½ m l² Σ_ij a_ij cos(θ_i - θ_j) θ̇_i θ̇_j - m g l Σ_i (n - i + ½) sin θ_i,
/// f_i = u_i - u_{i+1} (motor i turns rod i against rod i - 1, u_{n+1} = 0), C = ½|u|², from hanging at rest to upright
/// at rest. Data: m = 1, l = 1, J = ml²/12, T = 1.
class LinkChain : public Problem {
 public:
  LinkChain()
      : Problem({
            {"links", 3.0, "", "number n of rods", 1.0, 64.0, true},
            {"mass", 1.0, "kg", "mass of a rod", 1e-3, 1e3},
            {"length", 1.0, "m", "length of a rod", 1e-3, 1e3},
            gravity_parameter(0.0),
            horizon_parameter(1.0, "swing-up"),
        }) {}

  [[nodiscard]] std::string name() const override { return "link_chain"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "swing-up of a planar chain of n rods in fixed time, with least control effort",
            .title = "Chain of links",
            .axis_units = {.state = "rad", .control = "N m", .momentum = "N m s", .cost = "N² m² s", .energy = "N m"},
            .source =
                "Ober-Bloebaum, Junge, Marsden: Discrete Mechanics and Optimal Control: an Analysis, section 4.2.2, "
                "with n links",
            .guess =
                "q on straight lines, plus 2.5 sin(pi t/T) with alternating signs, positive for the last rod and "
                "absent for the first; slope v, u = 0",
            .reference = reference_optimum(),
            .picture = [this](const ControlledState& x) -> Picture {
              Picture quantities;
              Expression tip_x = 0.0;
              Expression tip_y = 0.0;
              for (Eigen::Index i = 0; i < links(); ++i) {
                tip_x += parameter("length") * cos(x.q[i]);
                tip_y += parameter("length") * sin(x.q[i]);
                const std::string number = std::to_string(i + 1);
                quantities.push_back({"tip_" + number + "_x", "m", tip_x});
                quantities.push_back({"tip_" + number + "_y", "m", tip_y});
              }
              const std::vector<std::string> motors = control_names();
              for (Eigen::Index i = 0; i < links(); ++i) {
                quantities.push_back({motors[static_cast<std::size_t>(i)], "N m", x.u[i]});
              }
              return quantities;
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return numbered("theta_"); }
  [[nodiscard]] std::vector<std::string> control_names() const override { return numbered("tau_"); }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression m = varying("mass");
    const Expression l = varying("length");
    const Eigen::Index n = links();
    Expression kinetic = 0.0;
    Expression height = 0.0;
    // Σ_j cos θ_j θ̇_j and Σ_j sin θ_j θ̇_j of the rods before. With them the number of operations is proportional to n,
    // for cos(θ_i - θ_j) = cos θ_i cos θ_j + sin θ_i sin θ_j.
    Expression cosines = 0.0;
    Expression sines = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto beyond = static_cast<double>(n - 1 - i);  // rods that hang on rod i
      const Expression own = m * l * l * (beyond + 0.25) + m * l * l / 12.0;
      const Expression cosine = cos(x.q[i]) * x.v[i];
      const Expression sine = sin(x.q[i]) * x.v[i];
      kinetic += 0.5 * own * x.v[i] * x.v[i];
      kinetic += m * l * l * (beyond + 0.5) * (cosine * cosines + sine * sines);
      cosines += cosine;
      sines += sine;
      height += l * (beyond + 0.5) * sin(x.q[i]);
    }
    return kinetic - m * varying("gravity") * height;
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    ExpressionVector f = x.u;
    for (Eigen::Index i = 0; i + 1 < links(); ++i) f[i] = x.u[i] - x.u[i + 1];
    return f;
  }

  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }

  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Constant(links(), -std::numbers::pi / 2.0));
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Constant(links(), std::numbers::pi / 2.0));
  }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }

  /// Rotations of the whole chain: ξ = (1 .. 1). Gravity breaks the symmetry, so its torque counts among the forces.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector::Constant(links(), Expression(1.0));
  }

  /// The chain folds while it rises: the last rod is ahead, the one before it behind, and so on down to the first.
  [[nodiscard]] MotionPoint guess(double t) const override {
    MotionPoint point = Problem::guess(t);
    const double rate = std::numbers::pi / horizon();
    double fold = largest_fold;
    for (Eigen::Index i = links() - 1; i > 0; --i) {
      point.q[i] += fold * std::sin(rate * t);
      point.v[i] += fold * rate * std::cos(rate * t);
      fold = -fold;
    }
    return point;
  }

 private:
  [[nodiscard]] std::optional<ReferenceOptimum> reference_optimum() const {
    if (!has_default_parameters({"links"})) return std::nullopt;
    ReferenceOptimum known{.objective = 0.0, .digits = 13, .certificate = by_indirect_method(13)};
    if (links() == 1) {
      known.objective = 10.2534144826;
      known.digits = 12;
    } else if (links() == 2) {
      known.objective = 80.37902916907;
      known.remark = "the minimum of two_link_manipulator; other minima near 89.56, 167, 171, 192, 205";
    } else if (links() == 3) {
      known.objective = 134.8718555982;
      known.remark =
          "the cheapest minimum found from 66 perturbed starts; other minima near 159.9, 162.8, 177.2, 179.4, 188.9, "
          "207.3, 227.2, 240.5 and above";
    } else {
      return std::nullopt;
    }
    return known;
  }

  static constexpr double largest_fold = 2.5;  // rad

  [[nodiscard]] Eigen::Index links() const { return static_cast<Eigen::Index>(parameter("links")); }
  [[nodiscard]] std::vector<std::string> numbered(const std::string& stem) const {
    std::vector<std::string> names;
    for (Eigen::Index i = 1; i <= links(); ++i) names.push_back(stem + std::to_string(i));
    return names;
  }
};

}  // namespace dmocbench
