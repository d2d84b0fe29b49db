#include "bench/report/figure_markup.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "bench/report/html.hpp"
#include "bench/report/packed_svg.hpp"

namespace dmocbench {

namespace {

/// Replaces every `from` by `to`.
void replace_all(std::string& text, std::string_view from, std::string_view to) {
  std::string replaced;
  std::size_t begin = 0;
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, begin)) {
    replaced.append(text, begin, at - begin).append(to);
    begin = at + from.size();
  }
  if (begin > 0) text = replaced.append(text, begin);
}

/// Takes the text between two marks out, marks and all, as often as it is there.
void remove_between(std::string& text, std::string_view begin, std::string_view end) {
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    const std::size_t behind = text.find(end, at + begin.size());
    if (behind == std::string::npos) return;
    text.erase(at, behind + end.size() - at);
  }
}

bool is_blank(char letter) { return letter == ' ' || letter == '\n' || letter == '\t' || letter == '\r'; }

/// Blanks and ends of lines as one.
std::string without_blanks(const std::string& svg) {
  std::string packed;
  for (const char letter : svg) {
    if (!is_blank(letter)) {
      packed += letter;
    } else if (!packed.empty() && packed.back() != ' ' && packed.back() != '\n') {
      packed += letter == ' ' ? ' ' : '\n';
    }
  }
  return packed;
}

/// Where the tag `<g ...>` begins with which a text ends; the end of the text if it does not end with one.
std::size_t begin_of_open_group(const std::string& text) {
  std::size_t end = text.size();
  while (end > 0 && is_blank(text[end - 1])) --end;
  if (end == 0 || text[end - 1] != '>') return text.size();
  const std::size_t begin = text.rfind('<', end - 1);
  const bool is_group = begin != std::string::npos && text.compare(begin, 2, "<g") == 0 &&
                        (is_blank(text[begin + 2]) || text[begin + 2] == '>');
  return is_group ? begin : text.size();
}

std::string without_empty_groups(const std::string& svg) {
  constexpr std::string_view closing = "</g>";
  std::string result;
  std::size_t begin = 0;
  for (std::size_t at = svg.find(closing); at != std::string::npos; at = svg.find(closing, begin)) {
    result.append(svg, begin, at - begin);
    begin = at + closing.size();
    const std::size_t group = begin_of_open_group(result);
    if (group < result.size()) {
      result.erase(group);
    } else {
      result.append(closing);
    }
  }
  return result.append(svg, begin);
}

/// Marks that gnuplot defines in every picture and nobody refers to. Later ones refer to earlier ones.
void remove_unused_marks(std::string& svg) {
  std::vector<std::string> names{"textbox", "greybox", "gpDot"};
  for (int i = 0; i <= 14; ++i) names.push_back(fmt::format("gpPt{}", i));
  std::ranges::reverse(names);
  for (const std::string& name : names) {
    if (svg.find(fmt::format("#{}'", name)) != std::string::npos ||
        svg.find(fmt::format("#{})", name)) != std::string::npos)
      continue;
    const std::size_t id = svg.find(fmt::format(" id='{}'", name));
    if (id == std::string::npos) continue;
    const std::size_t begin = svg.rfind('<', id);
    const bool is_filter = svg.compare(begin, 7, "<filter") == 0;
    const std::string_view end = is_filter ? "</filter>" : "/>";
    const std::size_t behind = svg.find(end, id);
    if (behind != std::string::npos) svg.erase(begin, behind + end.size() - begin);
  }
}

/// "93.47" as "93.5" in attributes, where two digits or more stand before the point: a tenth of a pixel is enough.
std::string with_short_numbers(const std::string& svg) {
  const auto is_digit = [](char letter) { return letter >= '0' && letter <= '9'; };
  std::string result;
  bool is_tag = false;
  for (std::size_t i = 0; i < svg.size();) {
    is_tag = svg[i] == '<' || (is_tag && svg[i] != '>');
    std::size_t end = i;
    while (end < svg.size() && (is_digit(svg[end]) || (svg[end] == '.' && end > i))) ++end;
    const std::string_view number = std::string_view(svg).substr(i, end - i);
    const std::size_t point = number.find('.');
    if (is_tag && point != std::string_view::npos && point >= 2 && number.size() == point + 3) {
      std::string tenths = fmt::format("{:.1f}", std::stod(std::string(number)));
      if (tenths.ends_with(".0")) tenths.resize(tenths.size() - 2);
      result += tenths;
      i = end;
    } else {
      const std::size_t taken = std::max<std::size_t>(end - i, 1);
      result.append(svg, i, taken);
      i += taken;
    }
  }
  return result;
}

}  // namespace

std::string figure_markup(const std::string& file, const std::string& prefix, const std::string& title) {
  const std::size_t begin = file.find("<svg");
  if (begin == std::string::npos) return "";
  std::string svg = file.substr(begin);
  remove_between(svg, "<title>", "</title>");
  remove_between(svg, "<desc>", "</desc>");
  remove_between(svg, "<!--", "-->");
  remove_between(svg, " id=\"gnuplot_plot_", "\"");
  remove_unused_marks(svg);
  svg = without_blanks(svg);
  for (const char* const said_by_style : {R"( font-family="sans-serif")", R"( xml:space="preserve")",
                                          R"( stroke-linecap="butt" stroke-linejoin="miter")"})
    replace_all(svg, said_by_style, "");
  svg = with_short_numbers(packed_svg(without_empty_groups(svg)));
  replace_all(svg, "gpPt", "p");
  replace_all(svg, R"(<g fill="none" color="black" stroke="currentColor" stroke-width="1.00">)", R"(<g class="k">)");
  replace_all(svg, R"(<g fill="none" color="gray" stroke="currentColor" stroke-width="1.00">)", R"(<g class="y">)");
  replace_all(svg, R"( stroke="none" fill="#202020")", R"( class="t")");
  replace_all(svg, R"( stroke="none" fill="black")", R"( class="b")");
  for (const std::string quote : {"'", "\""}) {
    replace_all(svg, " id=" + quote, fmt::format(" id={}{}", quote, prefix));
    replace_all(svg, fmt::format("href={}#", quote), fmt::format("href={}#{}", quote, prefix));
  }
  replace_all(svg, "url(#", "url(#" + prefix);
  replace_all(svg, "xlink:href", "href");
  replace_all(svg, "<svg", fmt::format(R"(<svg role="img" aria-label="{}")", escaped(title)));
  return svg;
}

}  // namespace dmocbench
