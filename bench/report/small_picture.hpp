#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/report/model.hpp"

namespace dmocbench {

/// The width of a small picture in pixels.
inline constexpr double picture_width = 268.0;
/// The height of a small picture in pixels.
inline constexpr double picture_height = 100.0;

/// A curve of a method: its points (x, y).
struct MethodCurve {
  std::string method;                             ///< its name, "dmoc"
  std::vector<std::pair<double, double>> points;  ///< those that are not positive are left out
};

/// A number of a method with its interval of confidence.
struct MethodInterval {
  std::string method;  ///< its name
  double value = 0.0;  ///< the number
  double lower = 0.0;  ///< lower end
  double upper = 0.0;  ///< upper end
};

/// Numbers of methods on one line.
struct IntervalLine {
  std::string name;                       ///< at the left
  std::vector<MethodInterval> intervals;  ///< one for each method
};

/// Parts of all solves of a method.
struct MethodShares {
  std::string method;  ///< its name
  double best = 0.0;   ///< solves that ended in the best minimum
  double other = 0.0;  ///< solves that ended in another minimum
  double all = 1.0;    ///< all solves
};

/// "DMOC", "Hamiltonian" or "tangent-space": the name of a method at its curve.
[[nodiscard]] std::string short_name(const std::string& method);

/// Curves over logarithmic axes, each named at its right end; curves that coincide share a name. Values are coordinates
/// in pixels for plots/report/small_picture.mustache.
[[nodiscard]] PageModel curves_picture(const std::string& caption, const std::vector<MethodCurve>& curves);

/// Bars from 0, a method and its number for each.
[[nodiscard]] PageModel bars_picture(const std::string& caption,
                                     const std::vector<std::pair<std::string, double>>& bars);

/// Ratios with their intervals, compared with DMOC at 1.
[[nodiscard]] PageModel intervals_picture(const std::string& caption, const std::vector<IntervalLine>& lines);

/// Bars of parts of all solves.
[[nodiscard]] PageModel shares_picture(const std::string& caption, const std::vector<MethodShares>& shares);

}  // namespace dmocbench
