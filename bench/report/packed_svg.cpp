#include "bench/report/packed_svg.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "methods/runtime/parsed.hpp"

namespace dmocbench {

namespace {

constexpr std::string_view blanks = " \n\t\r";

/// Reads a text from its begin: words, numbers, single letters.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}
  [[nodiscard]] bool is_at_end() {
    skip(" \n\t\r,");
    return rest_.empty();
  }
  [[nodiscard]] bool has_letter() const {
    return (rest_.front() >= 'A' && rest_.front() <= 'Z') || rest_.front() == 'z';
  }
  char letter() {
    const char first = rest_.front();
    rest_.remove_prefix(1);
    return first;
  }
  std::optional<double> number() {
    skip(" \n\t\r,");
    const std::string_view digits = rest_.substr(0, rest_.find_first_not_of("+-.0123456789"));
    rest_.remove_prefix(digits.size());
    return parsed<double>(digits);
  }

 private:
  void skip(std::string_view letters) { rest_.remove_prefix(std::min(rest_.find_first_not_of(letters), rest_.size())); }
  std::string_view rest_;
};

/// "93.5", ".5", "-4" of 935, 5, -40 tenths.
std::string in_tenths(long tenths) {
  const long size = std::abs(tenths);
  std::string text = tenths < 0 ? "-" : "";
  if (size >= 10 || size % 10 == 0) text += std::to_string(size / 10);
  if (size % 10 != 0) text += fmt::format(".{}", size % 10);
  return text;
}

/// Writes a path by differences, without the letters that SVG lets one leave out.
class PathWriter {
 public:
  void move_to(long x, long y) {
    if (text_.empty()) {
      add('M', {x, y});
    } else {
      add('m', {x - x_, y - y_});
    }
    x_ = x;
    y_ = y;
  }
  void line_to(long x, long y) {
    if (x == x_ && y != y_) {
      add('v', {y - y_});
    } else if (y == y_) {
      add('h', {x - x_});
    } else {
      add('l', {x - x_, y - y_});
    }
    x_ = x;
    y_ = y;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void add(char letter, std::initializer_list<long> tenths) {
    const bool is_implied = (letter == last_ && letter != 'm') || (letter == 'l' && last_ == 'm');
    if (!is_implied) text_ += letter;
    bool is_first = !is_implied;
    for (const long number : tenths) {
      const std::string digits = in_tenths(number);
      if (!is_first && digits.front() != '-') text_ += ' ';
      text_ += digits;
      is_first = false;
    }
    last_ = letter;
  }

  std::string text_;
  char last_ = ' ';
  long x_ = 0;
  long y_ = 0;
};

/// A path of M and L by differences; nothing if there is anything else in it.
std::optional<std::string> packed_path(std::string_view path) {
  PathWriter writer;
  Reader reader(path);
  char command = ' ';
  while (!reader.is_at_end()) {
    if (reader.has_letter()) command = reader.letter();
    const auto x = reader.number();
    const auto y = reader.number();
    if (!x || !y || (command != 'M' && command != 'L')) return std::nullopt;
    const long column = std::lround(10.0 * *x);
    const long line = std::lround(10.0 * *y);
    if (command == 'M') {
      writer.move_to(column, line);
      command = 'L';
    } else {
      writer.line_to(column, line);
    }
  }
  return writer.text();
}

/// What an attribute of a tag says; empty if it has none of that name.
std::string_view attribute(std::string_view tag, std::string_view name) {
  for (const char quote : {'\'', '"'}) {
    const std::string begin = fmt::format(" {}={}", name, quote);
    const std::size_t at = tag.find(begin);
    if (at == std::string_view::npos) continue;
    const std::size_t value = at + begin.size();
    return tag.substr(value, tag.find(quote, value) - value);
  }
  return {};
}

/// "#0072b2" of "rgb(  0, 114, 178)", wherever that stands.
std::string with_short_colours(const std::string& svg) {
  std::string result;
  std::size_t begin = 0;
  for (std::size_t at = svg.find("rgb("); at != std::string::npos; at = svg.find("rgb(", at + 1)) {
    const std::size_t end = svg.find(')', at);
    if (end == std::string::npos) break;
    Reader reader(std::string_view(svg).substr(at + 4, end - at - 4));
    const auto red = reader.number();
    const auto green = reader.number();
    const auto blue = reader.number();
    if (!red || !green || !blue || !reader.is_at_end()) continue;
    result.append(svg, begin, at - begin);
    result +=
        fmt::format("#{:02x}{:02x}{:02x}", static_cast<int>(*red), static_cast<int>(*green), static_cast<int>(*blue));
    begin = end + 1;
  }
  return result.append(svg, begin);
}

/// Empty <tspan> at the end of a text move nothing.
void remove_empty_ends(std::string& svg) {
  constexpr std::string_view end = "></tspan></text>";
  for (std::size_t at = svg.find(end); at != std::string::npos; at = svg.find(end, at)) {
    const std::size_t begin = svg.rfind('<', at);
    if (svg.compare(begin, 6, "<tspan") == 0) {
      svg.erase(begin, at + end.size() - std::string_view("</text>").size() - begin);
      at = begin;
    } else {
      ++at;
    }
  }
}

std::string packed_line(std::string_view tag) {
  const std::string_view path = attribute(tag, "d");
  const auto packed = attribute(tag, "id").empty() ? packed_path(path) : std::nullopt;
  if (!packed || path.empty()) return std::string(tag);
  const auto begin = static_cast<std::size_t>(path.data() - tag.data());
  return fmt::format("{}{}{}", tag.substr(0, begin), *packed, tag.substr(begin + path.size()));
}

/// Marks that follow each other in one colour share a group.
class MarkGroups {
 public:
  explicit MarkGroups(std::string& svg) : svg_(svg) {}
  void add(std::string_view tag) {
    const std::string_view colour = attribute(tag, "color");
    if (colour != colour_) {
      end();
      svg_ += fmt::format("<g color='{}'>", colour);
      colour_ = colour;
    }
    std::string place(attribute(tag, "transform"));
    if (const std::size_t blank = place.find(") "); blank != std::string::npos) place.erase(blank + 1, 1);
    svg_ += fmt::format("<use xlink:href='{}' transform='{}'/>", attribute(tag, "xlink:href"), place);
  }
  void end() {
    if (!colour_.empty()) svg_ += "</g>";
    colour_.clear();
  }

 private:
  std::string& svg_;
  std::string colour_;  // of the group that is open; empty if none is
};

}  // namespace

std::string packed_svg(const std::string& picture) {
  std::string svg = with_short_colours(picture);
  remove_empty_ends(svg);
  std::string result;
  MarkGroups marks(result);
  for (std::size_t begin = 0; begin < svg.size();) {
    const std::size_t open = std::min(svg.find('<', begin), svg.size());
    const std::string_view between = std::string_view(svg).substr(begin, open - begin);
    const std::size_t end = std::min(svg.find('>', open), svg.size() - 1) + 1;
    const std::string_view tag = std::string_view(svg).substr(open, end - open);
    const bool is_mark = tag.starts_with("<use ") && !attribute(tag, "color").empty() &&
                         !attribute(tag, "xlink:href").empty() && attribute(tag, "id").empty();
    if (!is_mark || between.find_first_not_of(blanks) != std::string_view::npos) {
      marks.end();
      result += between;
    }
    if (is_mark) {
      marks.add(tag);
    } else {
      result += tag.starts_with("<path ") ? packed_line(tag) : std::string(tag);
    }
    begin = std::max(end, open);
    if (open == svg.size()) break;
  }
  marks.end();
  return result;
}

}  // namespace dmocbench
