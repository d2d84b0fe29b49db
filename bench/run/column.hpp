#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// The field type for getters that return `Value`; unknown for `Cell`.
template <class Value>
[[nodiscard]] constexpr FieldType field_type() {
  if constexpr (std::same_as<Value, bool>) {
    return {FieldKind::boolean, false};
  } else if constexpr (std::integral<Value>) {
    return {FieldKind::integer, false};
  } else if constexpr (std::floating_point<Value>) {
    return {FieldKind::number, true};
  } else if constexpr (std::convertible_to<Value, std::string_view>) {
    return {FieldKind::text, true};
  } else if constexpr (requires(Value value) { value.has_value(); }) {
    return {field_type<typename Value::value_type>().kind, true};
  } else {
    return {};
  }
}

/// Reads a field of a record: any function, or a pointer to a member, whose value a `Cell` can be made of.
template <class Record>
class FieldReader {
 public:
  /// Of a function or a pointer to a member; implicit, so that columns are written as lists.
  template <class Function>
    requires(!std::same_as<Function, FieldReader> && std::invocable<const Function&, const Record&>)
  FieldReader(Function function)
      : type_(field_type<std::remove_cvref_t<std::invoke_result_t<const Function&, const Record&>>>()),
        read_(std::move(function)) {}
  /// For a function that writes its fields itself, so that their type must be given.
  template <class Function>
  FieldReader(Function function, FieldType type) : type_(type), read_(std::move(function)) {}
  /// The field of a record.
  [[nodiscard]] Cell operator()(const Record& record) const { return read_(record); }
  /// As it was given, or else by the type that the function returns.
  [[nodiscard]] FieldType type() const noexcept { return type_; }

 private:
  FieldType type_;
  std::function<Cell(const Record&)> read_;
};

/// A column of a table that has a row per `Record`.
template <class Record>
struct Column {
  std::string name;          ///< as in the first line of a table
  std::string unit;          ///< empty for texts, counts and numbers without unit
  std::string meaning;       ///< in words, for `--help`
  FieldReader<Record> cell;  ///< the record's field
  bool is_key = false;       ///< whether it is part of the table's key
};

/// Follows a column's field: the column is part of the key, which distinguishes the rows of a table.
inline constexpr bool in_key = true;

/// The columns of a table whose rows are made of records.
template <class Record>
using Columns = std::vector<Column<Record>>;

/// The row of a record: a cell for every column.
template <class Record>
[[nodiscard]] Row row_of(const Columns<Record>& columns, const Record& record) {
  Row row;
  for (const Column<Record>& column : columns) row.set(column.name, column.cell(record));
  return row;
}

/// The names of columns, in their order.
template <class Record>
[[nodiscard]] std::vector<std::string> names_of(const Columns<Record>& columns) {
  std::vector<std::string> names;
  for (const Column<Record>& column : columns) names.push_back(column.name);
  return names;
}

/// The names of the columns that are the key.
template <class Record>
[[nodiscard]] std::vector<std::string> key_of(const Columns<Record>& columns) {
  std::vector<std::string> key;
  for (const Column<Record>& column : columns) {
    if (column.is_key) key.push_back(column.name);
  }
  return key;
}

/// The facts of columns by their names. Columns of which nothing is known, since another table explains them, are left
/// out.
template <class Record>
[[nodiscard]] std::map<std::string, ColumnFacts> facts_of(const Columns<Record>& columns) {
  std::map<std::string, ColumnFacts> facts;
  for (const Column<Record>& column : columns) {
    const FieldType type = column.cell.type();
    if (column.meaning.empty() && type.kind == FieldKind::any) continue;
    facts[column.name] = {column.unit, column.meaning, type};
  }
  return facts;
}

/// The table of records: a row for each.
template <class Record, std::ranges::input_range Records = std::vector<Record>>
[[nodiscard]] Table table_of(const Columns<Record>& columns, const Records& records) {
  Table table(names_of(columns));
  table.describe(facts_of(columns));
  table.set_key(key_of(columns));
  for (const Record& record : records) table.append(row_of(columns, record));
  return table;
}

/// A line per column: "NAME [UNIT]: MEANING".
template <class Record>
[[nodiscard]] std::string describe(const Columns<Record>& columns) {
  std::string text;
  for (const Column<Record>& column : columns) {
    const std::string unit = column.unit.empty() ? "" : " [" + column.unit + "]";
    text += fmt::format("  {}{}: {}\n", column.name, unit, column.meaning);
  }
  return text;
}

