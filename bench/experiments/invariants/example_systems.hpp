#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "methods/error.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A controlled mechanical system, the state from which it is simulated, and optionally the state to which it is
/// steered at the least C = u². Without a final state only L and f of the `Problem` are used.
class ExampleSystem : public Problem {
 public:
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return names_; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u[0] * x.u[0]; }
  [[nodiscard]] BoundaryState initial_state() const override { return start_; }
  [[nodiscard]] BoundaryState final_state() const override { return goal_; }
  [[nodiscard]] double horizon() const override { return horizon_; }

 protected:
  /// A system whose coordinates have these names, with the same state at both ends.
  ExampleSystem(std::string name, std::vector<std::string> names, const BoundaryState& start, double horizon)
      : ExampleSystem(std::move(name), std::move(names), start, start, horizon) {}
  /// The same with a state of its own at the end.
  ExampleSystem(std::string name, std::vector<std::string> names, BoundaryState start, BoundaryState goal,
                double horizon)
      : name_(std::move(name)),
        names_(std::move(names)),
        start_(std::move(start)),
        goal_(std::move(goal)),
        horizon_(horizon) {}

  /// The bounds of a task that leaves the second coordinate and its velocity open at the end: a force along the first
  /// one cannot choose the momentum of the second.
  [[nodiscard]] ProblemBounds with_second_free() const {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_configuration(1).free_velocity(1);
    return bounds;
  }

 private:
  std::string name_;
  std::vector<std::string> names_;
  BoundaryState start_;
  BoundaryState goal_;
  double horizon_;
};

/// A pendulum of unit mass and length, q = θ from below, L = ½θ̇² + cos θ, with a torque at its pivot.
class Pendulum final : public ExampleSystem {
 public:
  Pendulum()
      : ExampleSystem("pendulum", {"theta"}, {Eigen::VectorXd::Constant(1, 1.0), Eigen::VectorXd::Constant(1, 0.5)},
                      12.0) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0] + cos(x.q[0]); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
};

/// A state of the two-link manipulator in motion, away from every equilibrium.
[[nodiscard]] inline BoundaryState bent_links() { return {Eigen::Vector2d(-1.0, 0.5), Eigen::Vector2d(1.0, -0.5)}; }

/// A satellite on the orbit of (orb_trans), q = (r, φ), L = ½(ṙ² + r²φ̇²) + 1/r, whose thrust points away from the
/// centre: f = (u, 0) is orthogonal to the rotations ξ = (0, 1). Its task is the circular orbit of its own angular
/// momentum p_φ = 1.1, r = p_φ², after about a revolution and a half.
class RadialThrust final : public ExampleSystem {
 public:
  RadialThrust()
      : ExampleSystem("radial_thrust", {"r", "phi"}, {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.1, 1.1)},
                      {Eigen::Vector2d(1.21, 9.0), Eigen::Vector2d(0.0, 0.75)}, 12.0) {}
  [[nodiscard]] ProblemBounds bounds() const override { return with_second_free(); }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * (x.v[0] * x.v[0] + x.q[0] * x.q[0] * x.v[1] * x.v[1]) + 1.0 / x.q[0];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0], 0.0}};
  }
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{0.0, 1.0}};
  }
};

/// A spherical pendulum of unit mass and length, q = (θ, φ), θ measured from below,
/// L = ½(θ̇² + sin²θ φ̇²) + cos θ, with a torque along the meridian: f = (u, 0) is orthogonal to the rotations about
/// the vertical, ξ = (0, 1). Its task is θ = 0.6, θ̇ = 0.
class MeridianPendulum final : public ExampleSystem {
 public:
  MeridianPendulum()
      : ExampleSystem("spherical_pendulum", {"theta", "phi"}, {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.2, 1.3)},
                      {Eigen::Vector2d(0.6, 13.0), Eigen::Vector2d(0.0, 1.3)}, 10.0) {}
  [[nodiscard]] ProblemBounds bounds() const override { return with_second_free(); }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression sine = sin(x.q[0]);
    return 0.5 * (x.v[0] * x.v[0] + sine * sine * x.v[1] * x.v[1]) + cos(x.q[0]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0], 0.0}};
  }
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{0.0, 1.0}};
  }
};

