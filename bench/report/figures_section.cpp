#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/report/answers.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

namespace {

/// The section of the paper whose claims name a figure as evidence; empty if no claim of the paper does.
std::string paper_section_of(const std::string& figure, const Table& claims) {
  for (const Row& claim : claims.rows()) {
    const bool is_of_paper = claim.text("whose") == "paper" || claim.text("whose") == "remark";
    if (is_of_paper && claim.text("evidence").find("figures/" + figure + ".svg") != std::string::npos)
      return section_of(claim);
  }
  return "";
}

/// "momentum" of "two_link_manipulator_momentum": the name without the longest problem that it begins with.
std::string kind_of(const std::string& figure) {
  std::size_t length = 0;
  for (const std::string& problem : problem_names()) {
    if (figure.starts_with(problem + "_")) length = std::max(length, problem.size() + 1);
  }
  return figure.substr(length);
}

using Group = std::vector<const ReportedFigure*>;

/// "The paper, section 4.2.1", ..., then a group per kind of figure.
std::vector<std::pair<std::string, Group>> groups_of(const ResultsFolder& results) {
  std::map<std::string, Group> of_paper;
  std::map<std::string, Group> others;
  for (const ReportedFigure& figure : results.figures) {
    const std::string section = paper_section_of(figure.name, results.claims);
    (section.empty() ? others[in_words(kind_of(figure.name))] : of_paper["The paper, " + section]).push_back(&figure);
  }
  std::vector<std::pair<std::string, Group>> groups(of_paper.begin(), of_paper.end());
  groups.insert(groups.end(), others.begin(), others.end());
  return groups;
}

}  // namespace

std::string figures_section(const ResultsFolder& results) {
  if (results.figures.empty()) return "";
  std::string index;
  std::string figures;
  for (const auto& [title, group] : groups_of(results)) {
    index += fmt::format("<dt>{}<dd>", escaped(title));
    figures += fmt::format("<h3>{}</h3>\n", escaped(title));
    for (const ReportedFigure* const figure : group) {
      const std::string id = anchor("figure", figure->name);
      const std::string name = escaped(in_words(figure->name));
      index += fmt::format("<a href=\"#{}\">{}</a> ", id, name);
      // Browsers neither run scripts of an image nor fetch files for it, so any SVG is safe here.
      figures += fmt::format(
          "<figure id=\"{0}\"><img alt=\"{1}\" src=\"data:image/svg+xml;base64,{2}\"><figcaption>{1}</figcaption>"
          "</figure>\n",
          id, name, base64(figure->svg));
    }
    index += "\n";
  }
  return "<section id=\"figures\"><h2>Figures</h2>\n<p>Each figure names its tables, reference and tolerance below its "
         "title.</p>\n<details class=\"index\"><summary>Index of figures</summary><dl>\n" +
         index + "</dl></details>\n" + figures + "</section>\n";
}

}  // namespace dmocbench
