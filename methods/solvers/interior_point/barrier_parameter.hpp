#pragma once

#include <algorithm>
#include <cmath>

#include "methods/solvers/interior_point/constants.hpp"

namespace dmocbench::interior_point {

/// τ, the share of the way to a bound that a step may go, (8) of Wächter and Biegler.
[[nodiscard]] inline double tau_of(double mu) { return std::max(constants::tau_min, 1.0 - mu); }

/// μ, lowered by (7) as long as E_μ <= κ_ε μ. E_μ of (5) is the larger of `without_mu`, the errors that do not
/// depend on μ, and `complementarity(μ)`, both scaled.
template <class Complementarity>
[[nodiscard]] double lowered_barrier_parameter(double mu, double tolerance, double without_mu,
                                               const Complementarity& complementarity) {
  const double smallest = tolerance / (constants::kappa_epsilon + 1.0);
  const auto is_solved = [&] {
    const double allowed = constants::kappa_epsilon * mu;
    return without_mu <= allowed && complementarity(mu) <= allowed;
  };
  while (mu > smallest && is_solved()) {
    mu = std::max(smallest, std::min(constants::kappa_mu * mu, std::pow(mu, constants::theta_mu)));
  }
  return mu;
}

}  // namespace dmocbench::interior_point
