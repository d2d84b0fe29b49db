#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "methods/transcription/elements/element.hpp"

namespace dmocbench {

/// An explicit Runge-Kutta method (A, b, c), by which shooting integrates the equations of motion.
struct ExplicitIntegrator {
  std::string name;   ///< as on the command line
  Eigen::MatrixXd a;  ///< r × r, strictly lower
  Eigen::VectorXd b;  ///< r weights
  Eigen::VectorXd c;  ///< r stage times relative to the step
  int order = 0;      ///< classical order

  /// How many stages a step has.
  [[nodiscard]] Eigen::Index stages() const noexcept { return b.size(); }
};

/// Names of all explicit integrators: "rk4", the classical method of order 4, and "midpoint", Runge's method of
/// order 2.
[[nodiscard]] std::vector<std::string> explicit_integrator_names();

/// The integrator `name`. Throws `Error` that lists the names if it is unknown.
[[nodiscard]] const ExplicitIntegrator& explicit_integrator(std::string_view name);

/// The treatment of the nodes in between.
enum class Shooting : std::uint8_t {
  multiple,  ///< they are unknowns
  single,    ///< they are simulated: `SingleShooting` condenses the program
};

/// The name of the family, as on the command line.
[[nodiscard]] constexpr std::string_view shooting_family(Shooting shooting) {
  return shooting == Shooting::single ? "single_shooting" : "multiple_shooting";
}

/// Direct shooting (section 3.3 of the paper; Bock, Plitt 1984): the interval is integrated from its left node.
///
/// Node: (q_k, v_k). With Φ the explicit integrator's `substeps` steps of q̇ = v, v̇ = L_vv⁻¹(L_q + f - L_vq v - L_vt),
/// the equations of an interval are
///   (x_{k+1} - Φ(x_k, U))/h = 0        (2n, units: velocity, acceleration).
/// The control is the polynomial through U_1 .. U_s at the stage times of the tableau, the same as where the controls
/// of the other families are replayed; the cost is integrated with the state. No stage is an unknown. At the stage
/// times q is the cubic through the ends of the step and their velocities, and Q̇_i its derivative; path constraints
/// hold there. L_vv must have nonzero leading minors (`solve_symmetric`).
///
/// With s = 1 the control is constant on an interval: order 2, whatever the integrator's order.
class ShootingElement final : public Element {
 public:
  /// Throws `Error` unless `substeps` is in [1, most_substeps].
  ShootingElement(Shooting shooting, ExplicitIntegrator integrator, int substeps);

  /// Beyond it, formulas of an interval become too long.
  static constexpr int most_substeps = 64;

  [[nodiscard]] bool has_stage_unknowns() const override { return false; }
  [[nodiscard]] IntervalTrace trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const override;

 private:
  ExplicitIntegrator integrator_;
  int substeps_;
};

/// Throws `Error` unless `substeps` is in [1, `ShootingElement::most_substeps`].
void require_substeps(int substeps);

/// FAMILY_INTEGRATOR_SUBSTEPS, such as "multiple_shooting_rk4_1": the integrator and the number of its steps per
/// interval.
[[nodiscard]] std::string shooting_name(std::string_view family, std::string_view integrator, int substeps);

/// The element of an integration INTEGRATOR_SUBSTEPS, such as "rk4_1". Throws `Error` that names a missing part.
[[nodiscard]] std::unique_ptr<Element> make_shooting_element(Shooting shooting, std::string_view integration);

}  // namespace dmocbench
