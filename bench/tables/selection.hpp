#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// Names of columns, in their order.
using ColumnNames = std::vector<std::string>;

/// Rows of a table in its order: picked, grouped, joined and summarised.
///
/// A selection points into its table, which must outlive it. Fields are compared as the texts that stand in a file.
class Selection {
 public:
  /// No rows.
  Selection() = default;
  /// All rows; implicit, so that whatever reads rows takes a table as well.
  Selection(const Table& table) : rows_(table.rows().begin(), table.rows().end()) {}

  [[nodiscard]] auto begin() const noexcept { return rows_.begin(); }       ///< the first row
  [[nodiscard]] auto end() const noexcept { return rows_.end(); }           ///< past the last row
  [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }  ///< number of rows
  [[nodiscard]] bool empty() const noexcept { return rows_.empty(); }       ///< whether there is no row
  [[nodiscard]] const Row& front() const;  ///< the first row; a row without fields if the selection is empty
  [[nodiscard]] const Row& back() const;   ///< the last row; a row without fields if the selection is empty

  /// Adds a row at the end.
  void append(const Row& row) { rows_.emplace_back(row); }
  /// Adds rows at the end.
  void append(const Selection& rows) { rows_.insert(rows_.end(), rows.begin(), rows.end()); }

  /// The rows that a predicate keeps.
  template <std::predicate<const Row&> Predicate>
  [[nodiscard]] Selection where(const Predicate& keeps) const {
    Selection kept;
    std::ranges::copy_if(rows_, std::back_inserter(kept.rows_), keeps);
    return kept;
  }
  /// The rows with a text in a column.
  [[nodiscard]] Selection where(std::string_view column, std::string_view text) const;
  /// The rows that have the same fields as `row` in some columns: joins two selections.
  [[nodiscard]] Selection matching(const Row& row, const ColumnNames& columns) const;
  /// The rows with a number in a column.
  [[nodiscard]] Selection with_number(const std::string& column) const;
  /// The rows that were solved on the wanted branch.
  [[nodiscard]] Selection usable() const;
  /// Whether all rows were.
  [[nodiscard]] bool are_usable() const { return usable().size() == size(); }
  /// The rows with a number in a column, by that number.
  [[nodiscard]] Selection sorted_by(const std::string& column) const;

  /// The rows with equal fields in some columns together, groups in the order of their first rows.
  [[nodiscard]] std::vector<Selection> group_by(const ColumnNames& columns) const;
  /// The texts of a column, each once, in the order in which they come.
  [[nodiscard]] std::vector<std::string> distinct(const std::string& column) const;

  /// The largest value of a function of a row; -∞ without rows.
  template <std::invocable<const Row&> Value>
  [[nodiscard]] double max(const Value& value) const {
    double largest = -std::numeric_limits<double>::infinity();
    for (const Row& row : rows_) largest = std::max(largest, value(row));
    return largest;
  }
  /// The largest number of a column; -∞ without rows. Throws `Error` if a row lacks the number.
  [[nodiscard]] double max(const std::string& column) const;
  /// The smallest number of a column; ∞ without rows. Throws `Error` if a row lacks the number.
  [[nodiscard]] double min(const std::string& column) const;

  /// The rows in words, with a separator between them.
  template <std::invocable<const Row&> Words>
  [[nodiscard]] std::string in_words(std::string_view separator, const Words& words) const {
    std::vector<std::string> parts;
    std::ranges::transform(rows_, std::back_inserter(parts), words);
    return fmt::format("{}", fmt::join(parts, separator));
  }

 private:
  std::vector<std::reference_wrapper<const Row>> rows_;
};

/// A row with the fields of another in some columns.
[[nodiscard]] Row fields_of(const Row& row, const ColumnNames& columns);

/// a / b; empty if one of them is missing or b is not positive.
[[nodiscard]] std::optional<double> ratio(const std::optional<double>& a, const std::optional<double>& b);

}  // namespace dmocbench
