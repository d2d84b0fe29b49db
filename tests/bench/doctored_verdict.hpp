#pragma once

#include <functional>
#include <map>
#include <string>

#include "tests/bench/all_tables_for_claims.hpp"

namespace dmocbench::tests {

/// The verdict on the orbit's claim from the tables of a topic, where one table has been doctored by `change` in the
/// rows of a method.
inline ClaimVerdict doctored_verdict(const std::string& topic, const std::string& claim, const std::string& table = "",
                                     const std::string& method = "", const std::function<void(Row&)>& change = {}) {
  TableRows of_topic = all_rows();
  std::erase_if(of_topic, [&](const auto& rows) { return rows.first.find(topic) == std::string::npos; });
  const ResultTables results = results_of(of_topic, [&](const std::string& name, Row& row) {
    if (name == table && row.text("method") == method) change(row);
  });
  return judged_claim("orbital_transfer/" + claim, results).verdict;
}

/// A change that writes a text into a column.
inline auto sets(const char* column, const char* text) {
  return [=](Row& row) { row.set(column, text); };
}

}  // namespace dmocbench::tests
