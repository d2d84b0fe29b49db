#pragma once

#include <cmath>
#include <vector>

#include "methods/mechanics/problem.hpp"
#include "problems/common_parameters.hpp"

namespace dmocbench {

/// The hyper-sensitive problem as a mechanical system: fast at both ends, at rest for most of the horizon.
///
/// L = ½q̇² - ¼q⁴, f = u, hence q̈ = -q³ + u, C = ½(q² + q̇² + u²), from rest at q = 1 to rest at q = 1.5; nondimensional.
/// Rao and Mease have ẋ = -x³ + u with C = ½(x² + u²) and these ends; here x is a configuration with a velocity.
class Hypersensitive : public Problem {
 public:
  Hypersensitive() : Problem({{"horizon", 40.0, "", "duration T", 1.0, 1e4}}) {}

  [[nodiscard]] std::string name() const override { return "hypersensitive"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return {.description = "hardening spring, driven to rest and away again: fast at both ends, slow in between",
            .title = "Hypersensitive spring",
            .axis_units = AxisUnits::pure_numbers(),
            .source =
                "Rao, Mease: Eigenvector approximate dichotomic basis method for solving hyper-sensitive optimal "
                "control problems, Optimal Control Applications and Methods 21, 2000; here a second-order problem",
            .guess = "the trajectory with q'' = q between the ends, with slope v, u = 0",
            .time_unit = {.name = "", .factor = 1.0},
            .reference = with_default_parameters(
                *this, {.objective = 2.780799731435,
                        .digits = 13,
                        .certificate = "the indirect method with Gauss schemes of orders 16 and 20; DMOC with three "
                                       "stages on an adapted grid has the same cost to 13 digits"})};
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"q"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }

  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression square = x.q[0] * x.q[0];
    return 0.5 * x.v[0] * x.v[0] - 0.25 * square * square;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * (x.q[0] * x.q[0] + x.v[0] * x.v[0] + x.u[0] * x.u[0]);
  }

  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Constant(1, first));
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Constant(1, last));
  }
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }
  /// The optimum is about 2.8.
  [[nodiscard]] double cost_scale() const override { return 1.0; }

  [[nodiscard]] MotionPoint guess(double t) const override {
    const double left = horizon() - t;
    const double norm = 1.0 - std::exp(-2.0 * horizon());
    const double falls = first * std::exp(-t) / norm;
    const double rises = last * std::exp(-left) / norm;
    const double before = std::exp(-2.0 * t);
    const double behind = std::exp(-2.0 * left);
    return {.q = Eigen::VectorXd::Constant(1, falls * (1.0 - behind) + rises * (1.0 - before)),
            .v = Eigen::VectorXd::Constant(1, rises * (1.0 + before) - falls * (1.0 + behind)),
            .u = Eigen::VectorXd::Zero(1)};
  }

 private:
  static constexpr double first = 1.0;
  static constexpr double last = 1.5;
};

}  // namespace dmocbench
