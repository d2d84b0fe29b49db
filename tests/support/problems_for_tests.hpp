#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "methods/mechanics/forwarding_problem.hpp"
#include "problems/registry.hpp"

namespace dmocbench::tests {

/// What a small problem states unless it says otherwise: names by number, unit masses, controls that are the forces and
/// cost half their square.
class SmallProblem : public Problem {
 public:
  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return numbered("q", first_.q.size()); }
  [[nodiscard]] std::vector<std::string> control_names() const override { return numbered("u", controls_); }
  [[nodiscard]] BoundaryState initial_state() const override { return first_; }
  [[nodiscard]] BoundaryState final_state() const override { return last_; }
  [[nodiscard]] double horizon() const override { return horizon_; }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v.dot(x.v); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }

 protected:
  SmallProblem(std::string name, BoundaryState first, BoundaryState last, double horizon, Eigen::Index controls,
               std::vector<Parameter> parameters = {})
      : Problem(std::move(parameters)),
        name_(std::move(name)),
        first_(std::move(first)),
        last_(std::move(last)),
        horizon_(horizon),
        controls_(controls) {}

  static BoundaryState at(double q, double v) {
    return {Eigen::VectorXd::Constant(1, q), Eigen::VectorXd::Constant(1, v)};
  }
  static BoundaryState at(double q, double v, double y) {
    BoundaryState state = at(q, v);
    state.y = Eigen::VectorXd::Constant(1, y);
    return state;
  }
  static ExpressionVector one(const Expression& entry) { return ExpressionVector::Constant(1, entry); }

 private:
  static std::vector<std::string> numbered(const std::string& letter, Eigen::Index count) {
    std::vector<std::string> names;
    for (Eigen::Index i = 1; i <= count; ++i) names.push_back(letter + std::to_string(i));
    return names;
  }

  std::string name_;
  BoundaryState first_;
  BoundaryState last_;
  double horizon_;
  Eigen::Index controls_;
};

/// L = ½v², f = u, C = ½u², from 0 to 1 at rest in T = 1. Optimum: u = 6 - 12t, q = 3t² - 2t³, J = 6.
class DoubleIntegrator final : public SmallProblem {
 public:
  DoubleIntegrator() : SmallProblem("double_integrator", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1) {}
  /// Translations.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector&) const override { return one(1.0); }
};

/// L = ½v² - ½ω²q², f = u, C = ½u²; the ends are those of the free motion q = cos ωt, so u = 0 is the optimum.
class HarmonicOscillator final : public SmallProblem {
 public:
  static constexpr double omega = 2.0;
  explicit HarmonicOscillator(double horizon = 1.0)
      : SmallProblem("harmonic_oscillator", at(1.0, 0.0),
                     at(std::cos(omega * horizon), -omega * std::sin(omega * horizon)), horizon, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v[0] * x.v[0] - 0.5 * omega * omega * x.q[0] * x.q[0];
  }
};

/// L = ½v² + cos q, f = u, C = ½u², from hanging to upright at rest. L_vv is constant, L_q is not linear.
class Pendulum final : public SmallProblem {
 public:
  Pendulum() : SmallProblem("pendulum", at(0.0, 0.0), at(std::numbers::pi, 0.0), 2.0, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0] + cos(x.q[0]); }
};

/// A free relativistic particle in a spring, L = -sqrt(1 - v²) - ½q²: not quadratic in v, p = v/sqrt(1 - v²).
class RelativisticSpring final : public SmallProblem {
 public:
  RelativisticSpring() : SmallProblem("relativistic_spring", at(0.0, 0.3), at(0.5, 0.1), 1.0, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return -sqrt(1.0 - x.v[0] * x.v[0]) - 0.5 * x.q[0] * x.q[0];
  }
};

