#pragma once

#include <limits>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A container crane carries its load to the ship with little swing, the crane of Sakawa and Shindo as Teo and Goh
/// state it.
///
/// q = (s, l, θ): the trolley, the length of the rope and the small angle of the swing;
///   s̈ = u₁ + 17.2656 θ,   l̈ = u₂,   l θ̈ + 2 l̇ θ̇ = -(u₁ + 27.0756 θ):
/// L = ½(ṡ² + l̇² + l²θ̇²), f = (u₁ + 17.2656 θ, u₂ - lθ̇², -l(u₁ + 27.0756 θ)). C = ½(θ² + θ̇² + ρ|u|²), T = 9 s, with
/// ρ = 0 as in Teo and Goh (then the control is singular, because the cost does not depend on it) or ρ = 0.01 as
/// Augustin and Maurer add. |u₁| <= 2.83374, -0.80865 <= u₂ <= 0.71265, |ṡ| <= 2.5, |l̇| <= 1; from (0, 22, 0), l̇ = -1,
/// to (10, 14, 0), ṡ = 2.5. Metres and seconds.
class ContainerCrane : public Problem {
 public:
  ContainerCrane()
      : Problem({
            {"control_weight", 0.0, "s^4/m^2",
             "weight ρ of |u|² in the cost; 0: Teo and Goh, 0.01: Augustin and Maurer", 0.0, 1.0},
        }) {}

  [[nodiscard]] std::string name() const override { return "container_crane"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {
        .description = "transfer with a container crane in fixed time, with least swing and bounded velocities",
        .title = "Container crane",
        .axis_units = {.state = "m or rad", .control = "m/s²"},
        .source =
            "Teo, Goh, Wong: A unified computational approach to optimal control problems (1991), after Sakawa, Shindo "
            "(1982); Augustin, Maurer: Sensitivity analysis and real-time control of a container crane (2001)",
        .reference = reference_optimum(),
        .picture = [](const ControlledState& x) -> Picture {
          return {{"trolley", "m", x.q[0]},
                  {"load_x", "m", x.q[0] + x.q[1] * sin(x.q[2])},
                  {"load_z", "m", -x.q[1] * cos(x.q[2])},
                  {"swing", "rad", x.q[2]},
                  {"u_1", "m/s^2", x.u[0]},
                  {"u_2", "m/s^2", x.u[1]}};
        }};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"s", "l", "theta"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u_1", "u_2"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * (x.v[0] * x.v[0] + x.v[1] * x.v[1] + x.q[1] * x.q[1] * x.v[2] * x.v[2]);
  }

  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression& rope = x.q[1];
    const Expression& swing = x.q[2];
    return ExpressionVector{
        {x.u[0] + 17.2656 * swing, x.u[1] - rope * x.v[2] * x.v[2], -rope * (x.u[0] + 27.0756 * swing)}};
  }

  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * (x.q[2] * x.q[2] + x.v[2] * x.v[2] + varying("control_weight") * x.u.dot(x.u));
  }

  [[nodiscard]] BoundaryState initial_state() const override {
    return {.q = Eigen::Vector3d(0.0, 22.0, 0.0), .v = Eigen::Vector3d(0.0, -1.0, 0.0)};
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return {.q = Eigen::Vector3d(10.0, 14.0, 0.0), .v = Eigen::Vector3d(2.5, 0.0, 0.0)};
  }
  [[nodiscard]] double horizon() const override { return 9.0; }

  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    bounds.v = {Eigen::Vector3d(-2.5, -1.0, -infinity), Eigen::Vector3d(2.5, 1.0, infinity)};
    bounds.u = {Eigen::Vector2d(-2.83374, -0.80865), Eigen::Vector2d(2.83374, 0.71265)};
    return bounds;
  }

  /// The optimum is about 5e-3 without the controls in the cost, 4e-2 with them.
  [[nodiscard]] double cost_scale() const override { return 1e2; }

 private:
  [[nodiscard]] std::optional<ReferenceOptimum> reference_optimum() const {
    const double weight = parameter("control_weight");
    if (weight == 0.01) {
      return ReferenceOptimum{.objective = 0.03751946138,
                              .digits = 10,
                              .certificate =
                                  "Gauss with 3 stages and Lobatto with 4 stages, on 512 intervals with the tolerance "
                                  "1e-13, agree, as do the replays of both controls"};
    }
    if (weight != 0.0) return std::nullopt;
    return ReferenceOptimum{
        .objective = 0.0051504,
        .digits = 5,
        .certificate =
            "Gauss with 1 and with 2 stages and Lobatto with 3 on 256 to 1024 intervals, and the replays of their "
            "controls agree; no more digits are certain, because the control is singular",
        .published = {{0.0051513, "PSOPT, example crane"}},
        .remark =
            "the published value is specific to its mesh and 2e-4 larger. On fine grids, a Newton step moves the "
            "singular controls by tenths of their size with any tolerance, while states and cost do not change. Such "
            "solutions may remain unconfirmed"};
  }
};

}  // namespace dmocbench
