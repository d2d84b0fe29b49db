#include "bench/claims/claims_table.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <ranges>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/run/column.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// The files with "; " between them, and "(missing)" after the missing ones.
std::string evidence_in_words(const JudgedClaim& claim) {
  const auto in_words = [&](const std::string& file) {
    return std::ranges::count(claim.missing, file) > 0 ? file + " (missing)" : file;
  };
  return fmt::format("{}", fmt::join(claim.evidence | std::views::transform(in_words), "; "));
}

const Columns<JudgedClaim>& claim_columns() {
  static const Columns<JudgedClaim> all{
      {"claim", "", "problem and short name", &JudgedClaim::id, in_key},
      {"where", "", "place in the paper", &JudgedClaim::where},
      {"figure", "", "figure of the paper", &JudgedClaim::figure},
      {"whose", "", "source of the statement", [](const JudgedClaim& claim) { return name_of(claim.whose); }},
      {"states", "", "the statement", &JudgedClaim::states},
      {"measured", "", "the measurement, in words and numbers", &JudgedClaim::measured},
      {"verdict", "", "verdict computed from the tables",
       [](const JudgedClaim& claim) { return name_of(claim.verdict); }},
      {"reason", "", "reason for the difference, or conditions of the statement", &JudgedClaim::reason},
      {"evidence", "", "tables and figures", evidence_in_words},
      {"sure", "", "certainty: exact, or share of replicates with the same verdict", &JudgedClaim::sure},
  };
  return all;
}

/// Findings have no verdict, and the paper has no figure of them.
const Columns<JudgedClaim>& finding_columns() {
  static const Columns<JudgedClaim> all{
      {"finding", "", "problem and short name", &JudgedClaim::id, in_key},
      {"where", "", "related place in the paper", &JudgedClaim::where},
      {"whose", "", "source of the finding: ours or extension",
       [](const JudgedClaim& claim) { return name_of(claim.whose); }},
      {"question", "", "the measured quantity", &JudgedClaim::states},
      {"measured", "", "the measurement, in words and numbers", &JudgedClaim::measured},
      {"condition", "", "conditions of the measurement", &JudgedClaim::reason},
      {"evidence", "", "tables and figures", evidence_in_words},
      {"sure", "", "certainty: exact, or the share of replicates within the intervals", &JudgedClaim::sure},
  };
  return all;
}

std::vector<JudgedClaim> with_verdict(const std::vector<JudgedClaim>& claims) {
  std::vector<JudgedClaim> some;
  std::ranges::copy_if(claims, std::back_inserter(some), &JudgedClaim::has_verdict);
  return some;
}

std::vector<JudgedClaim> without_verdict(const std::vector<JudgedClaim>& claims) {
  std::vector<JudgedClaim> some;
  std::ranges::copy_if(claims, std::back_inserter(some), std::not_fn(&JudgedClaim::has_verdict));
  return some;
}

/// The name of the claims of a source in the closing lines and as a heading.
struct Title {
  const char* line;
  const char* heading;
};

Title title_of(Whose whose) {
  constexpr std::array titles{
      Title{"the paper's statements and remarks", "The paper's statements and remarks"},
      Title{"our findings", "Our findings: sharper statements, and questions that the paper leaves open"},
      Title{"misprints", "Misprints: the printed and the intended statement"},
      Title{"extensions", "Extensions of the suite"}};
  return titles[static_cast<std::size_t>(whose)];
}

std::vector<JudgedClaim> stated_by(const std::vector<JudgedClaim>& claims, Whose whose) {
  std::vector<JudgedClaim> of_source;
  std::ranges::copy_if(claims, std::back_inserter(of_source),
                       [&](const JudgedClaim& claim) { return claim.has_verdict && claim.whose == whose; });
  return of_source;
}

/// A field in a table of Markdown, where a bar would begin the next column.
std::string escaped(const std::string& field) {
  std::string text;
  for (const char c : field) {
    if (c == '|') text += '\\';
    text += c == '\n' ? ' ' : c;
  }
  return text;
}

/// The columns of a table but for those that its heading states.
std::string markdown_table(const Table& table) {
  std::vector<std::string> names = table.columns();
  std::erase(names, "whose");
  std::string text = fmt::format("| {} |\n|", fmt::join(names, " | "));
  for (std::size_t i = 0; i < names.size(); ++i) text += "---|";
  for (const Row& claim : table.rows()) {
    const auto field = [&](const std::string& column) { return escaped(claim.text(column)); };
    text += fmt::format("\n| {} |", fmt::join(names | std::views::transform(field), " | "));
  }
  return text + "\n";
}

