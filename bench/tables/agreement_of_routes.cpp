#include "bench/tables/agreement_of_routes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace dmocbench {

namespace {

constexpr int double_precision = 16;

}  // namespace

int agreeing_digits(double one, double other) {
  const double size = std::max(std::abs(one), std::abs(other));
  const double difference = std::abs(one - other);
  if (!std::isfinite(difference)) return 0;
  if (difference <= size * std::pow(10.0, -double_precision)) return double_precision;
  return std::clamp(static_cast<int>(std::floor(-std::log10(difference / size))), 0, double_precision);
}

RouteAgreement agreement_of_routes(const std::vector<double>& objectives,
                                   const std::optional<ReferenceOptimum>& reference, std::optional<int> grid_digits) {
  const auto digits_shared_with = [&](double other) {
    int digits = double_precision;
    for (const double one : objectives) digits = std::min(digits, agreeing_digits(one, other));
    return digits;
  };
  RouteAgreement agreement{.routes = objectives.size()};
  if (reference && !objectives.empty()) agreement.reference_digits = digits_shared_with(reference->objective);
  if (objectives.size() < 2) return agreement;
  agreement.digits = double_precision;
  for (const double one : objectives) agreement.digits = std::min(agreement.digits, digits_shared_with(one));
  if (!reference) return agreement;
  if (agreement.reference_digits >= reference->digits) {
    agreement.confirmed = "yes";
  } else if (const int certain = std::min(agreement.digits, grid_digits.value_or(double_precision));
             certain > 0 && agreement.reference_digits >= certain) {
    agreement.confirmed = fmt::format("to {} digits", agreement.reference_digits);
  } else {
    agreement.confirmed = grid_digits ? "no" : "undecided: one grid is not enough";
  }
  return agreement;
}

}  // namespace dmocbench
