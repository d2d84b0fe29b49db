#pragma once

#include <algorithm>
#include <cmath>

#include "methods/solvers/interior_point/constants.hpp"
#include "methods/solvers/interior_point/optimality_errors.hpp"

namespace dmocbench::interior_point {

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
