#include "bench/run/run_summary.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <ranges>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/run/solve_case.hpp"
#include "methods/program/status.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

/// ", 3 too coarse (dmoc 1, tangent 2)"; empty if the count is 0.
std::string counted_by_method(Status status, const std::map<std::string, std::ptrdiff_t>& by_method) {
  std::ptrdiff_t all = 0;
  std::vector<std::string> counts;
  for (const auto& [method, count] : by_method) {
    all += count;
    counts.push_back(fmt::format("{} {}", method, count));
  }
  return all == 0 ? "" : fmt::format(", {} {} ({})", all, name_of(status), fmt::join(counts, ", "));
}

}  // namespace

Outcome outcome_of(const Table& table) {
  Outcome outcome;
  std::map<std::string, std::ptrdiff_t> coarse;
  std::map<std::string, std::ptrdiff_t> violating;
  std::map<std::vector<std::string>, bool> is_usable_curve;
  for (const Row& row : table.rows()) {
    std::vector<std::string> curve;
    for (const char* const column : {"problem", "library", "method", "tableau", "stages", "solver", "derivatives"})
      curve.push_back(row.text(column));
    is_usable_curve[curve] |= is_usable(row);
    const std::string& status = row.text("status");
    if (status == name_of(Status::too_coarse)) {
      ++outcome.too_coarse;
      ++coarse[row.text("method")];
    } else if (status == name_of(Status::violates_between_stages)) {
      ++outcome.violating;
      ++violating[row.text("method")];
    } else if (!is_solved(status_named(status))) {
      if (++outcome.failures == 1) {
        outcome.first_failure = fmt::format("{} {} N = {}: {}", row.text("problem"), row.text("method"),
                                            row.text("intervals"), row.text("message"));
      }
    }
    if (row.text("branch") == "other") ++outcome.other_branch;
  }
  outcome.unusable_curves = std::ranges::count(is_usable_curve | std::views::values, false);
  outcome.no_motions_by_method =
      counted_by_method(Status::too_coarse, coarse) + counted_by_method(Status::violates_between_stages, violating);
  return outcome;
}

void describe(const Outcome& outcome, nlohmann::ordered_json& metadata) {
  metadata["not_solved"] = outcome.failures;
  metadata["too_coarse"] = outcome.too_coarse;
  metadata["violates_between_stages"] = outcome.violating;
  metadata["on_another_branch"] = outcome.other_branch;
}

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
  line.flag("--quiet", is_quiet_, "print only errors", OptionRole::machine);
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