/// "differs" of one claim, "differ" of several.
std::string told_together(std::ptrdiff_t count, ClaimVerdict verdict) {
  const bool are_several = verdict == ClaimVerdict::differs && count != 1;
  return fmt::format("{} {}", count, are_several ? "differ" : name_of(verdict));
}

/// "21 reproduced, 4 differ".
std::string counts_in_words(const std::vector<JudgedClaim>& claims) {
  std::vector<std::string> counts;
  for (const ClaimVerdict verdict : all_verdicts) {
    const auto count = std::ranges::count(claims, verdict, &JudgedClaim::verdict);
    if (count > 0) counts.push_back(told_together(count, verdict));
  }
  return fmt::format("{}", fmt::join(counts, ", "));
}

/// "- **orbit/fast** (section 4): reproduced. It is claimed; measured: 2.01; why".
std::string bullet(const JudgedClaim& claim) {
  return fmt::format("- **{}** ({}), {}: {}. Measured: {}.{}{}\n", claim.id(), claim.where, name_of(claim.verdict),
                     claim.states, claim.measured(), claim.reason().empty() ? "" : " Why: ", claim.reason());
}

/// The summary: the counts, each statement of the paper that is not reproduced, and our most important findings.
std::string summary_markdown(const std::vector<JudgedClaim>& claims) {
  std::string text = fmt::format("## Summary\n\n- {}\n\nThe paper's statements by section:\n\n- {}\n",
                                 fmt::join(closing_lines(claims), "\n- "), fmt::join(section_lines(claims), "\n- "));
  const auto append = [&](const char* heading, const auto& is_wanted) {
    std::string bullets;
    for (const JudgedClaim& claim : claims) {
      if (is_wanted(claim)) bullets += bullet(claim);
    }
    if (!bullets.empty()) text += fmt::format("\n### {}\n\n{}", heading, bullets);
  };
  append("Statements and remarks of the paper that are not reproduced", [](const JudgedClaim& claim) {
    return claim.whose == Whose::paper && claim.verdict != ClaimVerdict::reproduced;
  });
  append("Our main findings", [](const JudgedClaim& claim) { return claim.headline; });
  return text;
}

/// A text, and the numbers in it.
nlohmann::ordered_json words_json(const std::vector<Words>& all) {
  nlohmann::ordered_json clauses = nlohmann::ordered_json::array();
  for (const Words& words : all) {
    nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
    for (const auto& [name, value, method, at, unit] : words.numbers)
      numbers.push_back({{"name", name}, {"value", value}, {"method", method}, {"at", at}, {"unit", unit}});
    clauses.push_back({{"text", words.text}, {"numbers", numbers}});
  }
  return clauses;
}

/// The names of the figures among the evidence, without folder and ending.
std::vector<std::string> figures_of(const JudgedClaim& claim) {
  std::vector<std::string> figures;
  for (const std::filesystem::path file : claim.evidence) {
    if (file.parent_path() == "figures") figures.push_back(file.stem().string());
  }
  return figures;
}

nlohmann::ordered_json claim_json(const JudgedClaim& claim) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const ReadRows& read : claim.rows)
    rows.push_back({{"table", read.table}, {"records", read.records}, {"columns", read.columns}});
  return {{"claim", claim.id()},
          {"problem", claim.problem},
          {"name", claim.name},
          {"where", claim.where},
          {"figure", claim.figure},
          {"whose", name_of(claim.whose)},
          {"states", claim.states},
          {"verdict", name_of(claim.verdict)},
          {"measured", words_json(claim.clauses)},
          {"reasons", words_json(claim.reasons)},
          {"sure", claim.sure},
          {"by_counting", claim.by_counting},
          {"headline", claim.headline},
          {"evidence", claim.evidence},
          {"missing", claim.missing},
          {"figures", figures_of(claim)},
          {"rows", rows}};
}

}  // namespace

Table claims_rows_table(const std::vector<JudgedClaim>& claims) {
  struct Evidence {
    std::string claim;
    std::string table;
    std::string records;
    std::string columns;
  };
  const Columns<Evidence> columns{
      {"claim", "", "name of the claim", &Evidence::claim, in_key},
      {"table", "", "file that was read", &Evidence::table, in_key},
      {"records", "", "records that were read, such as 2-5 9 (the header is record 1)", &Evidence::records},
      {"columns", "", "columns that were read, separated by spaces", &Evidence::columns}};
  std::vector<Evidence> evidence;
  for (const JudgedClaim& claim : claims) {
    for (const ReadRows& rows : claim.rows) {
      evidence.push_back(
          {claim.id(), rows.table, packed_ranges(rows.records), fmt::format("{}", fmt::join(rows.columns, " "))});
    }
  }
  return table_of(columns, evidence);
}

