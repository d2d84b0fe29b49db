#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// The different values of a key in the metadata of all runs, as text.
std::set<std::string> told(const ResultsFolder& results, const std::string& key) {
  std::set<std::string> values;
  for (const ReportedRun& run : results.runs) {
    if (!run.metadata.contains(key)) continue;
    const Json& value = run.metadata.at(key);
    values.insert(value.is_string() ? value.get<std::string>() : value.dump());
  }
  return values;
}

/// The different fields of a column in the tables with a row per solve.
std::set<std::string> fields_of(const ResultsFolder& results, const std::string& column) {
  std::set<std::string> fields;
  for (const ReportedTable& table : results.tables) {
    if (table.file != table.run + ".csv" || !results.metadata_of(table.run)->contains("cost_scale")) continue;
    for (const Row& row : table.table.rows()) fields.insert(row.text(column));
  }
  fields.erase("");
  return fields;
}

std::string listed(const std::set<std::string>& values) { return fmt::format("{}", fmt::join(values, ", ")); }

/// What a run tells in a number; 0 if it does not.
long long count_of(const ReportedRun& run, const std::string& key) {
  return run.metadata.contains(key) && run.metadata.at(key).is_number_integer() ? run.metadata.at(key).get<long long>()
                                                                                : 0;
}

/// Where not every solve was solved, run by run.
std::string unsolved_html(const ResultsFolder& results) {
  std::vector<std::string> runs;
  for (const ReportedRun& run : results.runs) {
    const long long failed = count_of(run, "not_solved");
    const long long coarse = count_of(run, "too_coarse");
    if (failed + coarse == 0) continue;
    runs.push_back(fmt::format("<li><a href=\"#{}\">{}</a>: {} of {} rows not solved, {} too coarse to be motions</li>",
                               anchor("table", run.name + ".csv"), escaped(run.name), failed, count_of(run, "rows"),
                               coarse));
  }
  if (runs.empty()) return "";
  return fmt::format(
      "<details><summary>Not every solve succeeded: {} runs have rows that were not "
      "solved</summary><ul>\n{}</ul></details>\n",
      runs.size(), fmt::join(runs, "\n"));
}

std::string warnings_html(const ResultsFolder& results) {
  std::string html;
  for (const ReportedRun& run : results.runs) {
    if (!run.metadata.value("complete", true))
      html += fmt::format("<p class=\"warning\">The run {} is not complete.</p>\n", escaped(run.name));
  }
  for (const std::string& fault : results.faults) html += fmt::format("<p class=\"warning\">{}</p>\n", escaped(fault));
  return html;
}

}  // namespace

std::string overview_section(const ResultsFolder& results) {
  long long rows = 0;
  for (const ReportedTable& table : results.tables) rows += static_cast<long long>(table.table.rows().size());
  std::string html = "<section id=\"overview\"><h1>DMOC against collocation</h1>\n";
  const std::size_t problems = fields_of(results, "problem").size();
  html += fmt::format("<p>{} {} by the methods {}: {} rows in {} tables, {} figures, {} claims.</p>\n", problems,
                      problems == 1 ? "problem" : "problems", escaped(listed(fields_of(results, "method"))), rows,
                      results.tables.size(), results.figures.size(), results.claims.rows().size());
  html += warnings_html(results) + unsolved_html(results) + "<dl class=\"facts\">\n";
  const auto add = [&html](std::string_view term, const std::string& description) {
    if (!description.empty()) html += fmt::format("<dt>{}<dd>{}\n", term, escaped(description));
  };
  const std::set<std::string> times = told(results, "utc_time");
  if (!times.empty()) {
    add("Runs", times.size() == 1
                    ? "began at " + *times.begin()
                    : fmt::format("the first began at {}, the last at {}", *times.begin(), *times.rbegin()));
  }
  add("Problems", listed(fields_of(results, "problem")));
  add("Commit", listed(told(results, "commit")));
  add("Processor", fmt::format("{}, {} cores, {}", listed(told(results, "processor")), listed(told(results, "cores")),
                               listed(told(results, "instruction_set"))));
  add("System", listed(told(results, "operating_system")));
  add("Compiler", fmt::format("{}, {}", listed(told(results, "compiler")), listed(told(results, "flags"))));
  return html + "</dl></section>\n";
}

}  // namespace dmocbench
