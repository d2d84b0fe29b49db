#pragma once

#include <numbers>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A harmonic oscillator driven from rest to rest: the problem with a constant L_vv, where all three methods coincide
/// if the tableau is its own conjugate (section 3.3 of the paper), and with an optimum in closed form.
///
/// L = ½q̇² - ½q², f = u, C = ½u², hence q̈ = -q + u, from (0, 0) to (1, 0) in T = π; nondimensional. The response to u
/// is x(π) = ∫ (sin(π - t), cos(π - t)) u dt with the Gramian diag(π/2, π/2), so that
///   u = (2/π) sin t,   q = (sin t - t cos t)/π,   J = 1/π.
/// Source: the minimum energy control of a linear system, any textbook on linear systems; made for this suite.
class ForcedOscillator : public Problem {
 public:
  [[nodiscard]] std::string name() const override { return "forced_oscillator"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "harmonic oscillator from rest to rest with least effort; constant mass, optimum 1/pi",
            .title = "Forced oscillator",
            .axis_units = AxisUnits::pure_numbers(),
            .source = "minimum energy control of a linear system, closed form; not in the paper",
            .time_unit = {.name = "", .factor = 1.0},
            .reference =
                ReferenceOptimum{.objective = std::numbers::inv_pi, .digits = 16, .certificate = "closed form: 1/pi"}};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"q"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * (x.v[0] * x.v[0] - x.q[0] * x.q[0]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }

  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Zero(1));
  }
  [[nodiscard]] BoundaryState final_state() const override { return BoundaryState::at_rest(Eigen::VectorXd::Ones(1)); }
  [[nodiscard]] double horizon() const override { return std::numbers::pi; }

  /// Translations, ξ = 1, under which the kinetic energy is invariant; the spring's force counts as one of the forces.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector::Constant(1, Expression(1.0));
  }
};

}  // namespace dmocbench
