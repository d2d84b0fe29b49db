#pragma once

#include <string>
#include <utility>
#include <vector>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The only coordinate of a problem of first-order states alone.
inline constexpr const char* no_configuration = "no_configuration";

/// Whether a problem has first-order states alone. Every method collocates them with the tableau of the run, so that
/// all methods have the same solution.
[[nodiscard]] inline bool has_no_configuration(const Problem& problem) {
  return problem.configuration_names() == std::vector<std::string>{no_configuration};
}

/// A problem of first-order states alone, ẏ = g(u, y, t): it states `first_order_names`, `first_order_rates`,
/// `control_names`, a cost, `initial_state` and `final_state` by `at`, and `horizon`. Methods need a configuration,
/// so that it has one that rests: q = `no_configuration`, L = ½q̇², f = 0, q(0) = q̇(0) = 0. Overrides of `bounds` start
/// from `FirstOrderProblem::bounds()`.
class FirstOrderProblem : public Problem {
 public:
  [[nodiscard]] std::vector<std::string> configuration_names() const final { return {no_configuration}; }
  [[nodiscard]] Expression lagrangian(const State& x) const final { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& /*x*/) const final {
    return ExpressionVector::Constant(1, Expression(0.0));
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_configuration(0).free_velocity(0);
    return bounds;
  }

 protected:
  using Problem::Problem;
  /// The state with these first-order states, l entries.
  [[nodiscard]] static BoundaryState at(Eigen::VectorXd y) {
    return {.q = Eigen::VectorXd::Zero(1), .v = Eigen::VectorXd::Zero(1), .y = std::move(y)};
  }
};

}  // namespace dmocbench
