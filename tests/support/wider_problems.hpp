#pragma once

#include <algorithm>
#include <memory>

#include "methods/mechanics/problem.hpp"

namespace dmocbench::tests {

/// A particle of unknown mass m, moved from 0 to 2 in the time 1 with the velocity 1 at both ends: L = ½mv², f = u,
/// C = ½u², Φ = (m - 3)². For a given m, q = t + 3t² - 2t³ and J = 6m² + (m - 3)²; hence m = 3/7 and J = 54/7.
class UnknownMass final : public Problem {
 public:
  explicit UnknownMass(double least = 0.1, double most = 10.0)
      : Problem({{"mass", std::clamp(1.0, least, most), "kg", "of the particle", least, most, false, true}}) {}
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"q"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * varying("mass") * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }
  [[nodiscard]] Expression final_cost(const State&) const override {
    const Expression miss = varying("mass") - 3.0;
    return miss * miss;
  }
  [[nodiscard]] BoundaryState initial_state() const override { return at(0.0); }
  [[nodiscard]] BoundaryState final_state() const override { return at(2.0); }
  [[nodiscard]] double horizon() const override { return 1.0; }
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector&) const override {
    return ExpressionVector::Constant(1, 1.0);
  }

 private:
  static BoundaryState at(double q) { return {.q = Eigen::VectorXd::Constant(1, q), .v = Eigen::VectorXd::Ones(1)}; }
};

/// L = ½v², f = u_1 - u_2, C = ½|u|², from 0 to 1 at rest in T = 1. With u_1 + 3 u_2 = 0, f = -4 u_2 and C = 5/16 f²:
/// J = 5/8 · 6.
class TwoForces final : public Problem {
 public:
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"q"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"push", "pull"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector::Constant(1, x.u[0] - x.u[1]);
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return ExpressionVector::Constant(1, x.u[0] + 3.0 * x.u[1]);
  }
  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Zero(1));
  }
  [[nodiscard]] BoundaryState final_state() const override { return BoundaryState::at_rest(Eigen::VectorXd::Ones(1)); }
  [[nodiscard]] double horizon() const override { return 1.0; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.path = Bounds::all(1, 0.0, 0.0);
    return bounds;
  }
};

}  // namespace dmocbench::tests
