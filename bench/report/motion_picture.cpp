#include "bench/report/motion_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/report/html.hpp"
#include "methods/runtime/parsed.hpp"
#include "methods/tables/motion_file.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A point of a picture: its name and where it is at each instant.
struct MovingPoint {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  bool is_at_rod = false;  ///< it keeps its distance from the previous point (from the origin if it is the first)
};

/// The most instants of a motion that are drawn.
constexpr std::size_t most_instants = 129;

std::vector<double> column_of(const Table& table, const std::string& column) {
  const std::size_t count = table.rows().size();
  const std::size_t stride = std::max<std::size_t>(1, (count + most_instants - 3) / (most_instants - 1));
  std::vector<double> values;
  for (std::size_t k = 0; k < count; k += stride) values.push_back(table.rows()[k].number(column, std::nan("")));
  if ((count - 1) % stride != 0) values.push_back(table.rows().back().number(column, std::nan("")));
  return values;
}

/// The column of the other coordinate: y, or else z, if there is one.
std::optional<std::string> partner_of(const std::string& column, const std::string& name, const Table& picture) {
  for (const char other : {'y', 'z'}) {
    std::string partner = column;
    partner[name.size() - 1] = other;
    if (std::ranges::count(picture.columns(), partner) > 0) return partner;
  }
  return std::nullopt;
}

/// True if `to` always keeps its distance from another point (from the origin if it is null): there is a rod.
bool is_rod(const MovingPoint* from, const MovingPoint& to) {
  double least = infinity;
  double largest = 0.0;
  for (std::size_t k = 0; k < to.x.size(); ++k) {
    const double distance =
        std::hypot(to.x[k] - (from == nullptr ? 0.0 : from->x[k]), to.y[k] - (from == nullptr ? 0.0 : from->y[k]));
    least = std::min(least, distance);
    largest = std::max(largest, distance);
  }
  constexpr double relative_tolerance = 1e-9;
  return largest > 0.0 && largest - least <= relative_tolerance * largest;
}

/// The points whose two coordinates are columns with the unit of the first point. One that has an x alone moves
/// on the x-axis, if others have both.
std::vector<MovingPoint> points_of(const Table& picture) {
  std::vector<MovingPoint> points;
  std::optional<std::string> length;
  bool has_pair = false;
  for (const std::string& column : picture.columns()) {
    const auto [name, unit] = name_and_unit(column);
    if (name != "x" && !name.ends_with("_x")) continue;
    if (length.value_or(unit) != unit) continue;
    length = unit;
    const auto partner = partner_of(column, name, picture);
    has_pair = has_pair || partner;
    MovingPoint point{
        .name = name == "x" ? "" : name.substr(0, name.size() - 2), .x = column_of(picture, column), .y = {}};
    point.y = partner ? column_of(picture, *partner) : std::vector<double>(point.x.size(), 0.0);
    point.is_at_rod = is_rod(points.empty() ? nullptr : &points.back(), point);
    points.push_back(std::move(point));
  }
  if (!has_pair) points.clear();
  const auto is_nowhere = [](const MovingPoint& point) {
    const auto is_missing = [](double value) { return !std::isfinite(value); };
    return std::ranges::any_of(point.x, is_missing) || std::ranges::any_of(point.y, is_missing);
  };
  std::erase_if(points, is_nowhere);
  return points;
}

/// The drawing of one method.
struct DrawnMotion {
  std::string method;
  std::string time_unit;
  std::vector<double> t;
  std::vector<MovingPoint> points;
};

