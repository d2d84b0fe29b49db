#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "methods/program/status.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// What a run's metadata say of a column, "[s] median time of a solve"; empty if nothing.
std::string meaning_of(const Json* metadata, const std::string& file, const std::string& column) {
  if (metadata == nullptr) return "";
  const Json::json_pointer place = Json::json_pointer() / "tables" / file / "meanings" / column;
  return metadata->contains(place) && metadata->at(place).is_string() ? metadata->at(place).get<std::string>() : "";
}

/// "s" and "median time of a solve" of "[s] median time of a solve".
std::pair<std::string, std::string> unit_and_words(const std::string& meaning) {
  const std::size_t end = meaning.find("] ");
  if (!meaning.starts_with('[') || end == std::string::npos) return {"", meaning};
  return {meaning.substr(1, end - 1), meaning.substr(end + 2)};
}

/// What the columns mean, to be opened; nothing where nobody tells.
std::string meanings_html(const std::vector<std::string>& columns, const Json* metadata, const std::string& file) {
  std::string html;
  for (const std::string& column : columns) {
    const std::string words = unit_and_words(meaning_of(metadata, file, column)).second;
    if (!words.empty()) html += fmt::format("<dt>{}<dd>{}\n", escaped(column), escaped(words));
  }
  return html.empty()
             ? ""
             : "<details class=\"columns\"><summary>What the columns mean</summary><dl>\n" + html + "</dl></details>\n";
}

std::string heads_html(const std::vector<std::string>& columns, const Json* metadata, const std::string& file) {
  std::string html;
  for (const std::string& column : columns) {
    const std::string unit = unit_and_words(meaning_of(metadata, file, column)).first;
    html += "<th scope=\"col\">" + escaped(column) +
            (unit.empty() ? "" : fmt::format(" <small>[{}]</small>", escaped(unit)));
  }
  return html;
}

std::string command_of(const Json* metadata) {
  if (metadata == nullptr || !metadata->at("command_line").is_array()) return "";
  std::vector<std::string> words;
  for (const Json& word : metadata->at("command_line")) {
    if (word.is_string()) words.push_back(word.get<std::string>());
  }
  return fmt::format("{}", fmt::join(words, " "));
}

/// The columns whose fields differ between rows, and the others with what they hold, as words.
struct Split {
  std::vector<std::string> differing;
  std::vector<std::string> constant;
};

Split split(const Table& table) {
  Split result;
  for (const std::string& column : table.columns()) {
    std::set<std::string> fields;
    for (const Row& row : table.rows()) {
      fields.insert(row.text(column));
      if (fields.size() > 1) break;
    }
    if (fields.size() > 1 || table.rows().size() == 1) {
      result.differing.push_back(column);
    } else if (!fields.empty() && !fields.begin()->empty()) {
      result.constant.push_back(fmt::format("{} = {}", column, shortened(*fields.begin())));
    }
  }
  return result;
}

bool is_unsolved(const Row& row) { return !is_solved(status_named(row.text("status"))); }

/// Rows whose solve ended otherwise than solved are marked.
std::string row_html(const Row& row, const std::vector<std::string>& columns, bool has_status) {
  std::string html = has_status && is_unsolved(row) ? "<tr class=\"unsolved\">" : "<tr>";
  for (const std::string& column : columns) html += fmt::format("<td>{}", escaped(shortened(row.text(column))));
  return html + "\n";
}

std::string table_html(const ReportedTable& reported, const Json* metadata, const std::string& folder) {
  const Table& table = reported.table;
  const Split columns = split(table);
  const bool has_status = std::ranges::count(table.columns(), "status") > 0;
  const bool is_whole = table.rows().size() <= most_rows;
  const auto unsolved = has_status ? std::ranges::count_if(table.rows(), is_unsolved) : 0;
  std::string html = fmt::format("<details class=\"table\" id=\"{}\"><summary><b>{}</b> {} rows{}{}</summary>\n",
                                 anchor("table", reported.file), escaped(reported.file), table.rows().size(),
                                 unsolved > 0 ? fmt::format(", {} of them not solved", unsolved) : "",
                                 is_whole ? "" : fmt::format(", the first {} here", most_rows));
  if (metadata != nullptr && !metadata->value("complete", true))
    html += "<p class=\"warning\">The run is not complete.</p>\n";
  html += fmt::format("<p><a href=\"{0}{1}\" download>{1}</a> has all rows and digits.", escaped(folder),
                      escaped(reported.file));
  if (!columns.constant.empty()) html += escaped(fmt::format(" In all rows {}", fmt::join(columns.constant, ", ")));
  html += "</p>\n";
  if (const std::string command = command_of(metadata); !command.empty())
    html += fmt::format("<p>Made by <code>{}</code></p>\n", escaped(command));
  html += meanings_html(columns.differing, metadata, reported.file);
  html += fmt::format(
      "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"rows of "
      "{}\"><table><thead><tr>{}</thead><tbody>\n",
      escaped(reported.file), heads_html(columns.differing, metadata, reported.file));
  for (std::size_t i = 0; i < std::min(table.rows().size(), most_rows); ++i)
    html += row_html(table.rows()[i], columns.differing, has_status);
  return html + "</tbody></table></div></details>\n";
}

}  // namespace

std::string tables_section(const ResultsFolder& results, const std::string& folder) {
  if (results.tables.empty()) return "";
  std::string html =
      "<section id=\"tables\"><h2>Tables</h2>\n<p>A row is one solve where there is a status; rows that were not "
      "solved are "
      "marked. A column's unit stands in its head, its meaning above the table.</p>\n";
  for (const ReportedTable& table : results.tables) html += table_html(table, results.metadata_of(table.run), folder);
  return html + "</section>\n";
}

}  // namespace dmocbench
