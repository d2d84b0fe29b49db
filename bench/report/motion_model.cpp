#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "bench/report/model.hpp"
#include "bench/report/words.hpp"
#include "methods/tables/motion_file.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The place of a point at each instant.
struct MovingPoint {
  std::vector<double> x;
  std::vector<double> y;
};

/// A column at 65 instants at most, the first and the last among them.
std::vector<double> column_of(const Table& table, const std::string& column) {
  constexpr std::size_t most = 64;
  const std::size_t last = table.rows().size() - 1;
  const std::size_t steps = std::min(last, most);
  std::vector<double> values;
  for (std::size_t i = 0; i <= steps; ++i)
    values.push_back(table.rows()[i * last / steps].number(column, std::nan("")));
  return values;
}

/// The column of the other coordinate: y, or else z, if there is one.
std::optional<std::string> partner_of(const std::string& column, std::size_t place_of_letter, const Table& picture) {
  for (const char other : {'y', 'z'}) {
    std::string partner = column;
    partner[place_of_letter] = other;
    if (std::ranges::count(picture.columns(), partner) > 0) return partner;
  }
  return std::nullopt;
}

bool is_everywhere(const MovingPoint& point) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  return std::ranges::all_of(point.x, is_finite) && std::ranges::all_of(point.y, is_finite);
}

/// The points whose two coordinates are columns with the unit of the first point. One that has an x alone moves
/// on the x-axis, if others have both.
std::vector<MovingPoint> points_of(const Table& picture) {
  std::vector<MovingPoint> points;
  std::optional<std::string> length;
  bool has_pair = false;
  for (const std::string& column : picture.columns()) {
    const auto [name, unit] = name_and_unit(column);
    if ((name != "x" && !name.ends_with("_x")) || length.value_or(unit) != unit) continue;
    length = unit;
    const auto partner = partner_of(column, name.size() - 1, picture);
    has_pair = has_pair || partner;
    MovingPoint point{.x = column_of(picture, column), .y = {}};
    point.y = partner ? column_of(picture, *partner) : std::vector<double>(point.x.size(), 0.0);
    points.push_back(std::move(point));
  }
  if (!has_pair) points.clear();
  std::erase_if(points, [](const MovingPoint& point) { return !is_everywhere(point); });
  return points;
}

/// The smallest rectangle with all points.
struct Frame {
  double left = infinity;
  double right = -infinity;
  double bottom = infinity;
  double top = -infinity;
  void add(double x, double y) {
    left = std::min(left, x);
    right = std::max(right, x);
    bottom = std::min(bottom, y);
    top = std::max(top, y);
  }
  void add(const MovingPoint& point) {
    for (std::size_t k = 0; k < point.x.size(); ++k) {
      if (std::isfinite(point.y[k])) add(point.x[k], point.y[k]);
    }
  }
};

/// Vertices in the directions of SVG.
std::string vertices(const MovingPoint& point) {
  std::string places;
  for (std::size_t k = 0; k < point.x.size(); ++k) {
    if (std::isfinite(point.y[k])) places += fmt::format("{:.4g},{:.4g} ", point.x[k], -point.y[k]);
  }
  return places;
}

/// A quantity over time.
MovingPoint curve_of(const ReportedMotion& motion, const std::string& column) {
  return {.x = column_of(motion.picture, motion.picture.columns().front()), .y = column_of(motion.picture, column)};
}

/// A quantity of all motions as curves in a strip of its own, which begins at `top`; null if it is constant.
Json strip_of(const std::vector<const ReportedMotion*>& motions, const std::string& column, double top) {
  constexpr double width = 320.0;
  constexpr double height = 70.0;
  const double axis = top + 20.0 + height;
  Frame range;
  for (const ReportedMotion* motion : motions) range.add(curve_of(*motion, column));
  if (!(range.top > range.bottom)) return {};
  const double size = range.top - range.bottom;
  const auto without_rounding = [size](double value) { return std::abs(value) < 1e-9 * size ? 0.0 : value; };
  Json curves = Json::array();
  for (const ReportedMotion* motion : motions) {
    MovingPoint curve = curve_of(*motion, column);
    for (double& t : curve.x) t = width * (t - range.left) / (range.right - range.left);
    for (double& value : curve.y) value = height * (value - range.bottom) / size - axis;
    curves.push_back({{"method", motion->method}, {"points", vertices(curve)}});
  }
  return {{"label", fmt::format("{} from {:.4g} to {:.4g}", in_words(column), without_rounding(range.bottom),
                                without_rounding(range.top))},
          {"top", top + 12.0},
          {"axis", axis},
          {"curves", curves}};
}

/// The first quantities that change, over time.
Json over_time(const std::vector<const ReportedMotion*>& motions) {
  constexpr std::size_t most = 3;
  constexpr double pitch = 96.0;
  Json strips = Json::array();
  const std::vector<std::string>& columns = motions.front()->picture.columns();
  for (std::size_t i = 1; i < columns.size() && strips.size() < most; ++i) {
    Json strip = strip_of(motions, columns[i], pitch * static_cast<double>(strips.size()));
    if (!strip.is_null()) strips.push_back(std::move(strip));
  }
  if (strips.empty()) return {};
  return {{"box", fmt::format("-4 0 328 {:g}", pitch * static_cast<double>(strips.size()))}, {"strips", strips}};
}

/// The paths of the points in the plane; null if a motion has none.
Json in_plane(const std::vector<const ReportedMotion*>& motions) {
  Frame frame;
  Json drawn = Json::array();
  for (const ReportedMotion* motion : motions) {
    const std::vector<MovingPoint> points = points_of(motion->picture);
    if (points.empty()) return {};
    std::vector<std::string> paths;
    for (const MovingPoint& point : points) {
      frame.add(point);
      paths.push_back(vertices(point));
    }
    std::string instants;
    for (const double t : column_of(motion->picture, motion->picture.columns().front()))
      instants += fmt::format("{:.5g} ", t);
    drawn.push_back({{"method", motion->method},
                     {"words", method_in_words(motion->method)},
                     {"times", instants},
                     {"paths", paths}});
  }
  const double size = std::max(frame.right - frame.left, frame.top - frame.bottom);
  const double margin = 0.06 * (size > 0.0 ? size : 1.0);
  return {{"box", fmt::format("{:.5g} {:.5g} {:.5g} {:.5g}", frame.left - margin, -frame.top - margin,
                              frame.right - frame.left + 2.0 * margin, frame.top - frame.bottom + 2.0 * margin)},
          {"radius", fmt::format("{:.4g}", 0.25 * margin)},
          {"motions", drawn}};
}

}  // namespace

PageModel motion_model(const std::vector<const ReportedMotion*>& motions) {
  std::vector<const ReportedMotion*> shown;
  std::ranges::copy_if(motions, std::back_inserter(shown),
                       [](const ReportedMotion* motion) { return motion->picture.rows().size() >= 2; });
  if (shown.empty()) return {};
  Json model = in_plane(shown);
  if (model.is_null()) model = over_time(shown);
  if (model.is_null()) return model;
  const std::string time = shown.front()->picture.columns().front();
  Frame range;
  for (const ReportedMotion* motion : shown) range.add(curve_of(*motion, motion->picture.columns().front()));
  model["begin"] = fmt::format("{:.5g}", range.left);
  model["end"] = fmt::format("{:.5g}", range.right);
  model["unit"] = name_and_unit(time).second;
  return model;
}

}  // namespace dmocbench
