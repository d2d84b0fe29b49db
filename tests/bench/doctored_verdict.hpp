#pragma once

#include <functional>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tests/bench/all_tables_for_claims.hpp"

namespace dmocbench::tests {

/// The verdict on the orbit's claim from the tables of a topic, where one table has been doctored by `change` in the
/// rows of a method.
inline ClaimVerdict doctored_verdict(const std::string& topic, const std::string& claim, const std::string& table = "",
                                     const std::string& method = "", const std::function<void(Row&)>& change = {}) {
  static const std::map<std::string, Rows> all = all_rows();
  ResultTables results;
  for (const auto& [name, rows_of_name] : all) {
    if (name.find(topic) == std::string::npos) continue;
    Rows rows = rows_of_name;
    for (Row& row : rows) {
      if (name == table && row.text("method") == method) change(row);
    }
    results.add(name, declared_table(name, rows));
  }
  for (const JudgedClaim& judged : judge_claims(results)) {
    if (judged.id() == "orbital_transfer/" + claim) return judged.verdict;
  }
  ADD_FAILURE() << "no claim " << claim;
  return ClaimVerdict::not_judged;
}

/// A change that writes a text into a column.
inline auto sets(const char* column, const char* text) {
  return [=](Row& row) { row.set(column, text); };
}

}  // namespace dmocbench::tests
