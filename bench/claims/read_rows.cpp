#include "bench/claims/read_rows.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

/// The fields read from the rows of one table, by their records.
using RowsOfTable = std::map<std::size_t, const ReadFields::ReadRow*>;

/// The rows grouped by table, according to their places ("objective.csv, record 2").
std::map<std::string, RowsOfTable> by_tables(const ReadFields& fields) {
  constexpr std::string_view mark = ", record ";
  std::map<std::string, RowsOfTable> tables;
  for (const auto& [place, row] : fields.rows()) {
    const std::size_t at = place.rfind(mark);
    if (at == std::string::npos) continue;
    if (const auto record = parsed<std::size_t>(std::string_view(place).substr(at + mark.size())))
      tables[place.substr(0, at)][*record] = &row;
  }
  return tables;
}

ReadRows rows_behind(const std::string& table, const RowsOfTable& rows) {
  const bool has_numbers = std::ranges::any_of(rows, [](const auto& row) { return row.second->has_number; });
  ReadRows result{.table = table, .records = {}, .columns = {}};
  std::set<std::string> columns;
  for (const auto& [record, row] : rows) {
    if (has_numbers && !row->has_number) continue;
    result.records.push_back(record);
    columns.insert(row->columns.begin(), row->columns.end());
  }
  result.columns.assign(columns.begin(), columns.end());
  return result;
}

}  // namespace

std::map<std::string, std::set<std::string>> read_columns(const ReadFields& fields) {
  std::map<std::string, std::set<std::string>> columns;
  for (const auto& [table, rows] : by_tables(fields)) {
    for (const auto& [record, row] : rows) columns[table].insert(row->columns.begin(), row->columns.end());
  }
  return columns;
}

std::vector<ReadRows> read_rows(const ReadFields& fields) {
  std::vector<ReadRows> result;
  for (const auto& [table, rows] : by_tables(fields)) result.push_back(rows_behind(table, rows));
  return result;
}

std::string packed_ranges(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : " ", numbers[i]);
    if (last > i) text += fmt::format("-{}", numbers[last]);
    i = last + 1;
  }
  return text;
}

}  // namespace dmocbench
