#include <map>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "bench/report/answers.hpp"
#include "bench/report/claim_evidence.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"

namespace dmocbench {

namespace {

std::string claim_html(const Row& claim, const ResultsFolder& results) {
  const auto [problem, name] = problem_and_name(claim.text("claim"));
  std::string html = fmt::format(
      "<details class=\"claim\" id=\"{}\" data-verdict=\"{}\" data-problem=\"{}\" data-whose=\"{}\"><summary>{} "
      "<b>{}</b> <i>{}</i> {}</summary>\n<dl>",
      anchor("claim", claim.text("claim")), escaped(claim.text("verdict")), escaped(problem),
      escaped(claim.text("whose")), badge(claim.text("verdict")), escaped(in_words(name)), escaped(in_words(problem)),
      escaped_prose(claim.text("states")));
  const auto add = [&html](std::string_view term, const std::string& description) {
    if (!description.empty()) html += fmt::format("<dt>{}<dd>{}\n", term, description);
  };
  add("Measured", escaped_prose(claim.text("measured")));
  add("Why", escaped_prose(claim.text("reason")));
  add("Where", escaped(fmt::format("{} {}", claim.text("where"), claim.text("figure"))));
  add("Whose", escaped(claim.text("whose")));
  add("Sure", escaped_prose(claim.text("sure")));
  return html + claim_evidence(claim, results) + "</dl></details>\n";
}

/// A choice among the values of a property of claims; JavaScript shows it.
std::string choice_html(const std::string& label, const std::string& key, const std::set<std::string>& values) {
  std::string html = fmt::format(R"(<label>{} <select data-filter="{}"><option value="">all</option>)", label, key);
  for (const std::string& value : values)
    html += fmt::format(R"(<option value="{0}">{1}</option>)", escaped(value), escaped(in_words(value)));
  return html + "</select></label>\n";
}

std::string filter_html(const Table& claims) {
  std::set<std::string> verdicts;
  std::set<std::string> problems;
  std::set<std::string> owners;
  for (const Row& claim : claims.rows()) {
    verdicts.insert(claim.text("verdict"));
    problems.insert(problem_and_name(claim.text("claim")).first);
    owners.insert(claim.text("whose"));
  }
  return "<form class=\"filter\" hidden>" + choice_html("Verdict", "verdict", verdicts) +
         choice_html("Problem", "problem", problems) + choice_html("Whose", "whose", owners) +
         "<label>Search <input type=\"search\" data-search></label>\n<output aria-live=\"polite\"></output></form>\n";
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

bool is_of_paper(const Row& claim) { return claim.text("whose") == "paper" || claim.text("whose") == "remark"; }

/// The paper's statements and remarks by section, in the order of its text.
std::string paper_claims_html(const ResultsFolder& results) {
  std::map<std::string, std::string> by_section;
  for (const Row& claim : results.claims.rows()) {
    if (is_of_paper(claim)) by_section[section_of(claim)] += claim_html(claim, results);
  }
  std::string html;
  for (const auto& [section, group] : by_section)
    html += fmt::format("<h3>The paper, {}</h3>\n{}", escaped(section), group);
  return html;
}

/// The other claims, closed, by whose they are.
std::string other_claims_html(const ResultsFolder& results) {
  std::map<std::string, std::pair<int, std::string>> by_owner;
  for (const Row& claim : results.claims.rows()) {
    if (is_of_paper(claim)) continue;
    auto& [count, group] = by_owner[claim.text("whose")];
    ++count;
    group += claim_html(claim, results);
  }
  std::string html;
  for (const auto& [owner, claims] : by_owner) {
    html += fmt::format("<details class=\"group\"><summary><b>{}</b> ({})</summary>\n{}</details>\n",
                        escaped(in_words(owner)), claims.first, claims.second);
  }
  return html;
}

}  // namespace

std::string claims_section(const ResultsFolder& results) {
  const Table& claims = results.claims;
  if (claims.rows().empty()) return "";
  return "<section id=\"claims\"><h2>Claims</h2>\n<p>Each verdict is computed by a predicate on the tables. Each line "
         "opens to the measurement, the reason, the rows of tables, and the commands that produce them.</p>\n" +
         counts_html(claims) + filter_html(claims) + paper_claims_html(results) + other_claims_html(results) +
         "</section>\n";
}

}  // namespace dmocbench
