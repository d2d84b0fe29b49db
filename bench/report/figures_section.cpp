#include <string>

#include <fmt/format.h>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"

namespace dmocbench {

std::string figures_section(const ResultsFolder& results) {
  if (results.figures.empty()) return "";
  std::string html =
      "<section id=\"figures\"><h2>Figures</h2>\n<p>Each says in its own lines what it is drawn from.</p>\n";
  for (const ReportedFigure& figure : results.figures) {
    // Browsers run no script of an image and fetch nothing for it, so any SVG may stand there.
    html += fmt::format(
        "<figure id=\"{0}\"><img alt=\"{1}\" src=\"data:image/svg+xml;base64,{2}\"><figcaption>{1}</figcaption>"
        "</figure>\n",
        anchor("figure", figure.name), escaped(in_words(figure.name)), base64(figure.svg));
  }
  return html + "</section>\n";
}

}  // namespace dmocbench
