#include "bench/claims/read_rows.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "methods/runtime/parsed.hpp"

namespace dmocbench {

namespace {

/// What was read of the rows of one table, by their records.
using RowsOfTable = std::map<std::size_t, const ReadFields::OfRow*>;

/// Puts a row where "objective.csv, record 2" says that it stands.
void sort_in(const std::string& place, const ReadFields::OfRow& row, std::map<std::string, RowsOfTable>& tables) {
  constexpr std::string_view mark = ", record ";
  const std::size_t at = place.rfind(mark);
  if (at == std::string::npos) return;
  if (const auto record = parsed<std::size_t>(std::string_view(place).substr(at + mark.size())))
    tables[place.substr(0, at)][*record] = &row;
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

std::vector<ReadRows> read_rows(const ReadFields& fields) {
  std::map<std::string, RowsOfTable> tables;
  for (const auto& [place, row] : fields.rows()) sort_in(place, row, tables);
  std::vector<ReadRows> result;
  result.reserve(tables.size());
  for (const auto& [table, rows] : tables) result.push_back(rows_behind(table, rows));
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
