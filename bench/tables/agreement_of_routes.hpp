#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "methods/mechanics/problem_card.hpp"

namespace dmocbench {

/// The agreement of values of one cost by different routes, among themselves and with a reference.
struct RouteAgreement {
  std::size_t routes = 0;
  int digits = 0;            ///< that all routes share, 0 .. 16
  int reference_digits = 0;  ///< that all routes share with the reference, 0 .. 16
  /// "yes": all routes confirm every digit that the reference states; "to N digits": they confirm it as far as they
  /// agree among themselves and from grid to grid, which is less; "no": they do not; "not settled by one grid": they do
  /// not, which may be an error of the grid; "" without a reference or with less than two routes.
  std::string confirmed = {};
};

/// floor(-log10 of the relative difference) of two numbers, between 0 and 16.
[[nodiscard]] int agreeing_digits(double one, double other);

/// Compares every pair of objectives, and each with the reference. `grid_digits` are those that a route's cost on its
/// finest grid shares with the next coarser one: routes on one grid share where bounds are imposed, so that they may
/// agree better than either of them is accurate.
[[nodiscard]] RouteAgreement agreement_of_routes(const std::vector<double>& objectives,
                                                 const std::optional<ReferenceOptimum>& reference,
                                                 std::optional<int> grid_digits = std::nullopt);

}  // namespace dmocbench