/// Everything that the paper's two problems lack: L depends on t, L_vv and L_vq on q and t, terms linear in v, damping,
/// a force and a cost that depend on q, v, u and t.
class MovingFrame final : public SmallProblem {
 public:
  MovingFrame()
      : SmallProblem("moving_frame", {Eigen::Vector2d(0.1, -0.2), Eigen::Vector2d(0.4, 0.3)},
                     {Eigen::Vector2d(0.7, 0.4), Eigen::Vector2d(0.2, -0.1)}, 1.5, 2) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression& a = x.q[0];
    const Expression& b = x.q[1];
    const Expression& va = x.v[0];
    const Expression& vb = x.v[1];
    const Expression kinetic =
        0.5 * (2.0 + cos(b)) * va * va + 0.5 * (1.0 + 0.1 * x.t * x.t) * vb * vb + 0.3 * sin(a + x.t) * va * vb;
    const Expression gyroscopic = x.t * a * b * vb + b * b * va;
    return kinetic + gyroscopic - (a * a * b + sin(b) * x.t);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    ExpressionVector f(2);
    f << x.u[0] - 0.2 * x.v[0], x.q[0] * x.u[0] + x.u[1] + 0.1 * x.v[0] * x.v[1] + 0.3 * x.t;
    return f;
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * (x.u[0] * x.u[0] + x.u[1] * x.u[1]) + 0.1 * x.q[0] * x.q[0] + 0.05 * x.v[1] * x.v[1] * x.t +
           0.1 * x.u[0] * x.v[0];
  }
};

/// A particle in the plane, L = ½|v|² + 1/|q|, f = u, in Cartesian coordinates: rotations are linear, not constant,
/// ξ = (-q₂, q₁), and Dξ is not zero.
class CentralForce : public SmallProblem {
 public:
  CentralForce()
      : SmallProblem("central_force", {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, 1.0)},
                     {Eigen::Vector2d(-1.2, 0.3), Eigen::Vector2d(-0.2, -0.8)}, 3.0, 2) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * (x.v[0] * x.v[0] + x.v[1] * x.v[1]) + 1.0 / sqrt(x.q[0] * x.q[0] + x.q[1] * x.q[1]);
  }
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    ExpressionVector generator(2);
    generator << -q[1], q[0];
    return generator;
  }
  /// Half a turn on the unit circle: the straight line would pass near the centre.
  [[nodiscard]] MotionPoint guess(double t) const override {
    return {.q = Eigen::Vector2d(std::cos(t), std::sin(t)),
            .v = Eigen::Vector2d(-std::sin(t), std::cos(t)),
            .u = Eigen::Vector2d::Zero()};
  }
};

/// q̈ = q̇² + u from q̇ = v: without a control the velocity v/(1 - vt) leaves every bound at t = 1/v.
class BlowUp final : public SmallProblem {
 public:
  explicit BlowUp(double v) : SmallProblem("blow_up", at(0.0, v), at(1.0, 0.0), 1.0, 1) {}
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return one(x.v[0] * x.v[0] + x.u[0]);
  }
};

/// Another problem with its ends replaced, and nothing else bounded.
class WithEnds : public ForwardingProblem {
 public:
  WithEnds(const Problem& base, BoundaryState first, BoundaryState last)
      : ForwardingProblem(base), first_(std::move(first)), last_(std::move(last)) {}
  [[nodiscard]] BoundaryState initial_state() const override { return first_; }
  [[nodiscard]] BoundaryState final_state() const override { return last_; }
  [[nodiscard]] ProblemBounds bounds() const override { return Problem::bounds(); }
  [[nodiscard]] MotionPoint guess(double t) const override { return Problem::guess(t); }

 private:
  BoundaryState first_;
  BoundaryState last_;
};

/// The paper's two problems, and two that have what these lack: L that depends on t, L that is not quadratic in v.
inline std::vector<std::unique_ptr<Problem>> problems() {
  std::vector<std::unique_ptr<Problem>> all;
  for (const std::string& name : paper_problem_names()) all.push_back(make_problem(name));
  all.push_back(std::make_unique<MovingFrame>());
  all.push_back(std::make_unique<RelativisticSpring>());
  return all;
}

/// A registered problem or one of those two.
inline std::unique_ptr<Problem> problem_named(const std::string& name) {
  if (name == "moving_frame") return std::make_unique<MovingFrame>();
  if (name == "relativistic_spring") return std::make_unique<RelativisticSpring>();
  return make_problem(name);
}

/// L_vv = [1 1; 1 1] has no empty row, but no inverse either.
class SingularMass final : public SmallProblem {
 public:
  SingularMass()
      : SmallProblem("singular_mass", {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()},
                     {Eigen::Vector2d::Ones(), Eigen::Vector2d::Zero()}, 1.0, 2) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression sum = x.v[0] + x.v[1];
    return 0.5 * sum * sum;
  }
};

}  // namespace dmocbench::tests
