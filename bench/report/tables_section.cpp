#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/table_markup.hpp"
#include "methods/runtime/counted.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// The meanings of the columns in an expandable element; empty if they are unknown.
std::string meanings_html(const std::vector<std::string>& columns, const Json* metadata, const std::string& file) {
  std::string html;
  for (const std::string& column : columns) {
    const std::string words = meaning_in_words(metadata, file, column);
    if (!words.empty()) html += fmt::format("<dt>{}<dd>{}\n", escaped(column), escaped(words));
  }
  return html.empty() ? ""
                      : "<details class=\"columns\"><summary>Meaning of the columns</summary><dl>\n" + html +
                            "</dl></details>\n";
}

std::string table_html(const ReportedTable& reported, const Json* metadata, const std::string& folder) {
  const Table& table = reported.table;
  SplitColumns columns = split_columns(table, table.columns());
  std::ranges::stable_partition(columns.differing, [](const std::string& column) { return column == "status"; });
  const bool has_status = std::ranges::count(table.columns(), "status") > 0;
  const bool is_whole = table.rows().size() <= most_rows;
  const auto unsolved = has_status ? std::ranges::count_if(table.rows(), is_unsolved) : 0;
  std::string html =
      fmt::format("<details class=\"table\" id=\"{}\"><summary><b>{}</b> {}{}{}</summary>\n",
                  anchor("table", reported.file), escaped(reported.file), counted(table.rows().size(), "row"),
                  unsolved > 0 ? fmt::format(", {} of them not solved", unsolved) : "",
                  is_whole ? "" : fmt::format(", the first {} here", most_rows));
  if (metadata != nullptr && !metadata->value("complete", true))
    html += "<p class=\"warning\">The run is not complete.</p>\n";
  html += fmt::format("<p><a href=\"{}\" download>{}</a> has {}.", link_to_file(folder + reported.file),
                      escaped(reported.file), table.rows().empty() ? "no row" : "all rows and digits");
  if (!columns.constant.empty())
    html += escaped_prose(fmt::format(" In all rows {}", fmt::join(columns.constant, ", ")));
  html += "</p>\n";
  if (const std::string command = command_of(metadata); !command.empty())
    html += fmt::format("<p>Made by <code>{}</code></p>\n", escaped(command));
  if (table.rows().empty()) return html + "</details>\n";
  html += meanings_html(columns.differing, metadata, reported.file);
  return html + rows_markup(table, columns.differing, most_rows, metadata, reported.file) + "</details>\n";
}

}  // namespace

std::string tables_section(const ResultsFolder& results, const std::string& folder) {
  if (results.tables.empty()) return "";
  std::string html = fmt::format(
      "<section id=\"tables\"><h2>Tables</h2>\n<p>A row is one solve where there is a status; rows that were not "
      "solved are marked. A column's unit is in its head, its meaning above the table. The files with all rows are not "
      "part of this page but {}: the page alone does not include them.</p>\n",
      folder.empty() ? "next to it" : escaped("in the folder " + folder + " next to it"));
  for (const ReportedTable& table : results.tables) html += table_html(table, results.metadata_of(table.run), folder);
  return html + "</section>\n";
}

}  // namespace dmocbench