/// JSON that ends no element of the page, whatever a name holds.
std::string as_script(const Json& data) {
  std::string text = data.dump(-1, ' ', true, Json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

/// A number with five digits, or unchanged where those do not give a double (for the largest one).
double short_number(double value) { return parsed<double>(fmt::format("{:.5g}", value)).value_or(value); }

std::vector<double> short_numbers(std::vector<double> values) {
  std::ranges::transform(values, values.begin(), short_number);
  return values;
}

Json data_of(const std::vector<DrawnMotion>& motions) {
  Json data{{"unit", motions.front().time_unit}, {"motions", Json::array()}};
  for (const DrawnMotion& motion : motions) {
    Json points = Json::array();
    for (const MovingPoint& point : motion.points) {
      points.push_back({{"name", point.name},
                        {"x", short_numbers(point.x)},
                        {"y", short_numbers(point.y)},
                        {"rod", point.is_at_rod}});
    }
    data["motions"].push_back({{"method", motion.method}, {"t", short_numbers(motion.t)}, {"points", points}});
  }
  return data;
}

/// The smallest rectangle with all points, with a margin; and with the origin, if a rod begins there.
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
  [[nodiscard]] bool holds_origin() const { return left <= 0.0 && right >= 0.0 && bottom <= 0.0 && top >= 0.0; }
  [[nodiscard]] double size() const { return std::max(right - left, top - bottom); }
};

Frame frame_of(const std::vector<DrawnMotion>& motions) {
  Frame frame;
  for (const DrawnMotion& motion : motions) {
    for (const MovingPoint& point : motion.points) {
      for (std::size_t k = 0; k < point.x.size(); ++k) frame.add(point.x[k], point.y[k]);
    }
    if (motion.points.front().is_at_rod) frame.add(0.0, 0.0);
  }
  const double margin = 0.06 * (frame.size() > 0.0 ? frame.size() : 1.0);
  return {frame.left - margin, frame.right + margin, frame.bottom - margin, frame.top + margin};
}

std::string path_of(const MovingPoint& point, const std::string& kind) {
  std::string places;
  for (std::size_t k = 0; k < point.x.size(); ++k) places += fmt::format("{:.5g},{:.5g} ", point.x[k], -point.y[k]);
  return fmt::format(R"(<polyline class="path {}" points="{}"/>)", kind, places);
}

/// The rods at some instants, so that a picture that stands still shows the motion.
std::string rods_of(const DrawnMotion& motion) {
  constexpr std::size_t instants = 8;
  std::string lines;
  for (std::size_t i = 0; i <= instants; ++i) {
    const std::size_t k = i * (motion.t.size() - 1) / instants;
    double x = 0.0;
    double y = 0.0;
    for (const MovingPoint& point : motion.points) {
      if (point.is_at_rod) lines += fmt::format("M{:.5g},{:.5g}L{:.5g},{:.5g}", x, -y, point.x[k], -point.y[k]);
      x = point.x[k];
      y = point.y[k];
    }
  }
  return lines.empty() ? "" : fmt::format(R"(<path class="instants" d="{}"/>)", lines);
}

/// All that can be seen without JavaScript.
std::string drawing_of(const std::vector<DrawnMotion>& motions, const std::string& title) {
  const Frame frame = frame_of(motions);
  const double radius = 0.015 * frame.size();
  std::string svg = fmt::format(
      "<svg role=\"img\" aria-label=\"{}\" viewBox=\"{:.5g} {:.5g} {:.5g} {:.5g}\" "
      "data-radius=\"{:.4g}\">",
      escaped(title), frame.left, -frame.top, frame.right - frame.left, frame.top - frame.bottom, radius);
  if (frame.holds_origin()) svg += fmt::format(R"(<circle class="origin" r="{:.4g}"/>)", 0.6 * radius);
  svg += rods_of(motions.front());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    for (const MovingPoint& point : motions[i].points) svg += path_of(point, fmt::format("method-{}", i));
  }
  for (const MovingPoint& point : motions.front().points) {
    svg += fmt::format(R"(<circle class="ending" cx="{:.5g}" cy="{:.5g}" r="{:.4g}"/>)", point.x.back(),
                       -point.y.back(), radius);
  }
  return svg + "</svg>\n";
}

/// The area for quantities over time, each in its own strip.
struct Strips {
  static constexpr double width = 320.0;
  static constexpr double height = 70.0;
  static constexpr double gap = 26.0;
  static constexpr std::size_t most = 3;
  double begin = infinity;  ///< of all motions
  double end = -infinity;
  std::size_t count = 0;
  std::string svg;
  std::vector<DrawnMotion> motions;  ///< a point on each curve, to be moved
  [[nodiscard]] double bottom() const { return static_cast<double>(count) * (height + gap); }
};

/// The least and largest finite number of a column in all motions; without finite numbers the least is above the
/// largest.
std::pair<double, double> range_of(const std::vector<const ReportedMotion*>& motions, const std::string& column) {
  std::pair<double, double> range{infinity, -infinity};
  for (const ReportedMotion* motion : motions) {
    for (const double value : column_of(motion->picture, column)) {
      if (std::isfinite(value)) range = {std::min(range.first, value), std::max(range.second, value)};
    }
  }
  return range;
}

