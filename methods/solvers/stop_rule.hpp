#pragma once

#include <algorithm>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// The residuals at which a program counts as solved: the tolerance, or rounding where that is larger. The solvers that
/// are compared stop by this rule, and all are judged by it (`confirm`).
class StopRule {
 public:
  /// `tolerance` > 0, of the program as the solver sees it.
  StopRule(const NonlinearProgram& program, double tolerance)
      : tolerance_(tolerance), rounding_(program.rounding_floor()) {}

  /// For the largest violation of a constraint or bound.
  [[nodiscard]] double violation() const { return std::max(tolerance_, rounding_); }

  /// For the largest entry of ∇_x of the Lagrangian. `mean_multiplier`, `largest_multiplier`: magnitudes; the mean
  /// excuses large residuals as s_d of Wächter and Biegler (2006), (6), does.
  [[nodiscard]] double stationarity(double mean_multiplier, double largest_multiplier) const {
    return std::max(tolerance_ * scale(mean_multiplier), rounding_ * std::max(1.0, largest_multiplier));
  }

  /// For the largest product of a bound's multiplier and the distance to it. `mean_multiplier`: of those of bounds.
  [[nodiscard]] double complementarity(double mean_multiplier) const { return tolerance_ * scale(mean_multiplier); }

  /// s_d and s_c of Wächter and Biegler: large multipliers excuse large residuals.
  [[nodiscard]] static double scale(double mean_multiplier) {
    constexpr double s_max = 100.0;
    return std::max(s_max, mean_multiplier) / s_max;
  }

 private:
  double tolerance_;
  double rounding_;
};

}  // namespace dmocbench
