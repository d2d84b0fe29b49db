#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"

namespace dmocbench {

namespace {

/// A question about the methods, and the claims whose rows answer it, by their names without the problem.
struct Question {
  std::string_view asked;
  std::array<std::string_view, 2> claims;
};

constexpr std::array questions{
    Question{"How accurate are they?", {"equal_solutions", "state_slope"}},
    Question{"What of the structure is kept?", {"momentum_consistency", "replay_beside_tangent"}},
    Question{"How large are the programs?", {"variable_ratio", "savings_at_equal_state_error"}},
    Question{"What does a solve cost?", {"collocation_more_expensive", "factorisation_more_expensive_by_any_solver"}},
    Question{"How often do cold starts succeed?", {"cold_starts_confirmed_as_often", "cold_starts_best_as_often"}},
};

/// "orbital_transfer" and "state_slope" of "orbital_transfer/state_slope".
std::pair<std::string, std::string> apart(const std::string& claim) {
  const std::size_t slash = std::min(claim.find('/'), claim.size());
  return {claim.substr(0, slash), claim.substr(std::min(slash + 1, claim.size()))};
}

std::string badge(const std::string& verdict) {
  return fmt::format("<span class=\"verdict {}\">{}</span>", anchor("v", verdict), escaped(verdict));
}

std::string answer_html(const Row& claim) {
  const auto [problem, name] = apart(claim.text("claim"));
  return fmt::format("<li>{} <a href=\"#{}\">{}, {}</a>: {}</li>\n", badge(claim.text("verdict")),
                     anchor("claim", claim.text("claim")), escaped(in_words(problem)), escaped(claim.text("states")),
                     escaped(claim.text("measured")));
}

std::string answers_html(const Table& claims) {
  std::string html;
  for (const Question& question : questions) {
    std::string answers;
    for (const std::string_view wanted : question.claims) {
      for (const Row& claim : claims.rows()) {
        if (apart(claim.text("claim")).second == wanted) answers += answer_html(claim);
      }
    }
    if (!answers.empty())
      html += fmt::format("<h3>{}</h3>\n<ul class=\"answers\">\n{}</ul>\n", question.asked, answers);
  }
  return html.empty() ? "" : "<section id=\"answers\"><h2>Five questions</h2>\n" + html + "</section>\n";
}

/// A file that claims name as evidence, as a link to where the page shows it.
std::string evidence_html(const std::string& file, const ResultsFolder& results) {
  constexpr std::string_view folder = "figures/";
  constexpr std::string_view ending = ".svg";
  if (file.starts_with(folder) && file.ends_with(ending)) {
    const std::string name = file.substr(folder.size(), file.size() - folder.size() - ending.size());
    if (std::ranges::count(results.figures, name, &ReportedFigure::name) > 0)
      return fmt::format("<a href=\"#{}\">figure {}</a>", anchor("figure", name), escaped(in_words(name)));
  }
  if (std::ranges::count(results.tables, file, &ReportedTable::file) > 0)
    return fmt::format("<a href=\"#{}\">{}</a>", anchor("table", file), escaped(file));
  return escaped(file);
}

std::string evidence_list(const std::string& evidence, const ResultsFolder& results) {
  std::vector<std::string> links;
  for (std::size_t begin = 0; begin < evidence.size();) {
    const std::size_t end = std::min(evidence.find("; ", begin), evidence.size());
    links.push_back(evidence_html(evidence.substr(begin, end - begin), results));
    begin = end + 2;
  }
  return fmt::format("{}", fmt::join(links, ", "));
}

std::string claim_html(const Row& claim, const ResultsFolder& results) {
  const auto [problem, name] = apart(claim.text("claim"));
  std::string html = fmt::format(
      "<details class=\"claim\" id=\"{}\" data-verdict=\"{}\" data-problem=\"{}\" data-whose=\"{}\"><summary>{} "
      "<b>{}</b> "
      "<i>{}</i> {}</summary>\n<dl>",
      anchor("claim", claim.text("claim")), escaped(claim.text("verdict")), escaped(problem),
      escaped(claim.text("whose")), badge(claim.text("verdict")), escaped(in_words(name)), escaped(in_words(problem)),
      escaped(claim.text("states")));
  const auto add = [&html](std::string_view term, const std::string& description) {
    if (!description.empty()) html += fmt::format("<dt>{}<dd>{}\n", term, description);
  };
  add("Measured", escaped(claim.text("measured")));
  add("Why", escaped(claim.text("reason")));
  add("Where", escaped(fmt::format("{} {}", claim.text("where"), claim.text("figure"))));
  add("Whose", escaped(claim.text("whose")));
  add("Sure", escaped(claim.text("sure")));
  add("Evidence", evidence_list(claim.text("evidence"), results));
  return html + "</dl></details>\n";
}

/// A choice among the values of a property of claims; JavaScript shows it.
std::string choice_html(const std::string& label, const std::string& key, const std::set<std::string>& values) {
  std::string html = fmt::format("<label>{} <select data-filter=\"{}\"><option value=\"\">all</option>", label, key);
  for (const std::string& value : values)
    html += fmt::format("<option value=\"{0}\">{1}</option>", escaped(value), escaped(in_words(value)));
  return html + "</select></label>\n";
}

std::string filter_html(const Table& claims) {
  std::set<std::string> verdicts;
  std::set<std::string> problems;
  std::set<std::string> owners;
  for (const Row& claim : claims.rows()) {
    verdicts.insert(claim.text("verdict"));
    problems.insert(apart(claim.text("claim")).first);
    owners.insert(claim.text("whose"));
  }
  return "<form class=\"filter\" hidden>" + choice_html("Verdict", "verdict", verdicts) +
         choice_html("Problem", "problem", problems) + choice_html("Whose", "whose", owners) +
         "<output aria-live=\"polite\"></output></form>\n";
}

/// "21 reproduced, 4 differs" of each owner.
std::string counts_html(const Table& claims) {
  std::map<std::string, std::map<std::string, int>> counts;
  for (const Row& claim : claims.rows()) ++counts[claim.text("whose")][claim.text("verdict")];
  std::string html = "<ul>\n";
  for (const auto& [owner, verdicts] : counts) {
    html += fmt::format("<li>{}: ", escaped(owner));
    for (const auto& [verdict, count] : verdicts) html += fmt::format("{} {} ", count, badge(verdict));
    html += "</li>\n";
  }
  return html + "</ul>\n";
}

}  // namespace

std::string claims_section(const ResultsFolder& results) {
  const Table& claims = results.claims;
  if (claims.rows().empty()) return "";
  std::string html =
      answers_html(claims) + "<section id=\"claims\"><h2>Claims</h2>\n" +
      "<p>A predicate on the tables decides on every verdict. Each line opens what was measured, why, and by "
      "which files.</p>\n" +
      counts_html(claims) + filter_html(claims);
  for (const Row& claim : claims.rows()) html += claim_html(claim, results);
  return html + "</section>\n";
}

}  // namespace dmocbench