/// The Kepler problem in Cartesian coordinates, L = ½|q̇|² + 1/|q|: L_vv is constant. From the pericentre of an ellipse
/// with semi-major axis 1, period 2π. The control is a thrust along q.
class Kepler : public ExampleSystem {
 public:
  static constexpr double period = 2.0 * std::numbers::pi;  ///< of the ellipse
  /// From the pericentre of an ellipse with this eccentricity, below 1.
  explicit Kepler(double eccentricity = 0.3)
      : ExampleSystem("kepler", {"x", "y"},
                      {Eigen::Vector2d(1.0 - eccentricity, 0.0),
                       Eigen::Vector2d(0.0, std::sqrt((1.0 + eccentricity) / (1.0 - eccentricity)))},
                      period) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * (x.v[0] * x.v[0] + x.v[1] * x.v[1]) + 1.0 / sqrt(x.q[0] * x.q[0] + x.q[1] * x.q[1]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u[0] * x.q; }
};

/// A system in space under a force f = u of any direction.
class SystemInSpace : public ExampleSystem {
 public:
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_x", "u_y", "u_z"}; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }

 protected:
  /// With coordinates x, y, z, over 20 units of time.
  explicit SystemInSpace(std::string name)
      : ExampleSystem(std::move(name), {"x", "y", "z"},
                      {Eigen::Vector3d(1.0, 0.2, -0.3), Eigen::Vector3d(0.1, 0.8, 0.4)}, 20.0) {}
};

/// A bob of unit mass on a spring of unit length, without weight: L = ½|q̇|² - 5(|q| - 1)².
class ElasticPendulum final : public SystemInSpace {
 public:
  ElasticPendulum() : SystemInSpace("elastic_pendulum") {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression stretch = sqrt(x.q.dot(x.q)) - 1.0;
    return 0.5 * x.v.dot(x.v) - 5.0 * stretch * stretch;
  }
};

/// A particle on the three-sphere in stereographic coordinates: L = 2|q̇|²/(1 + |q|²)². L_vv moves with q.
class ThreeSphere final : public SystemInSpace {
 public:
  ThreeSphere() : SystemInSpace("three_sphere") {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression scale = 1.0 + x.q.dot(x.q);
    return 2.0 * x.v.dot(x.v) / (scale * scale);
  }
};

/// A spherical pendulum without weight, q = (θ, φ), L = ½(θ̇² + sin²θ φ̇²), f = u.
class WeightlessPendulum final : public ExampleSystem {
 public:
  WeightlessPendulum()
      : ExampleSystem("weightless_pendulum", {"theta", "phi"}, {Eigen::Vector2d(1.2, 0.0), Eigen::Vector2d(0.2, 1.0)},
                      20.0) {}
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_theta", "u_phi"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression sine = sin(x.q[0]);
    return 0.5 * (x.v[0] * x.v[0] + sine * sine * x.v[1] * x.v[1]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
};

/// The generator of a problem's symmetry, n entries, which is the same everywhere. Throws `Error` if the problem has no
/// symmetry, or a generator that depends on q.
inline Eigen::VectorXd constant_generator(const Problem& problem) {
  const auto generator = problem.symmetry(input_vector(0, problem.configuration_size()));
  if (!generator) throw Error(problem.name() + " has no symmetry");
  return Eigen::VectorXd::NullaryExpr(generator->size(), [&](Eigen::Index i) {
    const std::optional<double> entry = (*generator)[i].constant_value();
    if (!entry) throw Error("the symmetry of " + problem.name() + " depends on q");
    return *entry;
  });
}

}  // namespace dmocbench