/// Adds a strip with a quantity of all motions, unless it is constant.
void add_strip(Strips& strips, const std::vector<const ReportedMotion*>& motions, const std::string& column) {
  const auto [least, largest] = range_of(motions, column);
  if (!(largest > least)) return;
  ++strips.count;
  const auto without_rounding = [least = least, largest = largest](double value) {
    constexpr double rounding = 1e-9;
    return std::abs(value) < rounding * (largest - least) ? 0.0 : value;
  };
  strips.svg += fmt::format(
      R"(<text x="5" y="{0:.0f}">{1} from {2:.4g} to {3:.4g}</text><path class="axis" d="M0,{4:.0f}h{5:.0f}"/>)",
      strips.bottom() - Strips::height - 6.0, escaped(in_words(column)), without_rounding(least),
      without_rounding(largest), strips.bottom(), Strips::width);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const std::vector<double>& t = strips.motions[i].t;
    const std::vector<double> values = column_of(motions[i]->picture, column);
    MovingPoint point{.name = column, .x = {}, .y = {}};
    for (std::size_t k = 0; k < t.size(); ++k) {
      if (!std::isfinite(values[k])) continue;
      point.x.push_back(Strips::width * (t[k] - strips.begin) / (strips.end - strips.begin));
      point.y.push_back(Strips::height * (values[k] - least) / (largest - least) - strips.bottom());
    }
    strips.svg += path_of(point, fmt::format("method-{}", i));
    if (point.x.size() == t.size()) strips.motions[i].points.push_back(std::move(point));
  }
}

/// The first quantities that change.
Strips strips_of(const std::vector<const ReportedMotion*>& motions) {
  Strips strips;
  for (const ReportedMotion* motion : motions) {
    const std::string time = motion->picture.columns().front();
    strips.motions.push_back({motion->method, name_and_unit(time).second, column_of(motion->picture, time), {}});
    strips.begin = std::min(strips.begin, strips.motions.back().t.front());
    strips.end = std::max(strips.end, strips.motions.back().t.back());
  }
  const std::vector<std::string>& columns = motions.front()->picture.columns();
  for (std::size_t column = 1; column < columns.size() && strips.count < Strips::most; ++column)
    add_strip(strips, motions, columns[column]);
  return strips;
}

/// The controls by which JavaScript moves a motion through time, and their data.
std::string controls_html(const std::string& problem, const Json& data) {
  return fmt::format(
      "<p class=\"controls\" hidden><button type=\"button\" aria-label=\"Play {0}\">Play</button> "
      "<input type=\"range\" min=\"0\" max=\"1000\" value=\"0\" aria-label=\"time of {0}\"> "
      "<output></output></p>\n<script type=\"application/json\">{1}</script>",
      escaped(in_words(problem)), as_script(data));
}

/// Quantities over time, with a line at the time that is shown.
std::string strips_html(const std::string& problem, const std::vector<const ReportedMotion*>& motions,
                        const std::string& title) {
  const Strips strips = strips_of(motions);
  if (strips.count == 0) return "";
  const double bottom = strips.bottom() + 4.0;
  Json data = data_of(strips.motions);
  data["cursor"] = {{"width", Strips::width}, {"height", bottom}};
  return fmt::format(
             "<svg role=\"img\" aria-label=\"{}\" viewBox=\"-4 0 {:.0f} {:.0f}\" data-radius=\"3.5\">{}</svg>\n",
             escaped(title), Strips::width + 8.0, bottom, strips.svg) +
         controls_html(problem, data);
}

/// The legend of the lines, where there are several.
std::string legend_of(const std::vector<const ReportedMotion*>& motions) {
  std::string html;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (!motions[i]->method.empty()) {
      html +=
          fmt::format("<span class=\"legend method-{}\">{}</span> ", i, escaped(method_in_words(motions[i]->method)));
    }
  }
  return html;
}

}  // namespace

std::string motion_picture_html(const std::string& problem, const std::vector<const ReportedMotion*>& motions) {
  std::vector<const ReportedMotion*> shown;
  std::ranges::copy_if(motions, std::back_inserter(shown),
                       [](const ReportedMotion* motion) { return motion->picture.rows().size() >= 2; });
  if (shown.empty()) return "";
  const std::string title = in_words(problem) + ", its motion";
  const std::string begin = fmt::format(R"(<figure class="motion" id="{}">)", anchor("motion", problem));
  const std::string end = fmt::format("<figcaption>{}{}</figcaption></figure>\n", escaped(in_words(problem)),
                                      legend_of(shown).empty() ? "" : " by " + legend_of(shown));
  std::vector<DrawnMotion> drawn;
  for (const ReportedMotion* motion : shown) {
    const std::string time = motion->picture.columns().front();
    DrawnMotion next{motion->method, name_and_unit(time).second, column_of(motion->picture, time),
                     points_of(motion->picture)};
    if (!next.points.empty()) drawn.push_back(std::move(next));
  }
  const std::string picture = drawn.size() < shown.size()
                                  ? strips_html(problem, shown, title)
                                  : drawing_of(drawn, title) + controls_html(problem, data_of(drawn));
  return begin + picture + end;
}

}  // namespace dmocbench
