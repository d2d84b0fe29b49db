#include <algorithm>
#include <ctime>
#include <iomanip>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/report/answers.hpp"
#include "bench/report/html.hpp"
#include "bench/report/measured_answers.hpp"
#include "bench/report/sections.hpp"
#include "methods/runtime/counted.hpp"

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

/// A number in a run's metadata; 0 if it is missing.
long long count_of(const ReportedRun& run, const std::string& key) {
  return run.metadata.contains(key) && run.metadata.at(key).is_number_integer() ? run.metadata.at(key).get<long long>()
                                                                                : 0;
}

/// The runs with unsolved cases.
std::string unsolved_html(const ResultsFolder& results) {
  std::vector<std::string> runs;
  long long unsolved = 0;
  for (const ReportedRun& run : results.runs) {
    const long long failed = count_of(run, "not_solved");
    const long long coarse = count_of(run, "too_coarse");
    const long long violating = count_of(run, "violates_between_stages");
    if (failed + coarse + violating == 0) continue;
    unsolved += failed + coarse + violating;
    runs.push_back(
        fmt::format("<li><a href=\"#{}\">{}</a>: {} of {} not solved, {} too coarse to be motions, {} violating "
                    "constraints between stages</li>",
                    anchor("table", run.name + ".csv"), escaped(run.name), failed,
                    counted(count_of(run, "rows"), "row"), coarse, violating));
  }
  if (runs.empty()) return "";
  return fmt::format(
      "<details class=\"failures\"><summary>Not every solve succeeded: {} did not, in {}</summary><ul>\n{}</ul>"
      "</details>\n",
      unsolved, counted(runs.size(), "run"), fmt::join(runs, "\n"));
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

/// Seconds since 1970 of "2026-11-23T14:22:57Z"; empty if the text has another form.
std::optional<long long> seconds_of(const std::string& utc_time) {
  std::tm time{};
  std::istringstream text(utc_time);
  text >> std::get_time(&time, "%Y-%m-%dT%H:%M:%SZ");
  if (text.fail()) return std::nullopt;
  return static_cast<long long>(::timegm(&time));
}

/// "12.3 minutes"
std::string duration_in_words(double seconds) {
  constexpr double seconds_per_minute = 60.0;
  constexpr double fewest_minutes = 2.0;
  return seconds < fewest_minutes * seconds_per_minute ? fmt::format("{:.1f} s", seconds)
                                                       : fmt::format("{:.1f} minutes", seconds / seconds_per_minute);
}

/// Seconds since 1970 when the last of all runs ended; empty if a duration is missing.
std::optional<double> last_end(const ResultsFolder& results) {
  std::optional<double> last;
  for (const ReportedRun& run : results.runs) {
    const Json begin = run.metadata.value("utc_time", Json());
    const Json wall = run.metadata.value("wall_seconds", Json());
    if (!begin.is_string() || !wall.is_number()) return std::nullopt;
    const auto seconds = seconds_of(begin.get<std::string>());
    if (!seconds) return std::nullopt;
    last = std::max(last.value_or(0.0), static_cast<double>(*seconds) + wall.get<double>());
  }
  return last;
}

/// The times when the runs began, and the duration until the last one ended.
std::string times_in_words(const ResultsFolder& results) {
  const std::set<std::string> times = told(results, "utc_time");
  if (times.empty()) return "";
  const auto first = seconds_of(*times.begin());
  const auto last = seconds_of(*times.rbegin());
  const auto end = last_end(results);
  const std::string took = first && end ? duration_in_words(*end - static_cast<double>(*first)) : "";
  if (times.size() == 1) return fmt::format("began at {}{}", *times.begin(), took.empty() ? "" : " and took " + took);
  const std::string words = fmt::format("the first began at {}, the last at {}", *times.begin(), *times.rbegin());
  if (!took.empty()) return fmt::format("{}; all had ended {} after the first began", words, took);
  return first && last ? fmt::format("{}, {} later", words, duration_in_words(static_cast<double>(*last - *first)))
                       : words;
}

/// The extent of the comparison, in a sentence.
std::string comparison_html(const ResultsFolder& results) {
  std::size_t rows = 0;
  for (const ReportedTable& table : results.tables) rows += table.table.rows().size();
  std::set<std::string> methods;  // families, without the integrators and points of their methods
  for (const std::string& method : fields_of(results, "method")) {
    const std::string words = method_in_words(method);
    methods.insert(words.substr(0, words.find(',')));
  }
  return fmt::format("<p>{} by the methods {}: {} in {}, {}, {}.</p>\n",
                     counted(fields_of(results, "problem").size(), "problem"),
                     escaped(fmt::format("{}", fmt::join(methods, ", "))), counted(rows, "row"),
                     counted(results.tables.size(), "table"), counted(results.figures.size(), "figure"),
                     counted(results.claims.rows().size(), "claim"));
}

/// Links to the sections of the page.
std::string contents_html(const ResultsFolder& results) {
  std::vector<std::string> links;
  const auto add = [&links](bool is_there, std::string_view id, std::string_view words) {
    if (is_there) links.push_back(fmt::format("<a href=\"#{}\">{}</a>", id, words));
  };
  add(!results.claims.rows().empty(), "claims", "the paper's claims and their verdicts");
  add(!results.motions.empty(), "gallery", "a gallery of the problems with their motions");
  add(!results.figures.empty(), "figures", "all figures");
  add(!results.tables.empty(), "tables", "all tables");
  return links.empty() ? "" : fmt::format("<p>Continue with {}.</p>\n", fmt::join(links, ", "));
}

}  // namespace

std::string overview_section(const ResultsFolder& results) {
  std::string html = "<section id=\"overview\"><h1>DMOC against collocation</h1>\n";
  html += comparison_html(results) + contents_html(results) + warnings_html(results) +
          (results.claims.rows().empty() ? measured_answers_html(results) : answers_html(results)) +
          unsolved_html(results) + "<dl class=\"facts\">\n";
  const auto add = [&html](std::string_view term, const std::string& description) {
    if (!description.empty()) html += fmt::format("<dt>{}<dd>{}\n", term, escaped(description));
  };
  add("Runs", times_in_words(results));
  add("Commit", listed(told(results, "commit")));
  add("Processor", fmt::format("{}, {} cores, {}", listed(told(results, "processor")), listed(told(results, "cores")),
                               listed(told(results, "instruction_set"))));
  add("System", listed(told(results, "operating_system")));
  add("Compiler", fmt::format("{}, {}", listed(told(results, "compiler")), listed(told(results, "flags"))));
  add("Problems", listed(fields_of(results, "problem")));
  return html + "</dl></section>\n";
}

}  // namespace dmocbench