nlohmann::ordered_json claims_json(const std::vector<JudgedClaim>& claims) {
  const auto all = [](const std::vector<JudgedClaim>& some) {
    nlohmann::ordered_json array = nlohmann::ordered_json::array();
    for (const JudgedClaim& claim : some) array.push_back(claim_json(claim));
    return array;
  };
  return {{"claims", all(with_verdict(claims))}, {"findings", all(without_verdict(claims))}};
}

Table claims_table(const std::vector<JudgedClaim>& claims) { return table_of(claim_columns(), with_verdict(claims)); }

Table findings_table(const std::vector<JudgedClaim>& claims) {
  return table_of(finding_columns(), without_verdict(claims));
}

std::string claims_markdown(const std::vector<JudgedClaim>& claims) {
  std::string text =
      "# Claims, measured\n\nEach verdict is computed by a predicate on the tables next to this file. *Reproduced*: "
      "the predicate holds. *Differs*: it does not hold. *Undecided*: the interval of the measurement contains the "
      "threshold. *Floor*: only round-off was measured. *Not judged*: a table, a number or usable rows are missing; "
      "failed solves do not affect verdicts. *Sure* is *exact* if the verdict depends neither on times nor on random "
      "numbers.\n\n" +
      summary_markdown(claims);
  for (const Whose whose : all_sources) {
    const std::vector<JudgedClaim> of_source = stated_by(claims, whose);
    if (of_source.empty()) continue;
    text += fmt::format("\n## {}\n\n{}", title_of(whose).heading, markdown_table(claims_table(of_source)));
  }
  if (const Table findings = findings_table(claims); !findings.rows().empty()) {
    text +=
        fmt::format("\n## Measurements without a verdict: the numbers are the result\n\n{}", markdown_table(findings));
  }
  return text;
}

std::vector<std::string> closing_lines(const std::vector<JudgedClaim>& claims) {
  std::vector<std::string> lines;
  for (const Whose whose : all_sources) {
    const std::vector<JudgedClaim> of_source = stated_by(claims, whose);
    if (of_source.empty()) continue;
    lines.push_back(fmt::format("{}: {}", title_of(whose).line, counts_in_words(of_source)));
  }
  if (const std::vector<JudgedClaim> findings = without_verdict(claims); !findings.empty()) {
    const auto count = std::ranges::count(findings, ClaimVerdict::measured, &JudgedClaim::verdict);
    lines.push_back(fmt::format("measurements without a verdict: {} of {}", count, findings.size()));
  }
  return lines;
}

std::string section_in(std::string_view where) {
  const std::size_t number = where.find_first_of("0123456789");
  if (number == std::string_view::npos) return std::string(where.substr(0, where.find(',')));
  const std::size_t end = std::min(where.find_first_not_of("0123456789.", number), where.size());
  return fmt::format("section {}", where.substr(number, end - number));
}

std::vector<std::string> section_lines(const std::vector<JudgedClaim>& claims) {
  std::map<std::string, std::vector<JudgedClaim>> sections;
  for (const JudgedClaim& claim : stated_by(claims, Whose::paper)) sections[section_in(claim.where)].push_back(claim);
  std::vector<std::string> lines;
  for (const auto& [section, of_section] : sections)
    lines.push_back(fmt::format("{}: {}", section, counts_in_words(of_section)));
  return lines;
}

void mark_missing_evidence(std::vector<JudgedClaim>& claims, const std::filesystem::path& folder) {
  for (JudgedClaim& claim : claims) {
    std::ranges::copy_if(claim.evidence, std::back_inserter(claim.missing), [&](const std::string& file) {
      std::error_code unknown;
      return !std::filesystem::exists(folder / file, unknown);
    });
  }
}

std::vector<std::string> not_reproduced(const std::vector<JudgedClaim>& claims, const std::vector<std::string>& names) {
  std::vector<std::string> sentences;
  for (const std::string& name : names) {
    const auto claim = std::ranges::find(claims, name, &JudgedClaim::id);
    if (claim == claims.end() || !claim->has_verdict)
      throw Error("there is no claim {}; claims.csv lists all claims", name);
    if (claim->verdict == ClaimVerdict::reproduced) continue;
    sentences.push_back(
        fmt::format("{} is not reproduced but {}: {}", name, name_of(claim->verdict), claim->measured()));
  }
  return sentences;
}

}  // namespace dmocbench
