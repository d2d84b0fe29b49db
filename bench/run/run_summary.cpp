#include "bench/run/run_summary.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// A field for people: five digits of a number that has more.
std::string shown(const std::string& field) {
  constexpr std::size_t few_letters = 8;
  const auto number = parsed<double>(field);
  return number && field.size() > few_letters ? fmt::format("{:.5g}", *number) : field;
}

Json value_of(const std::string& field) {
  if (field.empty()) return nullptr;
  if (const auto count = parsed<long long>(field)) return *count;
  if (const auto number = parsed<double>(field)) return *number;
  return field;
}

/// Letters of a text on a terminal: bytes that begin one.
std::size_t width_of(const std::string& text) {
  constexpr unsigned char mask = 0xc0;
  constexpr unsigned char continuation = 0x80;
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char byte) { return (static_cast<unsigned char>(byte) & mask) != continuation; }));
}

void print_aligned(const std::vector<std::vector<std::string>>& lines) {
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], width_of(line[i]));
  }
  for (const auto& line : lines) {
    std::string text;
    for (std::size_t i = 0; i < widths.size(); ++i) {
      text += line[i];
      if (i + 1 < widths.size()) text += std::string(widths[i] - width_of(line[i]) + 2, ' ');
    }
    print_line(text);
  }
}

bool differs(const Table& table, const std::string& column) {
  return std::ranges::any_of(table.rows(),
                             [&](const Row& row) { return row.text(column) != table.rows().front().text(column); });
}

/// The chosen columns, and columns of the key in which rows differ. Columns of the key come first, in its order.
std::vector<std::string> with_distinguishing(const std::vector<std::string>& chosen, const Table& table) {
  const auto contains = [](const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  std::vector<std::string> columns;
  for (const std::string& column : table.key()) {
    if (contains(chosen, column) || differs(table, column)) columns.push_back(column);
  }
  std::ranges::copy_if(chosen, std::back_inserter(columns),
                       [&](const std::string& column) { return !contains(table.key(), column); });
  return columns;
}

}  // namespace

void RunSummary::add_to(CommandLine& line) {
  line.flag("--quiet", is_quiet_, "print errors only", OptionRole::machine);
  line.flag("--json", as_json_, "print the findings as one JSON object", OptionRole::machine);
}

void RunSummary::say(const std::string& sentence) {
  sentences_.push_back(sentence);
  if (are_for_people()) print_line(sentence);
}

void RunSummary::show(const std::string& name, const Table& table, const std::vector<std::string>& columns,
                      const std::string& file, std::size_t most_rows) {
  Json rows = Json::array();
  const std::vector<std::string> chosen = with_distinguishing(columns.empty() ? table.columns() : columns, table);
  std::vector<std::vector<std::string>> lines{chosen};
  for (const Row& row : table.rows()) {
    Json object = Json::object();
    std::vector<std::string> line;
    for (const std::string& column : chosen) {
      object[column] = value_of(row.text(column));
      line.push_back(shown(row.text(column)));
    }
    rows.push_back(std::move(object));
    if (lines.size() <= most_rows) lines.push_back(std::move(line));
  }
  tables_[name] = std::move(rows);
  if (!are_for_people() || table.rows().empty()) return;
  print_aligned(lines);
  const std::size_t left = table.rows().size() + 1 - lines.size();
  if (left > 0) print_line(fmt::format("... and {} more{}", left, file.empty() ? "" : " in " + file));
}

void RunSummary::end(const Json& outcome) const {
  if (is_quiet_ || !as_json_) return;
  Json object = outcome;
  object["findings"] = sentences_;
  object["tables"] = tables_;
  fmt::print("{}\n", object.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace dmocbench
