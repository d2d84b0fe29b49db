#pragma once

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// A unit mass is pushed from rest to rest: the smallest optimal control problem of mechanics, with a closed form.
///
/// L = ½q̇², f = u, C = ½u², from (0, 0) to (d, 0) in the time T. Optimal: q = d(3τ² - 2τ³) with τ = t/T,
/// u = 6d/T²(1 - 2τ), J = 6d²/T³.
class DoubleIntegrator final : public Problem {
 public:
  DoubleIntegrator()
      : Problem({
            {"distance", 1.0, "m", "distance d to travel", 1e-3, 1e3},
            horizon_parameter(1.0, "motion"),
        }) {}

  [[nodiscard]] std::string name() const override { return "double_integrator"; }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "a unit mass from rest to rest in fixed time, least control effort",
            .source = "folklore; mineng_di of the PSOPT examples",
            .reference = reference_optimum()};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"q"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }

  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Zero(1));
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Constant(1, parameter("distance")));
  }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }

  /// Translations; without a potential the momentum changes by the work of the control alone.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector::Constant(1, 1.0);
  }

  [[nodiscard]] std::vector<PictureQuantity> picture(const ControlledState& x) const override {
    return {{"position", "m", x.q[0]}, {"velocity", "m/s", x.v[0]}, {"force", "N", x.u[0]}};
  }

 private:
  [[nodiscard]] std::optional<ReferenceOptimum> reference_optimum() const {
    constexpr int double_precision = 16;
    const double d = parameter("distance");
    const double duration = parameter("horizon");
    ReferenceOptimum optimum{.objective = 6.0 * d * d / (duration * duration * duration),
                             .digits = double_precision,
                             .certificate = "closed form, 6 d^2 / T^3"};
    if (has_default_parameters()) optimum.published.push_back({6.000000, "PSOPT, example mineng_di"});
    return optimum;
  }
};

}  // namespace dmocbench
