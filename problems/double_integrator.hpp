#pragma once

#include <cmath>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// A unit mass is pushed from rest to rest: the smallest optimal control problem of mechanics, with a closed form.
///
/// L = ½q̇², f = u, C = ½u², from (0, 0) to (d, 0) in the time T. Optimal: q = d(3τ² - 2τ³) with τ = t/T,
/// u = 6d/T²(1 - 2τ), J = 6d²/T³.
///
/// A force of at most U < 6d/T² is a bound that is active: u = U until ½ - σ, -U from ½ + σ on and between them a line,
/// with σ² = ¾ - 3d/(T²U), and J = TU²(½ - ⅔σ). Below 4d/T² no motion is left.
class DoubleIntegrator : public Problem {
 public:
  DoubleIntegrator()
      : Problem({
            {"distance", 1.0, "m", "distance d to travel", 1e-3, 1e3},
            horizon_parameter(1.0, "motion"),
            {"largest_force", 1e9, "N", "bound U on the force; a value above 6 d / T^2 means no bound", 1e-3, 1e9},
        }) {}

  [[nodiscard]] std::string name() const override { return "double_integrator"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "transfer of a unit mass from rest to rest in fixed time, with least control effort",
            .title = "Double integrator",
            .axis_units = {.state = "m", .control = "N", .momentum = "N s", .cost = "N² s", .energy = "N m"},
            .source = "folklore; PSOPT, example mineng_di",
            .configuration_units = {"m"},
            .control_units = {"N"},
            .reference = reference_optimum(),
            .picture = [](const ControlledState& x) -> Picture {
              return {{"position", "m", x.q[0]}, {"velocity", "m/s", x.v[0]}, {"force", "N", x.u[0]}};
            }};
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
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    if (is_bounded()) bounds.u = Bounds::all(1, -parameter("largest_force"), parameter("largest_force"));
    return bounds;
  }

  [[nodiscard]] std::optional<OptimalPoint> optimum(double t) const override {
    if (!(half_ramp() > 0.0)) return std::nullopt;
    const double duration = parameter("horizon");
    const double peak = is_bounded() ? parameter("largest_force") : free_peak();
    const double s = 0.5 - t / duration;  // antisymmetric about 0
    const double sigma = half_ramp();
    const double slope = peak / sigma;
    // After the ramp, q and v of the constant force that ends at rest; on it the integrals of slope·s.
    const double magnitude = std::abs(s);
    const bool is_on_ramp = magnitude <= sigma;
    const double rest = 0.5 - magnitude;
    const double v = is_on_ramp ? peak * (0.5 - sigma) + 0.5 * slope * (sigma * sigma - s * s) : peak * rest;
    // By symmetry q of the second half is d less q of the first half at the mirrored time.
    const double before_ramp = 0.5 - sigma;
    const double along = sigma - magnitude;
    const double gone =
        is_on_ramp ? 0.5 * peak * before_ramp * before_ramp + peak * before_ramp * along +
                         0.5 * slope *
                             (sigma * sigma * along - (sigma * sigma * sigma - magnitude * magnitude * magnitude) / 3.0)
                   : 0.5 * peak * rest * rest;
    const double travelled = duration * duration * gone;
    return OptimalPoint::of_numbers(s >= 0.0 ? travelled : parameter("distance") - travelled, duration * v,
                                    is_on_ramp ? slope * s : std::copysign(peak, s), -slope / duration, -slope * s);
  }

  /// Translations; without a potential the momentum changes by the work of the control alone.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return ExpressionVector::Constant(1, 1.0);
  }

 private:
  /// 6d/T², the largest force where none is too large.
  [[nodiscard]] double free_peak() const {
    return 6.0 * parameter("distance") / (parameter("horizon") * parameter("horizon"));
  }
  [[nodiscard]] bool is_bounded() const { return parameter("largest_force") < free_peak(); }
  /// σ, half the duration of the ramp over T; not a number where the force is too small.
  [[nodiscard]] double half_ramp() const {
    return is_bounded() ? std::sqrt(0.75 - 0.5 * free_peak() / parameter("largest_force")) : 0.5;
  }
  [[nodiscard]] std::optional<ReferenceOptimum> reference_optimum() const {
    constexpr int double_precision = 16;
    const double d = parameter("distance");
    const double duration = parameter("horizon");
    if (is_bounded()) {
      if (!(half_ramp() > 0.0)) return std::nullopt;
      const double force = parameter("largest_force");
      return ReferenceOptimum{.objective = duration * force * force * (0.5 - 2.0 / 3.0 * half_ramp()),
                              .digits = double_precision,
                              .certificate = "closed form, T U^2 (1/2 - 2/3 sigma)"};
    }
    ReferenceOptimum optimum{.objective = 6.0 * d * d / (duration * duration * duration),
                             .digits = double_precision,
                             .certificate = "closed form, 6 d^2 / T^3"};
    if (has_default_parameters()) optimum.published = {{6.000000, "PSOPT, example mineng_di"}};
    return optimum;
  }
};

}  // namespace dmocbench
