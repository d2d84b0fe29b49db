#include "bench/report/table_markup.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/report/html.hpp"
#include "methods/program/status.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// The meaning of a column in a run's metadata, "[s] median time of a solve"; may be empty.
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

std::string heads_html(const std::vector<std::string>& columns, const Json* metadata, const std::string& file) {
  std::string html;
  for (const std::string& column : columns) {
    const std::string unit = unit_and_words(meaning_of(metadata, file, column)).first;
    html += "<th scope=\"col\">" + escaped(column) +
            (unit.empty() ? "" : fmt::format(" <small>[{}]</small>", escaped(unit)));
  }
  return html;
}

std::string row_html(const Row& row, const std::vector<std::string>& columns, bool has_status) {
  std::string html = has_status && is_unsolved(row) ? "<tr class=\"unsolved\">" : "<tr>";
  for (const std::string& column : columns) html += fmt::format("<td>{}", escaped(shortened(row.text(column))));
  return html + "\n";
}

}  // namespace

SplitColumns split_columns(const Table& table, const std::vector<std::string>& columns) {
  SplitColumns result;
  for (const std::string& column : columns) {
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

std::string meaning_in_words(const Json* metadata, const std::string& file, const std::string& column) {
  return unit_and_words(meaning_of(metadata, file, column)).second;
}

std::string command_of(const Json* metadata) {
  if (metadata == nullptr || !metadata->at("command_line").is_array()) return "";
  std::vector<std::string> words;
  for (const Json& word : metadata->at("command_line")) {
    if (word.is_string()) words.push_back(word.get<std::string>());
  }
  return fmt::format("{}", fmt::join(words, " "));
}

bool is_unsolved(const Row& row) { return !is_solved(status_named(row.text("status"))); }

std::string rows_markup(const Table& table, const std::vector<std::string>& columns, std::size_t most,
                        const Json* metadata, const std::string& file) {
  const bool has_status = std::ranges::count(table.columns(), "status") > 0;
  std::string html = fmt::format(
      "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"rows of "
      "{}\"><table><thead><tr>{}</thead><tbody>\n",
      escaped(file), heads_html(columns, metadata, file));
  for (std::size_t i = 0; i < std::min(table.rows().size(), most); ++i)
    html += row_html(table.rows()[i], columns, has_status);
  return html + "</tbody></table></div>\n";
}

}  // namespace dmocbench
