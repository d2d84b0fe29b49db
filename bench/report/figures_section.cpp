#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "bench/report/figure_markup.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"

namespace dmocbench {

std::string figures_section(const ResultsFolder& results) {
  if (results.figures.empty()) return "";
  std::string html =
      "<section id=\"figures\"><h2>Figures</h2>\n<p>Each says in its own lines what it is drawn from.</p>\n";
  for (std::size_t i = 0; i < results.figures.size(); ++i) {
    const ReportedFigure& figure = results.figures[i];
    const std::string title = in_words(figure.name);
    html += fmt::format("<figure id=\"{}\">{}<figcaption>{}</figcaption></figure>\n", anchor("figure", figure.name),
                        figure_markup(figure.svg, fmt::format("f{}-", i), title), escaped(title));
  }
  return html + "</section>\n";
}

}  // namespace dmocbench
