#pragma once

#include <numbers>

#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// Problems of the library as they had to be stated without first-order states, unknown parameters and integral
/// constraints: a state is the velocity of an ignorable coordinate, a parameter a coordinate at rest.

/// `control_rate`: the force is the velocity of `impulse`.
class SubstitutedControlRate final : public SmallProblem {
 public:
  SubstitutedControlRate()
      : SmallProblem("substituted_control_rate", BoundaryState::at_rest(Eigen::Vector2d::Zero()),
                     BoundaryState::at_rest(Eigen::Vector2d::UnitX()), 2.0, 1) {}
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.v[1], x.u[0]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.v[1] * x.v[1]; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_configuration(1).free_velocity(1);
    bounds.u = Bounds::all(1, -4.0, 4.0);
    return bounds;
  }
};

/// `hanging_chain`: height and length are velocities, the slope is the control.
class SubstitutedHangingChain final : public SmallProblem {
 public:
  SubstitutedHangingChain()
      : SmallProblem("substituted_hanging_chain", {Eigen::Vector2d::Zero(), Eigen::Vector2d(1.0, 0.0)},
                     {Eigen::Vector2d(2.0, 2.0), Eigen::Vector2d(3.0, 4.0)}, 1.0, 1) {}
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0], sqrt(1.0 + x.u[0] * x.u[0])}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return x.v[0] * sqrt(1.0 + x.u[0] * x.u[0]);
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_configuration(0).free_configuration(1);
    return bounds;
  }
  [[nodiscard]] MotionPoint guess(double t) const override {
    return {.q = Eigen::Vector2d(8.0 * (t * t * t / 6.0 - t * t / 8.0) + t, 2.0 * t * t),
            .v = Eigen::Vector2d(8.0 * t * (0.5 * t - 0.25) + 1.0, 4.0 * t),
            .u = Eigen::VectorXd::Constant(1, 8.0 * (t - 0.25))};
  }
};

/// `cannonball`: the radius is a coordinate at rest, in units of 0.1 m. Its cost is in units of 1000 m.
class SubstitutedCannonball final : public Problem {
 public:
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "h", "radius"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v.dot(x.v) - 0.980665 * x.q[1]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression& r = x.q[2];
    const Expression speed = sqrt(x.v[0] * x.v[0] + x.v[1] * x.v[1]);
    const Expression k = 0.5 * 1.225 * exp(-x.q[1] / 8.44) * 0.5 * std::numbers::pi * 1e-2 * r * r / mass(r) * 1000.0;
    return ExpressionVector{{-k * speed * x.v[0], -k * speed * x.v[1], 0.0}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState&) const override { return 0.0; }
  [[nodiscard]] Expression final_cost(const State& last) const override { return -last.q[0]; }
  [[nodiscard]] BoundaryState initial_state() const override {
    return {.q = Eigen::Vector3d(0.0, 0.0, 0.5), .v = Eigen::Vector3d(3.0, 3.0, 0.0)};
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return {.q = Eigen::Vector3d(3.0, 0.0, 0.5), .v = Eigen::Vector3d(1.0, -1.5, 0.0)};
  }
  [[nodiscard]] ExpressionVector boundary_conditions(const State& first, const State&) const override {
    const Expression square = (first.v[0] * first.v[0] + first.v[1] * first.v[1]) * 1e4;
    return ExpressionVector{{0.5 * mass(first.q[2]) * square / 4e5 - 1.0}};
  }
  [[nodiscard]] double horizon() const override { return 2.5; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.first.free_velocity(0).free_velocity(1);
    bounds.first.q.lower[2] = 0.1;
    bounds.first.q.upper[2] = 1.0;
    for (Eigen::Index i = 0; i < 3; ++i) bounds.last.free_velocity(i);
    bounds.last.free_configuration(0).free_configuration(2);
    bounds.horizon = {0.5, 10.0};
    return bounds;
  }
  [[nodiscard]] MotionPoint guess(double t) const override {
    MotionPoint point = Problem::guess(t);
    point.q[1] = 3.0 * t - 3.0 / 2.5 * t * t;
    point.v[1] = 3.0 - 6.0 / 2.5 * t;
    return point;
  }

