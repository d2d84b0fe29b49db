#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// The residuals at which a program counts as solved: the tolerance, or rounding where that is larger. The solvers that
/// are compared stop by this rule, and all are judged by it (`confirm`). Rounding belongs to the constraint, or to the
/// variable (`RoundingFloors`). The floors, or the program that they are of, must outlive it.
class StopRule {
 public:
  /// `tolerance` > 0, of the program as the solver sees it.
  StopRule(const NonlinearProgram& program, double tolerance) : StopRule(program.rounding_floors(), tolerance) {}
  StopRule(const RoundingFloors& floors, double tolerance) : tolerance_(tolerance), floors_(floors) {}

  /// True if all constraints, and all variables, are allowed the same: then the largest residual decides.
  [[nodiscard]] bool is_one_for_all() const { return floors_.are_equal(); }

  /// The smallest limit on the violation of any constraint or bound.
  [[nodiscard]] double violation() const { return std::max(tolerance_, floors_.smallest); }
  /// The limit for one constraint.
  [[nodiscard]] double violation(Eigen::Index row) const { return std::max(tolerance_, floors_.of_constraint(row)); }

  /// The smallest limit on any entry of ∇_x of the Lagrangian. `mean_multiplier`, `largest_multiplier`:
  /// magnitudes; the mean excuses large residuals as s_d of Wächter and Biegler (2006), (6), does.
  [[nodiscard]] double stationarity(double mean_multiplier, double largest_multiplier) const {
    return stationarity_above(floors_.smallest, mean_multiplier, largest_multiplier);
  }
  /// The limit on the entry of one variable.
  [[nodiscard]] double stationarity(double mean_multiplier, double largest_multiplier, Eigen::Index variable) const {
    return stationarity_above(floors_.of_variable(variable), mean_multiplier, largest_multiplier);
  }

  /// The largest violation of a constraint divided by its permitted value. `violations`: one of either sign per
  /// constraint.
  [[nodiscard]] double share_of_violation(const Eigen::VectorXd& violations) const {
    return largest_share(violations, [&](Eigen::Index i) { return violation(i); });
  }
  /// The largest entry of ∇_x of the Lagrangian divided by its permitted value.
  [[nodiscard]] double share_of_stationarity(const Eigen::VectorXd& gradient, double mean_multiplier,
                                             double largest_multiplier) const {
    return largest_share(gradient,
                         [&](Eigen::Index j) { return stationarity(mean_multiplier, largest_multiplier, j); });
  }

  /// The limit on the largest product of a bound's multiplier and the distance to it. `mean_multiplier`: over bounds.
  [[nodiscard]] double complementarity(double mean_multiplier) const { return tolerance_ * scale(mean_multiplier); }

  /// s_d and s_c of Wächter and Biegler: large multipliers excuse large residuals, up to `most_excused`.
  [[nodiscard]] static double scale(double mean_multiplier) {
    constexpr double s_max = 100.0;
    return std::max(s_max, std::min(mean_multiplier, s_max * most_excused)) / s_max;
  }

  /// The largest such factor: next to multipliers without a bound any residual would pass.
  static constexpr double most_excused = 1e8;

 private:
  [[nodiscard]] double stationarity_above(double floor, double mean_multiplier, double largest_multiplier) const {
    return std::max(tolerance_ * scale(mean_multiplier), floor * std::clamp(largest_multiplier, 1.0, most_excused));
  }

  /// NaN where an entry is.
  template <class Allowed>
  [[nodiscard]] static double largest_share(const Eigen::VectorXd& entries, const Allowed& allowed) {
    double largest = 0.0;
    for (Eigen::Index i = 0; i < entries.size(); ++i) {
      const double share = std::abs(entries[i]) / allowed(i);
      if (std::isnan(share)) return share;
      largest = std::max(largest, share);
    }
    return largest;
  }

  double tolerance_;
  const RoundingFloors& floors_;
};

}  // namespace dmocbench
