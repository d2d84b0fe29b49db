#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dmocbench {

/// A field of a table: nothing, a whole number, a number or a text.
using Cell = std::variant<std::monostate, long long, double, std::string>;

/// A row: fields by the names of their columns.
class Row {
 public:
  void set(std::string_view column, Cell value) { cells_[std::string(column)] = std::move(value); }
  void set(std::string_view column, const char* value) { set(column, Cell(std::string(value))); }
  template <class Number>
  void set(std::string_view column, const std::optional<Number>& value) {
    if (value)
      set(column, Cell(static_cast<std::conditional_t<std::is_integral_v<Number>, long long, double>>(*value)));
  }
  /// The field as it is written to a file; empty if there is none.
  [[nodiscard]] std::string text(std::string_view column) const;
  /// The field as a number; `missing` if it is empty or no number.
  [[nodiscard]] double number(std::string_view column, double missing) const {
    return number(column).value_or(missing);
  }
  /// The field as a number; none if it is empty or no number.
  [[nodiscard]] std::optional<double> number(std::string_view column) const;

 private:
  std::map<std::string, Cell, std::less<>> cells_;
};

/// A table with named columns. Numbers are written with all their digits (%.17g); what does not exist is an empty
/// field.
class Table {
 public:
  Table() = default;
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }
  [[nodiscard]] const std::vector<Row>& rows() const noexcept { return rows_; }
  void append(Row row) { rows_.push_back(std::move(row)); }
  void clear() { rows_.clear(); }

  /// Comma-separated values with one header line (RFC 4180 quoting, lines end with \n).
  [[nodiscard]] std::string csv() const;
  /// Reads what `csv` writes. Throws `Error` that names the line if a row has another number of fields than the header.
  [[nodiscard]] static Table from_csv(std::string_view text);

 private:
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
};

}  // namespace dmocbench
