#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "methods/judgement/stop_rule.hpp"
#include "methods/solvers/interior_point/constants.hpp"

namespace dmocbench::interior_point {

/// The residuals of the optimality conditions at an iterate, the parts of (5), and the mean magnitudes of multipliers
/// by which they are scaled.
struct OptimalityErrors {
  double stationarity = 0.0;
  double violation = 0.0;
  double mean_multiplier = 0.0;        ///< of λ and z
  double mean_bound_multiplier = 0.0;  ///< of z
  double smallest_product = 0.0;       ///< of d z, the distances from bounds and their multipliers
  double largest_product = 0.0;        ///< of the same

  /// Largest |d z - μ|.
  [[nodiscard]] double complementarity(double mu) const {
    return std::max(std::abs(largest_product - mu), std::abs(smallest_product - mu));
  }
  /// E_μ, (5).
  [[nodiscard]] double of_barrier_problem(double mu) const {
    return std::max({stationarity / StopRule::scale(mean_multiplier), violation,
                     complementarity(mu) / StopRule::scale(mean_bound_multiplier)});
  }

  /// Whether the iterate may be the answer, (6), where constraints and variables may have floors of rounding of their
  /// own: from its constraints and multipliers, and the gradients of the Lagrangian with respect to unknowns and
  /// slacks.
  template <class Constraints, class Multipliers, class OfUnknowns, class OfSlacks>
  [[nodiscard]] bool meet(const StopRule& rule, const Constraints& constraints, const Multipliers& multipliers,
                          const OfUnknowns& of_unknowns, const OfSlacks& of_slacks) const {
    const auto largest_of = [](const auto& vector) { return vector.template lpNorm<Eigen::Infinity>(); };
    const bool by_entries = !rule.is_one_for_all();
    const bool holds = violation <= rule.violation() || (by_entries && rule.share_of_violation(constraints) <= 1.0);
    if (!holds) return false;
    const double largest = largest_of(multipliers);
    const double allowed = rule.stationarity(mean_multiplier, largest);
    const bool is_stationary =
        stationarity <= allowed || (by_entries && largest_of(of_slacks) <= allowed &&
                                    rule.share_of_stationarity(of_unknowns, mean_multiplier, largest) <= 1.0);
    return is_stationary && complementarity(0.0) <= rule.complementarity(mean_bound_multiplier);
  }
};

/// τ, the share of the way to a bound that a step may go, (8) of Wächter and Biegler.
[[nodiscard]] inline double tau_of(double mu) { return std::max(constants::tau_min, 1.0 - mu); }

/// μ, lowered by (7) as long as E_μ <= κ_ε μ.
[[nodiscard]] inline double lowered_barrier_parameter(double mu, double tolerance, const OptimalityErrors& errors) {
  const double smallest = tolerance / (constants::kappa_epsilon + 1.0);
  while (mu > smallest && errors.of_barrier_problem(mu) <= constants::kappa_epsilon * mu) {
    mu = std::max(smallest, std::min(constants::kappa_mu * mu, std::pow(mu, constants::theta_mu)));
  }
  return mu;
}

}  // namespace dmocbench::interior_point
