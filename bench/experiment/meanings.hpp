#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/experiment/column.hpp"

namespace dmocbench {

/// A column of a table without its values.
struct DeclaredColumn {
  std::string name;
  std::string unit;
  std::string meaning;
};

template <class Record>
[[nodiscard]] std::vector<DeclaredColumn> declarations_of(const Columns<Record>& columns) {
  std::vector<DeclaredColumn> declarations;
  for (const Column<Record>& column : columns) declarations.push_back({column.name, column.unit, column.meaning});
  return declarations;
}

/// Adds to what a run's metadata tell of a table's file (`describe_tables`) what its columns mean, "[s] median time of
/// a solve", and the JSON Schema of its rows (`row_schema`); nothing where they tell nothing of the file.
void add_meanings(nlohmann::ordered_json& tables, const std::filesystem::path& file,
                  const std::vector<DeclaredColumn>& columns);

/// The JSON Schema (draft 2020-12) of a row as an object: a property per column with its meaning and, as "unit", its
/// unit, where they are known; all are required, others are not allowed. Fields that read as numbers are numbers, empty
/// ones null.
[[nodiscard]] nlohmann::ordered_json row_schema(const std::string& title, const std::vector<DeclaredColumn>& columns);

/// The JSON Schema of a run's metadata, NAME.json: what every run tells, and the schema of what it tells of its tables.
[[nodiscard]] nlohmann::ordered_json metadata_schema();

}  // namespace dmocbench
