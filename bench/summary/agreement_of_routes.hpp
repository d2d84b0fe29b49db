#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "methods/mechanics/problem_card.hpp"

namespace dmocbench {

/// How well values of one cost agree that were found by different routes, among themselves and with a reference.
struct RouteAgreement {
  std::size_t routes = 0;
  int digits = 0;            ///< that all routes share, 0 .. 16
  int reference_digits = 0;  ///< that all routes share with the reference, 0 .. 16
  /// "yes": all routes confirm every digit that the reference states; "to N digits": they confirm it as far as they
  /// agree among themselves, which is less; "no": they do not; "" without a reference or with less than two routes.
  std::string confirmed = {};
};

/// floor(-log10 of the relative difference) of two numbers, between 0 and 16.
[[nodiscard]] int agreeing_digits(double one, double other);

/// Compares every pair of objectives, and each with the reference.
[[nodiscard]] RouteAgreement agreement_of_routes(const std::vector<double>& objectives,
                                                 const std::optional<ReferenceOptimum>& reference);

}  // namespace dmocbench
