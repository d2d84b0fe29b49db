#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "methods/tables/motion_file.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// A point of a picture: the columns of its coordinates and its name.
struct MovingPoint {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
};

std::vector<double> column_of(const Table& table, const std::string& column) {
  std::vector<double> values;
  for (const Row& row : table.rows()) values.push_back(row.number(column, std::nan("")));
  return values;
}

/// The points whose two coordinates are columns with one unit, that of the first point.
std::vector<MovingPoint> points_of(const Table& picture) {
  std::vector<MovingPoint> points;
  std::optional<std::string> length;
  for (const std::string& column : picture.columns()) {
    const auto [name, unit] = name_and_unit(column);
    if (name != "x" && !name.ends_with("_x")) continue;
    std::string partner = column;
    partner[name.size() - 1] = 'y';
    if (std::ranges::count(picture.columns(), partner) == 0 || length.value_or(unit) != unit) continue;
    length = unit;
    const std::string stem = name == "x" ? "" : name.substr(0, name.size() - 2);
    points.push_back({stem, column_of(picture, column), column_of(picture, partner)});
  }
  return points;
}

/// True if a point keeps its distance from another (the origin if there is none) all the time: there is a rod.
bool is_rod(const MovingPoint* from, const MovingPoint& to) {
  double least = INFINITY;
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

Json data_of(const ReportedMotion& motion, const std::vector<MovingPoint>& points) {
  const std::string time = motion.picture.columns().front();
  Json data{{"unit", name_and_unit(time).second}, {"t", column_of(motion.picture, time)}, {"points", Json::array()}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const MovingPoint* const before = i == 0 ? nullptr : &points[i - 1];
    data["points"].push_back(
        {{"name", points[i].name}, {"x", points[i].x}, {"y", points[i].y}, {"rod", is_rod(before, points[i])}});
  }
  return data;
}

/// JSON that ends no element of the page, whatever a name holds.
std::string as_script(const Json& data) {
  std::string text = data.dump(-1, ' ', true, Json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

std::string motion_html(const ReportedMotion& motion) {
  const std::vector<MovingPoint> points = points_of(motion.picture);
  if (points.empty() || motion.picture.rows().size() < 2) return "";
  const std::string by_whom = motion.method.empty() ? "" : " by " + motion.method;
  const std::string id = anchor("motion", motion.problem);
  return fmt::format(
      "<figure class=\"motion\" id=\"{0}\"><svg role=\"img\" aria-label=\"{1}{2}\"></svg>\n<p "
      "class=\"controls\"><button "
      "type=\"button\">Play</button> <input type=\"range\" min=\"0\" max=\"1000\" value=\"0\" aria-label=\"time\"> "
      "<output></output></p>\n<figcaption>{1}{2}</figcaption><script type=\"application/json\">{3}</script></figure>\n",
      id, escaped(in_words(motion.problem)), escaped(by_whom), as_script(data_of(motion, points)));
}

}  // namespace

std::string motions_section(const ResultsFolder& results) {
  std::string html;
  for (const ReportedMotion& motion : results.motions) html += motion_html(motion);
  if (html.empty()) return "";
  return "<section id=\"motions\" hidden><h2>Motions</h2>\n" + html + "</section>\n";
}

}  // namespace dmocbench
