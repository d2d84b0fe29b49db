#include "methods/tables/table.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <ranges>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/error.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

thread_local ReadFields* innermost = nullptr;  // NOLINT(misc-use-internal-linkage): is internal

}  // namespace

ReadFields::ReadFields() : outer_(std::exchange(innermost, this)) {}

ReadFields::~ReadFields() { innermost = outer_; }

void note_read_field(const std::string& place, std::string_view column, bool is_number) {
  if (innermost == nullptr || place.empty()) return;
  ReadFields::ReadRow& row = innermost->rows_[place];
  row.has_number = row.has_number || is_number;
  if (!row.columns.contains(column)) row.columns.emplace(column);
}

namespace {

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\n\r") == std::string::npos) return field;
  std::string result = "\"";
  for (const char c : field) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

/// Reads one record and moves `rest` past it.
std::vector<std::string> take_record(std::string_view& rest) {
  std::vector<std::string> fields(1);
  bool inside_quotes = false;
  std::size_t i = 0;
  for (; i < rest.size(); ++i) {
    const char c = rest[i];
    if (c == '"') {
      inside_quotes = !inside_quotes;
      if (inside_quotes && i > 0 && rest[i - 1] == '"') fields.back() += c;  // a quote in quotes is written twice
    } else if (inside_quotes || (c != ',' && c != '\n' && c != '\r')) {
      fields.back() += c;
    } else if (c == ',') {
      fields.emplace_back();
    } else if (c == '\n') {
      ++i;
      break;
    }
  }
  rest.remove_prefix(i);
  return fields;
}

}  // namespace

Cell::Cell(double number) : text_(std::isfinite(number) ? fmt::format("{:.17g}", number) : "") {}

const std::string& Row::text(std::string_view column) const {
  static const std::string nothing;
  note_read_field(place_, column, false);
  const auto found = cells_.find(column);
  return found == cells_.end() ? nothing : found->second.text();
}

std::optional<double> Row::number(std::string_view column) const {
  note_read_field(place_, column, true);
  const auto value = parsed<double>(text(column));
  return value && std::isfinite(*value) ? value : std::nullopt;
}

double Row::needed(std::string_view column) const {
  if (const auto value = number(column)) return *value;
  const std::string& field = text(column);
  throw Error("{}, column {}: {}", place_.empty() ? "a row" : place_, column,
              field.empty() ? "there is no number" : "\"" + field + "\" is not a finite number");
}

std::vector<std::string> Row::columns() const {
  const auto names = std::views::keys(cells_);
  return {names.begin(), names.end()};
}

std::vector<double> Row::numbers(std::string_view column) const {
  note_read_field(place_, column, true);
  const std::string& field = text(column);
  std::vector<double> numbers;
  for (std::string_view rest = field; !rest.empty();) {
    const std::string_view word = rest.substr(0, rest.find(' '));
    const auto number = parsed<double>(word);
    if (!number || !std::isfinite(*number)) {
      throw Error("{}, column {}: \"{}\" is not a finite number", place_.empty() ? "a row" : place_, column, word);
    }
    numbers.push_back(*number);
    rest.remove_prefix(std::min(word.size() + 1, rest.size()));
  }
  return numbers;
}

std::string Row::csv(const std::vector<std::string>& columns) const {
  const auto field = [this](const std::string& column) { return quoted(text(column)); };
  return fmt::format("{}\n", fmt::join(columns | std::views::transform(field), ","));
}

std::string joined_numbers(std::span<const double> numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(fmt::format("{:.7g}", number));
  return fmt::format("{}", fmt::join(texts, " "));
}

void Table::name_places(const std::string& file) {
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].set_place(fmt::format("{}, record {}", file, i + 2));
}

std::string Table::csv() const {
  std::string text = fmt::format("{}\n", fmt::join(columns_ | std::views::transform(quoted), ","));
  for (const Row& row : rows_) text += row.csv(columns_);
  return text;
}

Table Table::from_csv(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // with which spreadsheets begin a file
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  Table table(take_record(text));
  for (std::size_t line = 2; !text.empty(); ++line) {
    const std::vector<std::string> fields = take_record(text);
    if (fields.size() != table.columns_.size()) {
      throw Error("record {} has {} fields, but the header has {}", line, fields.size(), table.columns_.size());
    }
    Row row;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (!fields[i].empty()) row.set(table.columns_[i], fields[i]);
    }
    table.append(std::move(row));
  }
  return table;
}

std::string read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error("cannot read {}: it is a folder", path.string());
  }
  if (std::filesystem::is_other(path, ignored)) {
    throw Error("cannot read {}: it is not a regular file; copy its contents to one", path.string());
  }
  try {
    std::ifstream stream(path, std::ios::binary);
    std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (stream) return content;
  } catch (const std::ios_base::failure&) {  // the opened file cannot be read
  }
  throw Error("cannot read {}", path.string());
}

Table table_in(const std::string& text, const std::filesystem::path& file) {
  try {
    return Table::from_csv(text);
  } catch (const Error& error) {
    throw Error("{}: {}", file.string(), error.what());
  }
}

Table read_table(const std::filesystem::path& file) { return table_in(read_file(file), file); }

}  // namespace dmocbench
