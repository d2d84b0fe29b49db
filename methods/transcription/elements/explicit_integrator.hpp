#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

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

}  // namespace dmocbench