/// Columns side by side.
template <class Record>
[[nodiscard]] Columns<Record> operator+(Columns<Record> left, const Columns<Record>& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

/// The columns of a part of each record, which a function or a pointer to a member finds:
/// `columns_through<Measured>(&Measured::checks, check_columns())`.
template <class Record, class Part, class Function>
[[nodiscard]] Columns<Record> columns_through(Function part, const Columns<Part>& columns) {
  Columns<Record> result;
  for (const Column<Part>& column : columns) {
    const auto read = [part, cell = column.cell](const Record& record) { return cell(std::invoke(part, record)); };
    result.push_back(
        {column.name, column.unit, column.meaning, FieldReader<Record>(read, column.cell.type()), column.is_key});
  }
  return result;
}

/// A group of columns of variable count, one for each name; `cell_of(i)` reads the field of the i-th.
template <class Record, class CellOf>
[[nodiscard]] Columns<Record> column_group(const std::vector<std::string>& names, const std::string& unit,
                                           const std::string& meaning, const CellOf& cell_of) {
  Columns<Record> columns;
  for (std::size_t i = 0; i < names.size(); ++i) columns.push_back({names[i], unit, meaning, cell_of(i)});
  return columns;
}

/// Columns that a summary copies from a row of the table it summarizes, `Record::head`; that table explains them.
/// `is_key`: they are part of the summary's key.
template <class Record>
[[nodiscard]] Columns<Record> head_columns(const std::vector<std::string>& names, bool is_key = false) {
  Columns<Record> columns;
  for (const std::string& name : names) {
    const auto text = [name](const Record& record) { return Cell(record.head.text(name)); };
    columns.push_back({name, "", "", FieldReader<Record>(text, FieldType()), is_key});
  }
  return columns;
}

/// How tables write that something holds.
[[nodiscard]] constexpr const char* yes_or_no(bool holds) { return holds ? "yes" : "no"; }

/// A value that may be missing: for an optional, the contained value.
template <class Value>
struct Optional {
  /// An optional that holds no other one.
  using type = std::optional<Value>;
};
/// Of an optional it is the optional itself.
template <class Value>
struct Optional<std::optional<Value>> {
  /// As it is.
  using type = std::optional<Value>;
};

/// The member of a member ... of an object; an optional where an optional or a pointer on the way may be empty.
template <class Object>
[[nodiscard]] Object member(const Object& object) {
  return object;
}
/// A member of a member: `member(object, &A::b, &B::c)`.
template <class Object, class First, class... Rest>
[[nodiscard]] auto member(const Object& object, First first, Rest... rest) {
  if constexpr (requires { *object; }) {  // an optional or a pointer; std::invoke would not ask whether it is empty
    using Found = typename Optional<decltype(member(*object, first, rest...))>::type;
    return object ? Found(member(*object, first, rest...)) : Found();
  } else {
    return member(std::invoke(first, object), rest...);
  }
}

/// Reads a field from the record: `from(&SolvedCase::solution, &Solution::seconds)`.
template <class... Members>
[[nodiscard]] auto from(Members... members) {
  return [=](const auto& record) { return member(record, members...); };
}

/// The scheme that a row is about in tables without solves.
struct Scheme {
  std::string problem;      ///< its name
  std::string method;       ///< its family of elements
  std::string tableau;      ///< its family of Butcher tableaus
  Eigen::Index stages = 0;  ///< s
};

/// The columns of `Record::scheme`.
template <class Record>
[[nodiscard]] Columns<Record> scheme_columns() {
  constexpr auto scheme = &Record::scheme;
  return {{"problem", "", "name of the problem", from(scheme, &Scheme::problem), in_key},
          {"method", "", "family of elements, or an integrator", from(scheme, &Scheme::method), in_key},
          {"tableau", "", "family of Butcher tableaus", from(scheme, &Scheme::tableau), in_key},
          {"stages", "", "number of stages s", from(scheme, &Scheme::stages), in_key}};
}

/// The standard error of a fitted order; empty with two points.
[[nodiscard]] inline std::optional<double> standard_error_of(const FittedOrder& fit) {
  return fit.points > 2 ? std::optional(fit.standard_error) : std::nullopt;
}

/// The columns of a fitted order.
template <class Record>
[[nodiscard]] Columns<Record> fitted_order_columns(FittedOrder Record::*fit) {
  return {{"slope", "", "fitted order", from(fit, &FittedOrder::order)},
          {"standard_error", "", "standard error of the order; empty with two points", from(fit, standard_error_of)},
          {"finest", "", "smallest step size of the fit", from(fit, &FittedOrder::first_abscissa)},
          {"coarsest", "", "largest step size of the fit", from(fit, &FittedOrder::last_abscissa)},
          {"points", "", "number of step sizes of the fit", from(fit, &FittedOrder::points)}};
}

}  // namespace dmocbench
