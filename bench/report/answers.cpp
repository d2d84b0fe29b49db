#include "bench/report/answers.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/report/html.hpp"

namespace dmocbench {

namespace {

/// A question about the methods, by the names of claims without the problem.
struct Question {
  std::string_view topic;
  std::string_view claim;   ///< the claim whose measurements answer it
  int clauses;              ///< leading clauses of the measurements that are the answer; the claim shows the others
  std::string_view beside;  ///< the claim whose verdicts are shown too
};

constexpr std::array questions{
    Question{"Accuracy", "equal_solutions", 1, "state_slope"},
    Question{"Structure", "momentum_consistency", 1, "replay_beside_tangent"},
    Question{"Size", "savings_at_equal_state_error", 1, "variable_ratio"},
    Question{"Cost", "collocation_more_expensive", 1, "collocation_more_expensive_on_coarse_grids"},
    Question{"Robustness", "cold_starts_confirmed", 3, "cold_starts_best"},
};

/// The claims with that name, one for each problem.
std::vector<const Row*> claims_named(const Table& claims, std::string_view name) {
  std::vector<const Row*> found;
  for (const Row& claim : claims.rows()) {
    if (problem_and_name(claim.text("claim")).second == name) found.push_back(&claim);
  }
  return found;
}

/// The first clauses of a sentence whose clauses end with semicolons.
std::string first_clauses(const std::string& sentence, int count) {
  std::size_t end = 0;
  for (int i = 0; i < count && end != std::string::npos; ++i) end = sentence.find("; ", i == 0 ? 0 : end + 1);
  return sentence.substr(0, end);
}

std::string linked(const Row& claim) {
  return fmt::format("<a href=\"#{}\">{}</a>", anchor("claim", claim.text("claim")),
                     escaped(in_words(problem_and_name(claim.text("claim")).first)));
}

/// The first figure that a claim names as its evidence; empty without one.
std::string figure_of(const Row& claim) {
  const std::string& evidence = claim.text("evidence");
  constexpr std::string_view folder = "figures/";
  const std::size_t begin = evidence.find(folder);
  const std::size_t end = evidence.find(".svg", begin);
  if (begin == std::string::npos || end == std::string::npos) return "";
  return evidence.substr(begin + folder.size(), end - begin - folder.size());
}

/// Links to the figures of the claims; the script of the page puts the figures into them.
std::string small_figures(const std::vector<const Row*>& claims, const ResultsFolder& results) {
  std::string html;
  for (const Row* const claim : claims) {
    const std::string figure = figure_of(*claim);
    if (std::ranges::count(results.figures, figure, &ReportedFigure::name) > 0) {
      html +=
          fmt::format("<a class=\"small\" href=\"#{}\">{}</a>\n", anchor("figure", figure), escaped(in_words(figure)));
    }
  }
  return html.empty() ? "" : "<div class=\"smalls\">" + html + "</div>";
}

/// As a sentence begins.
std::string capitalised(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text;
}

std::string answer_html(const Question& question, const ResultsFolder& results) {
  const Table& claims = results.claims;
  const std::vector<const Row*> answers = claims_named(claims, question.claim);
  if (answers.empty()) return "";
  std::vector<std::string> measured;
  measured.reserve(answers.size());
  for (const Row* const claim : answers) {
    measured.push_back(fmt::format("{} {}: {}", linked(*claim), badge(claim->text("verdict")),
                                   escaped_prose(first_clauses(claim->text("measured"), question.clauses))));
  }
  const std::string section = section_of(*answers.front());
  std::string html = fmt::format(
      "<li><b>{}</b>{}. {}: {}.", question.topic, section.empty() ? "" : fmt::format(" <i>({})</i>", escaped(section)),
      escaped_prose(capitalised(answers.front()->text("states"))), fmt::join(measured, "; "));
  std::vector<std::string> verdicts;
  const std::vector<const Row*> beside = claims_named(claims, question.beside);
  verdicts.reserve(beside.size());
  for (const Row* const claim : beside)
    verdicts.push_back(fmt::format("{} {}", linked(*claim), badge(claim->text("verdict"))));
  if (!verdicts.empty())
    html += fmt::format(" <i>{}: {}</i>", escaped(in_words(question.beside)), fmt::join(verdicts, ", "));
  return html + small_figures(answers, results) + "</li>\n";
}

}  // namespace

std::string answers_html(const ResultsFolder& results) {
  std::string answers;
  for (const Question& question : questions) answers += answer_html(question, results);
  return answers.empty() ? "" : "<ol class=\"answers\">\n" + answers + "</ol>\n";
}

std::string badge(const std::string& verdict) {
  return fmt::format("<span class=\"verdict {}\">{}</span>", anchor("v", verdict), escaped(verdict));
}

std::string section_of(const Row& claim) {
  const std::string& where = claim.text("where");
  return where.substr(0, where.find(','));
}

std::pair<std::string, std::string> problem_and_name(const std::string& claim) {
  const std::size_t slash = std::min(claim.find('/'), claim.size());
  return {claim.substr(0, slash), claim.substr(std::min(slash + 1, claim.size()))};
}

}  // namespace dmocbench
