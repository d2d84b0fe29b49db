#include "bench/tables/selection.hpp"

#include <map>

#include "bench/run/solve_case.hpp"

namespace dmocbench {

namespace {

const Row no_row{};

std::vector<std::string> key_of(const Row& row, const ColumnNames& columns) {
  std::vector<std::string> key;
  std::ranges::transform(columns, std::back_inserter(key), [&](const std::string& column) { return row.text(column); });
  return key;
}

}  // namespace

const Row& Selection::front() const { return empty() ? no_row : rows_.front().get(); }
const Row& Selection::back() const { return empty() ? no_row : rows_.back().get(); }

Selection Selection::where(std::string_view column, std::string_view text) const {
  return where([&](const Row& row) { return row.text(column) == text; });
}

Selection Selection::matching(const Row& row, const ColumnNames& columns) const {
  const std::vector<std::string> key = key_of(row, columns);
  return where([&](const Row& other) {
    return std::ranges::equal(columns, key, {}, [&](const std::string& column) { return other.text(column); });
  });
}

Selection Selection::with_number(const std::string& column) const {
  return where([&](const Row& row) { return row.number(column).has_value(); });
}

Selection Selection::usable() const {
  return where([](const Row& row) { return is_usable(row); });
}

Selection Selection::sorted_by(const std::string& column) const {
  Selection sorted = with_number(column);
  std::ranges::stable_sort(sorted.rows_, {}, [&](const Row& row) { return *row.number(column); });
  return sorted;
}

std::vector<Selection> Selection::group_by(const ColumnNames& columns) const {
  std::vector<Selection> groups;
  std::map<std::vector<std::string>, std::size_t> places;
  for (const Row& row : rows_) {
    const std::size_t place = places.try_emplace(key_of(row, columns), groups.size()).first->second;
    if (place == groups.size()) groups.emplace_back();
    groups[place].append(row);
  }
  return groups;
}

std::vector<std::string> Selection::distinct(const std::string& column) const {
  std::vector<std::string> texts;
  for (const Selection& group : group_by({column})) texts.push_back(group.front().text(column));
  return texts;
}

double Selection::max(const std::string& column) const {
  return max([&](const Row& row) { return row.needed(column); });
}

double Selection::min(const std::string& column) const {
  return -max([&](const Row& row) { return -row.needed(column); });
}

Row fields_of(const Row& row, const ColumnNames& columns) {
  Row fields;
  for (const std::string& column : columns) fields.set(column, row.text(column));
  return fields;
}

std::optional<double> ratio(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b || !(*b > 0.0)) return std::nullopt;
  return *a / *b;
}

}  // namespace dmocbench
