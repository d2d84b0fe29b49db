#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/claims/claim.hpp"
#include "bench/tables/selection.hpp"

// Tables for tests, with the columns that the experiments declare. Binaries.runs_every_experiment compares the file of
// the declarations with what the experiments write.
namespace dmocbench::tests {

using Rows = std::vector<Row>;

/// Key and columns of every table that an experiment writes.
inline const nlohmann::ordered_json& declared_tables() {
  static const auto declared = nlohmann::ordered_json::parse(read_file(DMOCBENCH_DECLARED_TABLES));
  return declared;
}

/// The declaration of a table, also of a run that has another name than its experiment: convergence_512_slopes is
/// declared as convergence_slopes.
inline const nlohmann::ordered_json& declaration_of(const std::string& table) {
  std::pair<std::size_t, std::size_t> longest;  // what the table begins with, and what is declared in all
  const nlohmann::ordered_json* found = nullptr;
  for (const auto& [name, declaration] : declared_tables().items()) {
    const auto differs = static_cast<std::size_t>(std::ranges::mismatch(name, table).in1 - name.begin());
    const std::size_t common = differs == name.size() ? differs : std::min(name.rfind('_', differs), differs);
    const std::pair length(common, name.size());
    if (!table.ends_with(name.substr(common)) || length < longest) continue;
    longest = length;
    found = &declaration;
  }
  if (found == nullptr) throw Error("no experiment declares " + table);
  return *found;
}

inline ColumnNames declared_columns(const std::string& table) {
  ColumnNames names;
  for (const auto& [name, type] : declaration_of(table).at("columns").items()) names.push_back(name);
  return names;
}

/// The JSON Schema of the rows, as far as claims read it.
inline nlohmann::ordered_json declared_schema(const std::string& table) {
  const nlohmann::ordered_json& declaration = declaration_of(table);
  nlohmann::ordered_json schema{{"primaryKey", declaration.at("key")}};
  for (const auto& [name, type] : declaration.at("columns").items()) schema["properties"][name]["type"] = type;
  return schema;
}

/// The table of rows; a field in a column that the experiment does not declare is a failure.
inline Table declared_table(const std::string& name, const Rows& rows) {
  Table table(declared_columns(name));
  for (const Row& row : rows) {
    for (const std::string& column : row.columns())
      EXPECT_EQ(std::ranges::count(table.columns(), column), 1) << name << " has no column " << column;
    table.append(row);
  }
  return table;
}

/// The row of a scheme by Gauss points.
inline Row scheme_row(const std::string& method, const std::string& problem = orbit, const Cell& stages = 1) {
  Row row;
  row.set("problem", problem);
  row.set("method", method);
  row.set("tableau", "gauss");
  row.set("stages", stages);
  return row;
}

/// Rows of tables, by the tables' names.
using TableRows = std::map<std::string, Rows>;

/// The tables of all rows, each doctored by `change`.
inline ResultTables results_of(TableRows all,
                               const std::function<void(const std::string& table, Row& row)>& change = {}) {
  ResultTables results;
  for (auto& [name, rows] : all) {
    for (Row& row : rows) {
      if (change) change(name, row);
    }
    results.add(name, declared_table(name, rows));
  }
  return results;
}

/// The claim of an id as the tables lead to it.
inline JudgedClaim judged_claim(const std::string& id, const ResultTables& tables) {
  const std::vector<JudgedClaim> judged = judge_claims(tables, [&](const std::string& other) { return other == id; });
  EXPECT_EQ(judged.size(), 1U) << id;
  return judged.empty() ? JudgedClaim() : judged.front();
}

}  // namespace dmocbench::tests
