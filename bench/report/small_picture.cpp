#include "bench/report/small_picture.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "bench/report/words.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;
using Scale = std::function<double(double)>;

double pixel(double value) { return std::round(10.0 * value) / 10.0; }

/// From low .. high to pixels.
Scale linear(double low, double high, double from, double to) {
  const double size = high > low ? high - low : 1.0;
  return [=](double value) { return pixel(from + (value - low) / size * (to - from)); };
}

/// The same over the logarithms.
Scale logarithmic(double low, double high, double from, double to) {
  const Scale scale = linear(std::log(low), std::log(high), from, to);
  return [scale](double value) { return scale(std::log(value)); };
}

/// Two powers of ten from low to high, and the one in the middle.
std::vector<double> decades(double low, double high) {
  const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  std::vector<double> powers;
  for (int power = first; power <= last; ++power) {
    if (power == first || power == last || 2 * power == first + last) powers.push_back(std::pow(10.0, power));
  }
  return powers;
}

/// Whether two curves look like one in the picture.
bool coincide(const MethodCurve& a, const MethodCurve& b, const Scale& y) {
  constexpr double nothing = 1.0;
  return a.points.size() == b.points.size() &&
         std::ranges::equal(a.points, b.points, [&](const auto& p, const auto& q) {
           return p.first == q.first && std::abs(y(p.second) - y(q.second)) <= nothing;
         });
}

/// Names at the ends of the curves, below each other where the curves meet.
Json names_at_ends(const std::vector<MethodCurve>& curves, const Scale& y, double left) {
  constexpr double pitch = 11.5;
  constexpr double lowest = picture_height - 4.0;
  std::vector<std::pair<double, std::string>> names;  // place from above, method
  for (const MethodCurve& curve : curves) names.emplace_back(y(curve.points.back().second) + 4.0, curve.method);
  const bool are_equal = curves.size() > 1 && coincide(curves[0], curves[1], y);
  if (are_equal) names[1].first = names[0].first + 0.1;
  std::ranges::sort(names);
  double below = lowest + pitch;
  for (auto name = names.rbegin(); name != names.rend(); ++name)
    below = name->first = std::min(name->first, below - pitch);
  double above = -pitch;
  for (auto& name : names) above = name.first = std::max(name.first, above + pitch);
  Json labels = Json::array();
  for (const auto& [place, method] : names) {
    const bool has_equal = are_equal && method == curves.front().method;
    labels.push_back({{"classes", method}, {"text", short_name(method) + (has_equal ? " =" : "")}, {"x", left}});
    labels.back()["y"] = pixel(place);
  }
  return labels;
}

/// A line of a picture with bars, from above.
struct BarLine {
  double y;
  explicit BarLine(std::size_t i) : y(22.0 + 25.0 * static_cast<double>(i)) {}
  [[nodiscard]] Json of(const std::string& method) const {
    return {{"method", method}, {"name", method == "tangent" ? "tangent" : short_name(method)},
            {"x", left},        {"y", y},
            {"ty", y + 12.0},   {"my", y + 8.0}};
  }
  static constexpr double left = 98.0;
  static constexpr double room = picture_width - left - 46.0;  // numbers stand right of the bars
};

}  // namespace

std::string short_name(const std::string& method) {
  return method == "dmoc"          ? "DMOC"
         : method == "hamiltonian" ? "Hamiltonian"
         : method == "tangent"     ? "tangent-space"
                                   : in_words(method);
}

