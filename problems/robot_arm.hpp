#pragma once

#include <numbers>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// The robot arm of COPS: a rod of length ℓ that slides through its pivot and turns about it, in the shortest time.
///
/// q = (ρ, θ, φ): the length of the rod on one side of the pivot and its two angles; with the inertias
/// I_φ = ((ℓ - ρ)³ + ρ³)/3 and I_θ = I_φ sin²φ, L = ½(ℓρ̇² + I_θθ̇² + I_φφ̇²). COPS prescribes
/// ℓρ̈ = u_ρ, I_θθ̈ = u_θ, I_φφ̈ = u_φ, which are not the Euler-Lagrange equations of any such inertia: the terms with
/// İ and ∂I/∂q are missing. So f contains them with the opposite sign,
///   f = u + (-½(∂I_θ/∂ρ θ̇² + ∂I_φ/∂ρ φ̇²), İ_θθ̇, İ_φφ̇ - ½ ∂I_θ/∂φ θ̇²);
/// with `euler_lagrange` = 1, f = u, which is the true arm. Φ = T, |u_i| <= 1, 0 <= ρ <= ℓ, |θ| <= π, 0 <= φ <= π; from
/// (4.5, 0, π/4) to (4.5, 2π/3, π/4), at rest. ℓ = 5.
class RobotArm : public Problem {
 public:
  RobotArm()
      : Problem({
            {"length", 5.0, "", "length of the rod", 4.5, 1e2},
            switch_parameter("euler_lagrange", false,
                             "0: the equations of COPS; 1: the Euler-Lagrange equations of its inertias"),
        }) {}

  [[nodiscard]] std::string name() const override { return "robot_arm"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {
        .description = "robot arm that slides and turns from rest to rest in the shortest time",
        .title = "Robot arm",
        .axis_units = {.cost = "s"},
        .source = "Dolan, More, Munson: Benchmarking optimization software with COPS 3.0, ANL/MCS-TM-273, problem 8",
        .guess = "q on the straight line from q(0) to q(T) with slope v, u = 0, T = 10",
        .reference = reference_optimum(),
        .picture = [](const ControlledState& x) -> Picture {
          const Expression across = x.q[0] * sin(x.q[2]);
          return {{"tip_x", "", across * cos(x.q[1])},
                  {"tip_y", "", across * sin(x.q[1])},
                  {"tip_z", "", x.q[0] * cos(x.q[2])},
                  {"u_rho", "", x.u[0]},
                  {"u_theta", "", x.u[1]},
                  {"u_phi", "", x.u[2]}};
        }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"rho", "theta", "phi"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_rho", "u_theta", "u_phi"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression sine = sin(x.q[2]);
    const Expression inertia = inertia_of(x.q[0]);
    return 0.5 * varying("length") * x.v[0] * x.v[0] + 0.5 * inertia * sine * sine * x.v[1] * x.v[1] +
           0.5 * inertia * x.v[2] * x.v[2];
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    if (parameter("euler_lagrange") == 1.0) return x.u;
    const Expression length = varying("length");
    const Expression& rho = x.q[0];
    const Expression sine = sin(x.q[2]);
    const Expression inertia = inertia_of(rho);
    const Expression inertia_by_rho = rho * rho - (length - rho) * (length - rho);
    const Expression inertia_rate = inertia_by_rho * x.v[0];
    const Expression sine_square_by_phi = 2.0 * sine * cos(x.q[2]);
    ExpressionVector f = x.u;
    f[0] -= 0.5 * inertia_by_rho * (sine * sine * x.v[1] * x.v[1] + x.v[2] * x.v[2]);
    f[1] += (inertia_rate * sine * sine + inertia * sine_square_by_phi * x.v[2]) * x.v[1];
    f[2] += inertia_rate * x.v[2] - 0.5 * inertia * sine_square_by_phi * x.v[1] * x.v[1];
    return f;
  }

  [[nodiscard]] Expression running_cost(const ControlledState& /*x*/) const override { return 0.0; }
  [[nodiscard]] Expression final_cost(const State& last) const override { return last.t; }

  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::Vector3d(4.5, 0.0, std::numbers::pi / 4.0));
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::Vector3d(4.5, 2.0 * std::numbers::pi / 3.0, std::numbers::pi / 4.0));
  }
  [[nodiscard]] double horizon() const override { return 10.0; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    using std::numbers::pi;
    bounds.horizon = {0.1, 100.0};
    bounds.q = {Eigen::Vector3d(0.0, -pi, 0.0), Eigen::Vector3d(parameter("length"), pi, pi)};
    bounds.u = Bounds::all(3, -1.0, 1.0);
    return bounds;
  }

  /// The optimum is about 9.
  [[nodiscard]] double cost_scale() const override { return 0.1; }

  /// Rotations about the vertical: ξ = (0, 1, 0).
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector{{0.0, 1.0, 0.0}};
  }

 private:
  [[nodiscard]] std::optional<ReferenceOptimum> reference_optimum() const {
    if (!has_default_parameters({"euler_lagrange"})) return std::nullopt;
    if (parameter("euler_lagrange") == 1.0) {
      return ReferenceOptimum{.objective = 7.84473,
                              .digits = 6,
                              .certificate =
                                  "DMOC and tangent-space collocation with 2 Gauss stages on 512 intervals, both "
                                  "replayed, and the limits of both with the midpoint rule agree; no more digits are "
                                  "certain, because u_theta is singular in the middle of the trajectory",
                              .remark = "the published values belong to the equations without Coriolis terms"};
    }
    return ReferenceOptimum{
        .objective = 9.1409117459,
        .digits = 11,
        .certificate =
            "switching times: all controls are bang-bang and the trajectory is symmetric in time, so that u_rho "
            "switches at T/4 and 3T/4, u_theta at T/2, and u_phi at 0.3058824 T and its mirror image. Newton's method "
            "on the integrated half of the trajectory yields this time and T. Gauss with 3 stages on a grid with nodes "
            "at these times has the same T to 11 digits",
        .published = {{9.14138, "COPS 3.0, trapezoidal rule, N = 200"}},
        .remark =
            "COPS prints the value of its grid, which lacks the switching times: with the trapezoidal rule, T is "
            "9.14140 on 200 intervals and 9.14103 on 400 here. With several stages on 1024 intervals, use the "
            "tolerance 1e-10: at 1e-8 the barrier does not determine the controls near their switches, T is 2e-4 too "
            "large, and the solution is not confirmed"};
  }

  /// I_φ(ρ).
  [[nodiscard]] Expression inertia_of(const Expression& rho) const {
    const Expression other = varying("length") - rho;
    return (other * other * other + rho * rho * rho) / 3.0;
  }
};

}  // namespace dmocbench
