#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

/// As long as it exists, records the fields that this thread reads, of rows with a place
/// (`Table::name_places`): the data of a conclusion from tables. The innermost one records.
class ReadFields {
 public:
  /// The fields read of a row.
  struct ReadRow {
    std::set<std::string, std::less<>> columns;  ///< their names
    bool has_number = false;                     ///< a field was read as a number, not only to choose the row
  };
  /// Fields by the places of rows.
  using ByPlace = std::map<std::string, ReadRow, std::less<>>;

  /// Begins to record.
  ReadFields();
  ~ReadFields();
  ReadFields(const ReadFields&) = delete;
  ReadFields& operator=(const ReadFields&) = delete;

  /// The fields read since it was made.
  [[nodiscard]] const ByPlace& rows() const noexcept { return rows_; }

 private:
  friend void note_read_field(const std::string& place, std::string_view column, bool is_number);
  ByPlace rows_;
  ReadFields* outer_;
};

/// Records the read in this thread's innermost `ReadFields`, if there is one; rows without a place are ignored.
void note_read_field(const std::string& place, std::string_view column, bool is_number);

/// A field of a table as written to files: a number with all its digits (%.17g), a text, or empty.
class Cell {
 public:
  Cell() = default;
  /// Text as it is.
  Cell(std::string text) : text_(std::move(text)) {}
  /// Text as it is.
  Cell(std::string_view text) : text_(text) {}
  /// Text as it is.
  Cell(const char* text) : text_(text) {}
  /// All digits of a number; empty for one that is not finite.
  Cell(double number);
  /// A whole number.
  template <std::integral Number>
  Cell(Number number) : text_(std::to_string(number)) {}
  /// Nothing where there is no value.
  template <class Value>
  Cell(const std::optional<Value>& value) : Cell(value ? Cell(*value) : Cell()) {}

  /// The field as written to files, before quoting.
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::string text_;
};

/// Numbers as one field of a table: seven digits each, with spaces between them.
[[nodiscard]] std::string joined_numbers(std::span<const double> numbers);

/// A row: fields by the names of their columns.
class Row {
 public:
  /// Gives the row a cell in the column with that name.
  void set(std::string_view column, Cell value) { cells_[std::string(column)] = std::move(value); }
  /// The field as written to files; empty if it is missing.
  [[nodiscard]] const std::string& text(std::string_view column) const;
  /// The field as a number; `missing` if it is empty or no finite number.
  [[nodiscard]] double number(std::string_view column, double missing) const {
    return number(column).value_or(missing);
  }
  /// The field as a number; empty if it is not a finite number.
  [[nodiscard]] std::optional<double> number(std::string_view column) const;
  /// The field as a number that has to be there. Throws `Error` that names the place, the column and the text there.
  [[nodiscard]] double needed(std::string_view column) const;
  /// The names of the columns in which the row has a cell, in their alphabetical order.
  [[nodiscard]] std::vector<std::string> columns() const;
  /// The numbers of a field that holds several (`joined_numbers`); none if it is empty. Throws `Error` that names the
  /// place and the column if something else stands there.
  [[nodiscard]] std::vector<double> numbers(std::string_view column) const;
  /// The place of the row, for errors: "objective.csv, record 2" (the header is record 1); empty if unknown.
  [[nodiscard]] const std::string& place() const noexcept { return place_; }
  /// Sets the place of the row, for errors.
  void set_place(std::string place) { place_ = std::move(place); }
  /// The fields of these columns as a line of comma-separated values (RFC 4180 quoting, ends with \n).
  [[nodiscard]] std::string csv(const std::vector<std::string>& columns) const;

 private:
  std::map<std::string, Cell, std::less<>> cells_;
  std::string place_;
};

/// The kinds of fields of a column.
enum class FieldKind : std::uint8_t {
  any,      ///< not declared
  text,     ///< as it is
  number,   ///< as `Cell(double)` writes it
  integer,  ///< a whole number
  boolean,  ///< 1 or 0
};

/// The permitted fields of a column.
struct FieldType {
  FieldKind kind = FieldKind::any;  ///< of the fields that are not empty
  bool may_be_empty = true;         ///< texts and numbers that are not finite may always be
};

/// What is known of a column besides its name.
struct ColumnFacts {
  std::string unit;     ///< "s"; empty for texts, counts and pure numbers
  std::string meaning;  ///< in words; empty where another table explains the column
  FieldType type = {};  ///< of its fields
};

/// A table with named columns. Missing values are empty fields.
class Table {
 public:
  Table() = default;
  /// A table without rows.
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  /// Their names, in their order.
  [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }
  /// The rows in the order in which they were added.
  [[nodiscard]] const std::vector<Row>& rows() const noexcept { return rows_; }
  /// Adds a row at the end.
  void append(Row row) { rows_.push_back(std::move(row)); }
  /// Units, meanings and types of columns by their names, which need not have one. They are not part of `csv`.
  [[nodiscard]] const std::map<std::string, ColumnFacts>& facts() const noexcept { return facts_; }
  /// Adds facts; earlier ones of a column stay.
  void describe(const std::map<std::string, ColumnFacts>& facts) { facts_.insert(facts.begin(), facts.end()); }
  /// The columns that identify a row; empty if not set. It is not part of `csv`.
  [[nodiscard]] const std::vector<std::string>& key() const noexcept { return key_; }
  /// Sets the columns that identify a row.
  void set_key(std::vector<std::string> key) { key_ = std::move(key); }
  /// Removes all rows.
  void clear() { rows_.clear(); }
  /// Gives every row its place in a file of this name.
  void name_places(const std::string& file);

  /// A header line, then a line per row (`Row::csv`).
  [[nodiscard]] std::string csv() const;
  /// Reads the text that `csv` writes. Throws `Error` that names the line if a row has another number of fields than
  /// the header.
  [[nodiscard]] static Table from_csv(std::string_view text);

 private:
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
  std::map<std::string, ColumnFacts> facts_;
  std::vector<std::string> key_;  ///< names of columns
};

/// The content of a regular file; others might have no end. Throws `Error` that names it if it cannot be read.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// The table in a text, which stands in a file of this name. Throws `Error` that names the file if it is not a table.
[[nodiscard]] Table table_in(const std::string& text, const std::filesystem::path& file);

/// The table in a file that `Table::csv` wrote. Throws `Error` that names the file if it cannot be read or is not a
/// table.
[[nodiscard]] Table read_table(const std::filesystem::path& file);

}  // namespace dmocbench
