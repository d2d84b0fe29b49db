#pragma once

#include <string>
#include <vector>

#include "problems/link_chain.hpp"
#include "problems/redundant_statement.hpp"

namespace dmocbench {

/// `link_chain` in maximal coordinates: q = (x_1, y_1, φ_1, ...), the centre and the orientation of every rod, joined
/// by two constraints each, p_i + ½l(cos φ_i, sin φ_i) being the end of rod i:
///   (x_i, y_i) - ½l(cos φ_i, sin φ_i) - end of rod i - 1 = 0,
///   L = Σ_i ½m(ẋ_i² + ẏ_i²) + ½Jφ̇_i² - mgy_i,
/// with the torque u_i - u_{i+1} on φ_i, C = ½|u|². L_vv is constant and diagonal.
class LinkChainMaximal final : public RedundantStatement<LinkChain> {
 public:
  [[nodiscard]] std::string name() const override { return "link_chain_maximal"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    const ProblemCard of_angles = minimal().card();
    return {.description = "swing-up of a planar chain of n rods, each a separate body held by joints",
            .title = "Chain of links (maximal coordinates)",
            .axis_units =
                {.state = "m or rad", .control = "N m", .momentum = "N s or N m s", .cost = "N² m² s", .energy = "N m"},
            .source = "link_chain in maximal coordinates with two constraints per joint",
            .guess = "as in link_chain",
            .reference = of_angles.reference,
            .picture = [this](const ControlledState& x) -> Picture {
              Picture quantities;
              const std::vector<std::string> names = configuration_names();
              for (Eigen::Index i = 0; i < links(); ++i) {
                for (Eigen::Index j = 3 * i; j < 3 * i + 2; ++j) {
                  quantities.push_back({"centre_" + names[static_cast<std::size_t>(j)], "m", x.q[j]});
                }
              }
              const std::vector<std::string> motors = control_names();
              for (Eigen::Index i = 0; i < links(); ++i) {
                quantities.push_back({motors[static_cast<std::size_t>(i)], "N m", x.u[i]});
              }
              return quantities;
            }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override {
    std::vector<std::string> names;
    for (Eigen::Index i = 1; i <= links(); ++i) {
      for (const char* stem : {"x_", "y_", "phi_"}) names.push_back(stem + std::to_string(i));
    }
    return names;
  }
  [[nodiscard]] std::vector<std::string> control_names() const override {
    std::vector<std::string> names;
    for (Eigen::Index i = 1; i <= links(); ++i) names.push_back("tau_" + std::to_string(i));
    return names;
  }

  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    const Expression half = 0.5 * varying("length");
    ExpressionVector g(2 * links());
    for (Eigen::Index i = 0; i < links(); ++i) {
      g[2 * i] = q[3 * i] - half * cos(q[3 * i + 2]);
      g[2 * i + 1] = q[3 * i + 1] - half * sin(q[3 * i + 2]);
      if (i == 0) continue;
      g[2 * i] -= q[3 * i - 3] + half * cos(q[3 * i - 1]);
      g[2 * i + 1] -= q[3 * i - 2] + half * sin(q[3 * i - 1]);
    }
    return g;
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression m = varying("mass");
    const Expression l = varying("length");
    Expression sum = 0.0;
    for (Eigen::Index i = 0; i < links(); ++i) {
      const auto rate = [&](Eigen::Index j) { return x.v[3 * i + j]; };
      sum += 0.5 * m * (rate(0) * rate(0) + rate(1) * rate(1)) + m * l * l / 24.0 * rate(2) * rate(2);
      sum -= m * varying("gravity") * x.q[3 * i + 1];
    }
    return sum;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    ExpressionVector f(3 * links());
    for (Eigen::Index i = 0; i < links(); ++i) {
      f[3 * i + 2] = x.u[i];
      if (i + 1 < links()) f[3 * i + 2] -= x.u[i + 1];
    }
    return f;
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }

  /// Rotations of the whole chain.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    ExpressionVector generator(q.size());
    for (Eigen::Index i = 0; i < q.size(); i += 3) generator.segment(i, 3) << -q[i + 1], q[i], 1.0;
    return generator;
  }

  [[nodiscard]] ExpressionVector embedding(const ExpressionVector& theta) const override {
    const Expression half = 0.5 * parameter("length");
    ExpressionVector q(3 * theta.size());
    Expression x = 0.0;  // the end of the rod before
    Expression y = 0.0;
    for (Eigen::Index i = 0; i < theta.size(); ++i) {
      q.segment(3 * i, 3) << x + half * cos(theta[i]), y + half * sin(theta[i]), theta[i];
      x += 2.0 * half * cos(theta[i]);
      y += 2.0 * half * sin(theta[i]);
    }
    return q;
  }

 private:
  [[nodiscard]] Eigen::Index links() const { return static_cast<Eigen::Index>(parameter("links")); }
};

}  // namespace dmocbench
