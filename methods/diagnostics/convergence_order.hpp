#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace dmocbench {

/// A grid's step (or number of intervals) and the error measured on it.
struct GridError {
  double step = 0.0;   ///< h
  double error = 0.0;  ///< at this step
};

/// A straight line through log(error) over log(step).
struct FittedOrder {
  double order = 0.0;           ///< the exponent of h
  double standard_error = 0.0;  ///< of the order; 0 with two points
  double first_abscissa = 0.0;  ///< the smallest step used
  double last_abscissa = 0.0;   ///< the largest step used
  int points = 0;               ///< how many it was fitted through
};

/// The order p by least squares: the slope of log(error) over log(step). Where errors were measured against a grid of
/// step `reference`, finer than all others, they fall like c (h^p - reference^p), and p is fitted to this difference; 0
/// stands for an exact reference. Points whose error is not positive and finite, and those not coarser
/// than the reference, are left out; nothing is returned if fewer than two points remain.
[[nodiscard]] std::optional<FittedOrder> fit_order(const std::vector<GridError>& points, double reference = 0.0);

/// The orders between neighbouring points, one fewer than the points; not a number where one has no positive error.
[[nodiscard]] std::vector<double> neighbouring_orders(const std::vector<GridError>& points, double reference = 0.0);

/// Why a range of grids ends where it does.
enum class RangeEnd : std::uint8_t {
  grids,   ///< there is no further grid
  floor,   ///< the error on the next grid is too close to rounding
  orders,  ///< the orders with the next grid would differ by more than `largest_spread`
};

/// "grids", "floor" or "orders".
[[nodiscard]] std::string_view name_of(RangeEnd end) noexcept;

/// Neighbouring grids on which errors fall as one power of the step: the numbers `first` to `end` - 1.
struct AsymptoticRange {
  std::size_t first = 0;                  ///< number of the coarsest grid
  std::size_t end = 0;                    ///< one past the finest grid
  RangeEnd coarse_end = RangeEnd::grids;  ///< why no coarser grid belongs to it
  RangeEnd fine_end = RangeEnd::grids;    ///< why no finer grid belongs to it
};

/// The fewest grids for an order.
inline constexpr std::size_t fewest_grids = 4;
/// The orders between the neighbouring grids of a range differ by at most this much. An error c h^p (1 + a h) then
/// gives a fitted order within `largest_spread` of p on grids whose steps span a factor of 4, because its local order
/// p + a h + O(h^2) exceeds p on the coarsest grid by 4/3 of the spread.
inline constexpr double largest_spread = 0.2;

/// The range of at least `fewest_grids` neighbouring points, coarsest first, whose errors exceed `least` and whose
/// neighbouring orders differ by at most `largest_spread`: the finest such range, from as coarse a grid as possible.
/// Not the longest, because errors of higher order can hide the leading one on many coarse grids. None if there is no
/// such range. Points after the first one that does not exceed `least` are noise and belong to no range.
[[nodiscard]] std::optional<AsymptoticRange> asymptotic_range(const std::vector<GridError>& points, double least,
                                                              double reference = 0.0);

/// The order fitted on the asymptotic range of points, coarsest first, against an exact reference; none without such a
/// range.
[[nodiscard]] std::optional<FittedOrder> asymptotic_order(const std::vector<GridError>& points, double least);

}  // namespace dmocbench
