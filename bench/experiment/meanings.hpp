#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "bench/experiment/column.hpp"

namespace dmocbench {

/// Adds what the columns of a table mean, "[s] median time of a solve", to what a run's metadata tell of its file
/// (`describe_tables`); nothing where they tell nothing.
template <class Record>
void add_meanings(nlohmann::ordered_json& tables, const std::filesystem::path& file, const Columns<Record>& columns) {
  const std::string name = file.filename().string();
  if (!tables.contains(name)) return;
  for (const Column<Record>& column : columns) {
    const std::string unit = column.unit.empty() ? "" : "[" + column.unit + "] ";
    tables[name]["meanings"][column.name] = unit + column.meaning;
  }
}

}  // namespace dmocbench
