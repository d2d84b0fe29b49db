#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"

namespace dmocbench {

namespace {

/// Replaces every `from` by `to`.
void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// Takes the text between two marks out, marks and all, as often as it is there.
void remove_between(std::string& text, const std::string& begin, const std::string& end) {
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    const std::size_t behind = text.find(end, at + begin.size());
    if (behind == std::string::npos) return;
    text.erase(at, behind + end.size() - at);
  }
}

/// A picture as part of a page: without the lines of a file of its own, and with names that no other picture has.
std::string as_part_of_page(const ReportedFigure& figure, const std::string& title) {
  std::string svg = figure.svg;
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) return "";
  svg.erase(0, begin);
  remove_between(svg, "<title>", "</title>");
  remove_between(svg, "<desc>", "</desc>");
  remove_between(svg, "<!--", "-->");
  remove_between(svg, " id=\"gnuplot_plot_", "\"");
  const std::string prefix = anchor("s", figure.name) + "-";
  for (const std::string quote : {"'", "\""}) {
    replace_all(svg, " id=" + quote, " id=" + quote + prefix);
    replace_all(svg, "href=" + quote + "#", "href=" + quote + "#" + prefix);
  }
  replace_all(svg, "url(#", "url(#" + prefix);
  replace_all(svg, "xlink:href", "href");
  replace_all(svg, "<svg", fmt::format("<svg role=\"img\" aria-label=\"{}\"", escaped(title)));
  std::string packed;  // blanks and ends of lines as one, between elements none
  for (const char letter : svg) {
    const bool is_blank = letter == ' ' || letter == '\n' || letter == '\t' || letter == '\r';
    if (!is_blank) {
      packed += letter;
    } else if (!packed.empty() && packed.back() != ' ' && packed.back() != '\n') {
      packed += letter == ' ' ? ' ' : '\n';
    }
  }
  return packed;
}

}  // namespace

std::string figures_section(const ResultsFolder& results) {
  if (results.figures.empty()) return "";
  std::string html =
      "<section id=\"figures\"><h2>Figures</h2>\n<p>Each says in its own lines what it is drawn from.</p>\n";
  for (const ReportedFigure& figure : results.figures) {
    const std::string title = in_words(figure.name);
    html += fmt::format("<figure id=\"{}\">{}<figcaption>{}</figcaption></figure>\n", anchor("figure", figure.name),
                        as_part_of_page(figure, title), escaped(title));
  }
  return html + "</section>\n";
}

}  // namespace dmocbench
