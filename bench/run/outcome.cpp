#include "bench/run/outcome.hpp"

#include <map>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "methods/program/status.hpp"

namespace dmocbench {

Outcome outcome_of(const Table& table) {
  Outcome outcome;
  std::map<std::string, int> coarse;
  for (const Row& row : table.rows()) {
    const std::string& status = row.text("status");
    const bool is_coarse = status == name_of(Status::too_coarse);
    if (is_coarse) {
      ++outcome.too_coarse;
      ++coarse[row.text("method")];
    }
    if (!is_coarse && status != name_of(Status::solved)) ++outcome.failures;
    if (row.text("branch") == "other") ++outcome.other_branch;
  }
  if (outcome.too_coarse == 0) return outcome;
  std::vector<std::string> counts;
  counts.reserve(coarse.size());
  for (const auto& [method, count] : coarse) counts.push_back(fmt::format("{} {}", method, count));
  outcome.coarse_by_method = fmt::format(", {} too coarse ({})", outcome.too_coarse, fmt::join(counts, ", "));
  return outcome;
}

void describe(const Outcome& outcome, nlohmann::ordered_json& metadata) {
  metadata["not_solved"] = outcome.failures;
  metadata["too_coarse"] = outcome.too_coarse;
  metadata["on_another_branch"] = outcome.other_branch;
}

}  // namespace dmocbench