PageModel curves_picture(const std::string& caption, const std::vector<MethodCurve>& curves) {
  constexpr double left = 32.0;
  constexpr double right = 174.0;
  constexpr double base = picture_height - 15.0;
  std::vector<MethodCurve> drawn = curves;
  std::set<double> xs;
  std::set<double> ys;
  for (MethodCurve& curve : drawn) {
    std::erase_if(curve.points, [](const auto& point) { return !(point.first > 0.0) || !(point.second > 0.0); });
    for (const auto& [x, y] : curve.points) {
      xs.insert(x);
      ys.insert(y);
    }
  }
  std::erase_if(drawn, [](const MethodCurve& curve) { return curve.points.empty(); });
  if (xs.size() < 2 || ys.size() < 2) return {};
  const Scale x = logarithmic(*xs.begin(), *xs.rbegin(), left + 6.0, right - 6.0);
  const Scale y = logarithmic(*ys.begin(), *ys.rbegin(), base - 3.0, 20.0);
  Json picture{{"w", picture_width}, {"h", picture_height}, {"caption", caption}, {"left", left}, {"right", right}};
  for (const double value : decades(*ys.begin(), *ys.rbegin()))
    picture["yticks"].push_back({{"y", y(value)}, {"ty", y(value) + 3.5}, {"tx", left - 4.0}, {"text", tick(value)}});
  const double middle = *std::next(xs.begin(), static_cast<std::ptrdiff_t>(xs.size() / 2));
  for (const double value : std::set<double>{*xs.begin(), middle, *xs.rbegin()})
    picture["xticks"].push_back({{"x", x(value)}, {"ty", picture_height - 3.0}, {"text", tick(value)}});
  for (const MethodCurve& curve : drawn) {
    Json marks = Json::array();
    std::string points;
    for (const auto& point : curve.points) {
      marks.push_back({{"method", curve.method}, {"x", x(point.first)}, {"y", y(point.second)}});
      points += fmt::format("{},{} ", x(point.first), y(point.second));
    }
    picture["series"].push_back({{"method", curve.method}, {"points", points}, {"marks", marks}});
  }
  picture["labels"] = names_at_ends(drawn, y, right + 6.0);
  return {{"curves", picture}};
}

PageModel bars_picture(const std::string& caption, const std::vector<std::pair<std::string, double>>& bars) {
  if (bars.empty()) return {};
  const double most = std::ranges::max_element(bars, {}, &std::pair<std::string, double>::second)->second;
  Json items = Json::array();
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const auto& [method, value] = bars[i];
    const double width = pixel(BarLine::room * value / most);
    items.push_back(BarLine(i).of(method));
    items.back().update({{"width", width},
                         {"tx", BarLine::left + width + 6.0},
                         {"text", value == 1.0 ? "1" : fmt::format("{:.2f}", value)}});
  }
  return {{"bars",
           {{"w", picture_width},
            {"h", picture_height},
            {"caption", caption},
            {"left", BarLine::left},
            {"top", 19.0},
            {"base", BarLine(bars.size()).y - 6.0},
            {"items", items}}}};
}

PageModel intervals_picture(const std::string& caption, const std::vector<IntervalLine>& lines) {
  constexpr double left = 84.0;
  constexpr double first = 34.0;
  constexpr double top = 22.0;
  constexpr double base = picture_height - 14.0;
  double low = 1.0;
  double high = 1.0;
  for (const IntervalLine& line : lines) {
    for (const MethodInterval& interval : line.intervals) {
      low = std::min(low, interval.lower);
      high = std::max(high, interval.upper);
    }
  }
  const double room = 0.05 * (high - low);
  const Scale x = linear(low - room, high + room, left, picture_width - 12.0);
  Json picture{{"w", picture_width}, {"h", picture_height}, {"caption", caption},    {"one", x(1.0)},
               {"top", top},         {"base", base},        {"lines", Json::array()}};
  double step = 0.5;
  constexpr double most_steps = 4.0;
  while (high - low > most_steps * step) step *= 2.0;
  for (double value = std::ceil(low / step) * step; value < high + room; value += step)
    if (value != 1.0)
      picture["ticks"].push_back({{"x", x(value)}, {"ty", picture_height - 3.0}, {"text", tick(value)}});
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double middle = first + 21.0 * static_cast<double>(i);
    Json marks = Json::array();
    for (const MethodInterval& interval : lines[i].intervals) {
      marks.push_back({{"method", interval.method}, {"x", x(interval.value)}, {"x1", x(interval.lower)}});
      marks.back().update({{"x2", x(interval.upper)}, {"y", middle + (marks.size() == 1 ? -3.5 : 4.5)}});
    }
    picture["lines"].push_back({{"name", lines[i].name}, {"ty", middle + 4.0}, {"marks", marks}});
  }
  return {{"intervals", picture}};
}

PageModel shares_picture(const std::string& caption, const std::vector<MethodShares>& shares) {
  Json items = Json::array();
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const MethodShares& own = shares[i];
    const double best = pixel(BarLine::room * own.best / own.all);
    items.push_back(BarLine(i).of(own.method));
    items.back().update({{"full", BarLine::room},
                         {"best", best},
                         {"x2", BarLine::left + best},
                         {"other", pixel(BarLine::room * own.other / own.all)},
                         {"tx", picture_width - 40.0},
                         {"text", fmt::format("{:.0f} %", 100.0 * (own.best + own.other) / own.all)}});
  }
  return {{"shares", {{"w", picture_width}, {"h", picture_height}, {"caption", caption}, {"items", items}}}};
}

}  // namespace dmocbench