 private:
  static Expression mass(const Expression& r) {  // kg
    return 7870.0 * 4.0 / 3.0 * std::numbers::pi * 1e-3 * r * r * r;
  }
};

/// The ducted fan of OptimalControlProblems.jl, J = (1/T) ∫ 2u₁² + u₂² dt + 1000 T, after Graichen and Petit. The
/// integral is a first-order state, or the velocity of a fourth coordinate.
class DuctedFan final : public Problem {
 public:
  explicit DuctedFan(bool is_substituted) : is_substituted_(is_substituted) {}
  [[nodiscard]] std::vector<std::string> configuration_names() const override {
    std::vector<std::string> names{"x", "y", "alpha"};
    if (is_substituted_) names.emplace_back("z");
    return names;
  }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u1", "u2"}; }
  [[nodiscard]] std::vector<std::string> first_order_names() const override {
    return is_substituted_ ? std::vector<std::string>() : std::vector<std::string>{"effort"};
  }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    return is_substituted_ ? ExpressionVector() : ExpressionVector::Constant(1, effort(x));
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression fan =
        0.5 * 2.2 * (x.v[0] * x.v[0] + x.v[1] * x.v[1]) + 0.5 * 0.05 * x.v[2] * x.v[2] - 4.0 * x.q[1];
    return is_substituted_ ? fan + 0.5 * x.v[3] * x.v[3] : fan;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression c = cos(x.q[2]);
    const Expression s = sin(x.q[2]);
    ExpressionVector f(size());
    f.head(3) << x.u[0] * c - x.u[1] * s, x.u[0] * s + x.u[1] * c, 0.2 * x.u[0];
    if (is_substituted_) f[3] = effort(x);
    return f;
  }
  [[nodiscard]] Expression running_cost(const ControlledState&) const override { return 0.0; }
  [[nodiscard]] Expression final_cost(const State& last) const override {
    return (is_substituted_ ? last.v[3] : last.y[0]) / last.t + 1000.0 * last.t;
  }
  [[nodiscard]] BoundaryState initial_state() const override { return at(0.0); }
  [[nodiscard]] BoundaryState final_state() const override { return at(1.0); }
  [[nodiscard]] double horizon() const override { return 2.0; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    if (is_substituted_) bounds.last.free_configuration(3).free_velocity(3);
    if (!is_substituted_) bounds.last.free_first_order(0);
    bounds.horizon = {0.1, 20.0};
    bounds.q = Bounds::none(size());
    bounds.q.lower[2] = -std::numbers::pi / 6.0;
    bounds.q.upper[2] = std::numbers::pi / 6.0;
    bounds.u = {Eigen::Vector2d(-5.0, 0.0), Eigen::Vector2d(5.0, 17.0)};
    return bounds;
  }
  [[nodiscard]] MotionPoint guess(double t) const override {
    MotionPoint point = Problem::guess(t);
    point.u = Eigen::Vector2d(0.0, 4.0);
    return point;
  }

 private:
  [[nodiscard]] Eigen::Index size() const { return is_substituted_ ? 4 : 3; }
  static Expression effort(const ControlledState& x) { return 2.0 * x.u[0] * x.u[0] + x.u[1] * x.u[1]; }
  [[nodiscard]] BoundaryState at(double x) const {
    BoundaryState state = BoundaryState::at_rest(Eigen::VectorXd::Zero(size()));
    state.q[0] = x;
    if (!is_substituted_) state.y = Eigen::VectorXd::Zero(1);
    return state;
  }

  bool is_substituted_;
};

}  // namespace dmocbench::tests
