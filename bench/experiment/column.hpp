#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench {

/// A column of a table that has a row per `Record`.
template <class Record>
struct Column {
  std::string name;                         ///< as in the first line of a table
  std::string unit;                         ///< empty for texts, counts and numbers without unit
  std::string meaning;                      ///< in words, for `--help`
  std::function<Cell(const Record&)> cell;  ///< the record's field
};

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

/// What columns mean by their names: "[UNIT] MEANING".
template <class Record>
[[nodiscard]] std::map<std::string, std::string> meanings_of(const Columns<Record>& columns) {
  std::map<std::string, std::string> meanings;
  for (const Column<Record>& column : columns)
    meanings[column.name] = (column.unit.empty() ? "" : "[" + column.unit + "] ") + column.meaning;
  return meanings;
}

/// The table of records: a row for each.
template <class Record>
[[nodiscard]] Table table_of(const Columns<Record>& columns, const std::vector<Record>& records) {
  Table table(names_of(columns));
  table.explain(meanings_of(columns));
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

/// The member of a member ... of an object; nothing where an optional or a pointer on the way is empty.
template <class Object>
[[nodiscard]] Cell member(const Object& object) {
  return object;
}
/// A cell of a member of a member: `member(object, &A::b, &B::c)`.
template <class Object, class First, class... Rest>
[[nodiscard]] Cell member(const Object& object, First first, Rest... rest) {
  if constexpr (requires { *object; }) {  // an optional or a pointer; std::invoke would not ask whether it is empty
    return object ? member(*object, first, rest...) : Cell();
  } else {
    return member(std::invoke(first, object), rest...);
  }
}

/// Reads a field from the record: `from(&SolvedCase::solution, &Solution::seconds)`.
template <class... Members>
[[nodiscard]] auto from(Members... members) {
  return [=](const auto& record) { return member(record, members...); };
}

/// Reads a field from an object outside the record that is written:
/// `of(error_, &TrajectoryError::state)`. The object is read when the row is made.
template <class Object, class... Members>
[[nodiscard]] auto of(const Object& object, Members... members) {
  return [&object, members...](const auto& /*record*/) { return member(object, members...); };
}

/// What a row is about where nothing is solved.
struct Scheme {
  std::string problem;      ///< its name
  std::string method;       ///< its family of elements
  std::string tableau;      ///< its family of Butcher tableaus
  Eigen::Index stages = 0;  ///< s
};

/// The columns that tell `Record::scheme`.
template <class Record>
[[nodiscard]] Columns<Record> scheme_columns() {
  constexpr auto scheme = &Record::scheme;
  return {{"problem", "", "name of the problem", from(scheme, &Scheme::problem)},
          {"method", "", "family of elements, or another integrator", from(scheme, &Scheme::method)},
          {"tableau", "", "family of Butcher tableaus", from(scheme, &Scheme::tableau)},
          {"stages", "", "number of stages s", from(scheme, &Scheme::stages)}};
}

/// The columns that tell a fitted order.
template <class Record>
[[nodiscard]] Columns<Record> fitted_order_columns(FittedOrder Record::*fit) {
  return {
      {"slope", "", "fitted order", from(fit, &FittedOrder::order)},
      {"standard_error", "", "of the order; empty with two points",
       [fit](const Record& record) { return (record.*fit).points > 2 ? Cell((record.*fit).standard_error) : Cell(); }},
      {"finest", "", "smallest step used", from(fit, &FittedOrder::finest)},
      {"coarsest", "", "largest step used", from(fit, &FittedOrder::coarsest)},
      {"points", "", "number of steps used", from(fit, &FittedOrder::points)}};
}

}  // namespace dmocbench
