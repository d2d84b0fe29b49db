#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "bench/report/html.hpp"
#include "bench/report/motion_picture.hpp"
#include "bench/report/reached_optima.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/statement.hpp"
#include "methods/runtime/counted.hpp"
#include "problems/problem_registry.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

namespace {

/// One motion per method.
std::vector<const ReportedMotion*> motions_of(const ResultsFolder& results, const std::string& problem) {
  std::vector<const ReportedMotion*> motions;
  for (const ReportedMotion& motion : results.motions) {
    const auto has_method = [&motion](const ReportedMotion* other) { return other->method == motion.method; };
    if (motion.problem == problem && std::ranges::none_of(motions, has_method)) motions.push_back(&motion);
  }
  return motions;
}

std::string optimum_html(const ProblemCard& card, const std::optional<double>& lowest) {
  if (card.reference) {
    const ReferenceOptimum& reference = *card.reference;
    std::string html = fmt::format("<dt>Optimum<dd>{:#.{}g}, {} digits: {}\n", reference.objective, reference.digits,
                                   reference.digits, escaped(reference.certificate));
    for (const PublishedOptimum& published : reference.published)
      html += fmt::format("<dt>Published<dd>{:.12g}, {}\n", published.objective, escaped(published.source));
    return html;
  }
  if (lowest) return fmt::format("<dt>Optimum<dd>not known; best found by any method here: {:.8g}\n", *lowest);
  return "<dt>Optimum<dd>not known\n";
}

std::string reached_html(const std::vector<ReachedOptimum>& methods, const std::string& problem) {
  if (methods.empty()) return "<p>No run in this folder solves this statement of the problem.</p>\n";
  std::string html = fmt::format(
      "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"methods on {}\"><table><thead><tr><th "
      "scope=\"col\">method<th scope=\"col\">solves<th scope=\"col\">solved<th scope=\"col\">within 1 %<th "
      "scope=\"col\">smallest difference</thead><tbody>\n",
      escaped(in_words(problem)));
  for (const ReachedOptimum& reached : methods) {
    html += fmt::format("<tr{}><td>{}<td>{}<td>{}<td>{}<td>{}\n", reached.near == 0 ? " class=\"unsolved\"" : "",
                        escaped(method_in_words(reached.method)), reached.rows, reached.solved, reached.near,
                        reached.smallest_difference ? fmt::format("{:.2g}", *reached.smallest_difference) : "");
  }
  return html + "</tbody></table></div>\n";
}

std::string problem_html(const Problem& problem, const ResultsFolder& results) {
  const std::string name = problem.name();
  const ProblemCard card = problem.card();
  const auto lowest = lowest_cost(results, name);
  std::string html = fmt::format("<article id=\"{}\"><h3>{}</h3>\n<p>{}</p>\n", anchor("problem", name),
                                 escaped(in_words(name)), escaped(card.description));
  html += motion_picture_html(name, motions_of(results, name));
  // A formula may be wider than the page: all of them scroll together, by keyboard too.
  html +=
      fmt::format("<div class=\"statement\" role=\"region\" tabindex=\"0\" aria-label=\"statement of {}\">\n{}</div>\n",
                  escaped(in_words(name)), statement_html(problem));
  html += "<dl>\n" + optimum_html(card, lowest);
  if (!card.source.empty()) html += fmt::format("<dt>Source<dd>{}\n", escaped(card.source));
  html += "</dl>\n";
  const std::optional<double> optimum = card.reference ? card.reference->objective : lowest;
  return html + reached_html(optimum ? reached_optima(results, name, *optimum) : std::vector<ReachedOptimum>(), name) +
         "</article>\n";
}

/// The motions of problems unknown to this program, such as problems of a library that was not loaded.
std::string unknown_motions(const ResultsFolder& results, const std::vector<std::string>& known) {
  std::set<std::string> names;
  for (const ReportedMotion& motion : results.motions) names.insert(motion.problem);
  std::string html;
  for (const std::string& name : names) {
    if (std::ranges::count(known, name) == 0) html += motion_picture_html(name, motions_of(results, name));
  }
  return html;
}

}  // namespace

std::string gallery_section(const ResultsFolder& results) {
  if (results.motions.empty()) return "";
  std::string html =
      "<section id=\"gallery\"><h2>Gallery</h2>\n<p>Statements of the problems of this folder, in the units in which "
      "they are solved, with the motions found. A method reaches an optimum if its cost is within 1 %; other minima "
      "and coarse grids are farther away.</p>\n";
  std::vector<std::string> names = problem_names();
  html += unknown_motions(results, names);
  const auto others = std::erase_if(names, [&results](const std::string& name) {
    return motions_of(results, name).empty() && !lowest_cost(results, name);
  });
  for (const std::string& name : names) html += problem_html(*make_problem(name), results);
  if (others > 0)
    html += fmt::format("<p>Not solved in this folder: {} of the library.</p>\n", counted(others, "problem"));
  return html + "</section>\n";
}

}  // namespace dmocbench
