#include "bench/report/comparison_page.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/report/compared_tables.hpp"
#include "bench/report/html.hpp"
#include "bench/report/page.hpp"
#include "methods/runtime/counted.hpp"

namespace dmocbench {

namespace {

/// A table of HTML with the same cells in each row.
std::string cells(const std::string& label, const std::vector<std::string>& heads,
                  const std::vector<std::vector<std::string>>& rows) {
  std::string html = fmt::format(
      R"(<div class="scroll wrapped" role="region" tabindex="0" aria-label="{}"><table><thead><tr>)", escaped(label));
  for (const std::string& head : heads) html += fmt::format(R"(<th scope="col">{})", escaped(head));
  html += "</thead><tbody>\n";
  for (const std::vector<std::string>& row : rows) {
    html += "<tr>";
    for (const std::string& cell : row) html += fmt::format("<td>{}", escaped(cell));
    html += "\n";
  }
  return html + "</tbody></table></div>\n";
}

std::map<std::string, const Row*> claims_by_name(const ResultsFolder& results) {
  std::map<std::string, const Row*> claims;
  for (const Row& row : results.claims.rows()) claims[row.text("claim")] = &row;
  return claims;
}

std::string claims_section_of(const ComparedRun& first, const ComparedRun& second) {
  const auto before = claims_by_name(first.results);
  const auto after = claims_by_name(second.results);
  std::vector<std::vector<std::string>> changed;
  std::vector<std::string> alone;
  std::size_t same = 0;
  for (const auto& [name, claim] : before) {
    const auto other = after.find(name);
    if (other == after.end()) {
      alone.push_back(name + " (A)");
    } else if (claim->text("verdict") == other->second->text("verdict")) {
      ++same;
    } else {
      changed.push_back({name, claim->text("states"), claim->text("verdict"), other->second->text("verdict"),
                         claim->text("measured"), other->second->text("measured")});
    }
  }
  for (const auto& [name, claim] : after) {
    if (!before.contains(name)) alone.push_back(name + " (B)");
  }
  std::string html = fmt::format(
      "<section id=\"claims\"><h2>Claims</h2>\n<p>{} another verdict, {} the same one, "
      "{} in one of the runs only.</p>\n",
      counted(changed.size(), "claim has", "claims have"), counted(same, "has", "have"),
      counted(alone.size(), "is", "are"));
  if (!changed.empty()) {
    html += cells("claims with another verdict",
                  {"claim", "states", "verdict in A", "verdict in B", "measured in A", "measured in B"}, changed);
  }
  if (!alone.empty())
    html += fmt::format("<p>In one of them only: {}.</p>\n", escaped(fmt::format("{}", fmt::join(alone, ", "))));
  return html + "</section>\n";
}

/// The tables that both have, in the order of their names.
std::vector<std::pair<const ReportedTable*, const ReportedTable*>> common_tables(const ResultsFolder& first,
                                                                                 const ResultsFolder& second) {
  std::vector<std::pair<const ReportedTable*, const ReportedTable*>> tables;
  for (const ReportedTable& table : first.tables) {
    const auto other = std::ranges::find(second.tables, table.file, &ReportedTable::file);
    if (other != second.tables.end()) tables.emplace_back(&table, &*other);
  }
  return tables;
}

std::string times_section(const ComparedRun& first, const ComparedRun& second) {
  std::string html;
  std::size_t unjudged = 0;
  for (const auto& [before, after] : common_tables(first.results, second.results)) {
    std::vector<ChangedTime> times = changed_times(paired_rows(before->table, after->table));
    unjudged += std::erase_if(times, [](const ChangedTime& time) { return !time.is_judged(); });
    if (times.empty()) continue;
    const auto changed = std::ranges::count_if(times, &ChangedTime::is_changed);
    std::ranges::stable_sort(times, std::greater{}, &ChangedTime::is_changed);
    std::vector<std::vector<std::string>> rows;
    for (const ChangedTime& time : times) {
      const RatioInterval& ratio = time.ratio;
      const std::string verdict = !time.is_changed()  ? "the same within its interval"
                                  : ratio.ratio > 1.0 ? "slower in B"
                                                      : "faster in B";
      rows.push_back({time.about, fmt::format("{:.3f}", ratio.ratio), fmt::format("{:.3f}", ratio.lower),
                      fmt::format("{:.3f}", ratio.upper), std::to_string(ratio.rounds), verdict});
    }
    html += fmt::format(
        "<details><summary><b>{}</b> {} solves were timed in both; {} differ beyond their "
        "interval</summary>\n{}</details>\n",
        escaped(before->file), times.size(), changed,
        cells("times in " + before->file, {"solve", "B by A", "lower", "upper", "rounds", "verdict"}, rows));
  }
  if (html.empty() && unjudged == 0) return "";
  return fmt::format(
             "<section id=\"times\"><h2>Times</h2>\n<p>The median time in B over the median in A, with a 99 % interval "
             "from the rounds of both. The runs were not interleaved, so the ratio contains other load of the machine "
             "during one of them. {} solves were timed in fewer than {} rounds and are not judged.</p>\n",
             unjudged, fewest_rounds) +
         html + "</section>\n";
}

std::string counts_section(const ComparedRun& first, const ComparedRun& second) {
  constexpr std::size_t most_changes = 200;
  std::string html;
  std::size_t same = 0;
  for (const auto& [before, after] : common_tables(first.results, second.results)) {
    const PairedRows rows = paired_rows(before->table, after->table);
    const std::vector<ChangedField> changes = changed_fields(before->table, after->table, rows);
    if (changes.empty() && rows.alone == 0) {
      ++same;
      continue;
    }
    std::vector<std::vector<std::string>> shown;
    for (std::size_t i = 0; i < std::min(changes.size(), most_changes); ++i)
      shown.push_back({changes[i].about, changes[i].column, changes[i].first, changes[i].second});
    const std::string begin =
        changes.size() > most_changes ? fmt::format(", the first {} here", most_changes) : std::string();
    html += fmt::format(
        "<details><summary><b>{}</b> {}{}; {} in one of them only</summary>\n{}</details>\n", escaped(before->file),
        counted(changes.size(), "field differs", "fields differ"), begin, counted(rows.alone, "row is", "rows are"),
        shown.empty() ? std::string() : cells("counts in " + before->file, {"row", "column", "A", "B"}, shown));
  }
  return fmt::format(
             "<section id=\"counts\"><h2>Counts</h2>\n<p>Whole numbers, statuses and verdicts in corresponding rows. "
             "{} no differences.</p>\n",
             counted(same, "table has", "tables have")) +
         html + "</section>\n";
}

/// Names that only the first has.
std::vector<std::string> lacking(const std::set<std::string>& names, const std::set<std::string>& others) {
  std::vector<std::string> alone;
  std::ranges::set_difference(names, others, std::back_inserter(alone));
  return alone;
}

std::string told_by(const ResultsFolder& results, const std::string& key) {
  std::set<std::string> values;
  for (const ReportedRun& run : results.runs) {
    if (!run.metadata.contains(key)) continue;
    const auto& value = run.metadata.at(key);
    values.insert(value.is_string() ? value.get<std::string>() : value.dump());
  }
  if (key == "utc_time" && !values.empty()) return *values.begin();
  return fmt::format("{}", fmt::join(values, ", "));
}

std::string overview(const ComparedRun& first, const ComparedRun& second) {
  std::string html =
      fmt::format("<section id=\"overview\"><h1>Two runs: {} and {}</h1>\n", escaped(first.name), escaped(second.name));
  html += cells("the two runs", {"item", "A", "B"},
                {{"folder", first.name, second.name},
                 {"began at", told_by(first.results, "utc_time"), told_by(second.results, "utc_time")},
                 {"commit", told_by(first.results, "commit"), told_by(second.results, "commit")},
                 {"processor", told_by(first.results, "processor"), told_by(second.results, "processor")},
                 {"compiler", told_by(first.results, "compiler"), told_by(second.results, "compiler")},
                 {"flags", told_by(first.results, "flags"), told_by(second.results, "flags")}});
  std::set<std::string> before;
  std::set<std::string> after;
  for (const ReportedTable& table : first.results.tables) before.insert(table.file);
  for (const ReportedTable& table : second.results.tables) after.insert(table.file);
  const auto say = [&html](const std::string& where, const std::vector<std::string>& files) {
    if (!files.empty())
      html += fmt::format("<p>Only in {}: {}.</p>\n", where, escaped(fmt::format("{}", fmt::join(files, ", "))));
  };
  say("A", lacking(before, after));
  say("B", lacking(after, before));
  for (const ComparedRun* run : {&first, &second}) {
    for (const std::string& fault : run->results.faults)
      html += fmt::format("<p class=\"warning\">{}: {}</p>\n", escaped(run->name), escaped(fault));
  }
  return html + "</section>\n";
}

}  // namespace

std::string comparison_page(const ComparedRun& first, const ComparedRun& second) {
  return page_of("Two runs of dmocbench", {{"Overview", overview(first, second)},
                                           {"Claims", claims_section_of(first, second)},
                                           {"Times", times_section(first, second)},
                                           {"Counts", counts_section(first, second)}});
}

}  // namespace dmocbench
