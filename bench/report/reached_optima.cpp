#include "bench/report/reached_optima.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "methods/program/status.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

/// True if a run solves problems with other parameters than their own.
bool sets_parameters(const Json& metadata) {
  const Json words = metadata.value("command_line", Json::array());
  return std::ranges::any_of(words, [](const Json& word) {
    if (!word.is_string()) return false;
    const auto text = word.get<std::string>();
    return text.starts_with("--set") || text.starts_with("--over");
  });
}

/// Calls `take` for every row of a solve of the problem as it is stated.
void for_each_solve(const ResultsFolder& results, const std::string& problem,
                    const std::function<void(const Row&)>& take) {
  for (const ReportedTable& reported : results.tables) {
    const Json* const metadata = results.metadata_of(reported.run);
    if (metadata == nullptr || reported.file != reported.run + ".csv" || sets_parameters(*metadata)) continue;
    const auto has = [&reported](const char* column) {
      return std::ranges::count(reported.table.columns(), column) > 0;
    };
    if (!has("problem") || !has("method") || !has("status") || !has("objective") || has("sequence")) continue;
    for (const Row& row : reported.table.rows()) {
      if (row.text("problem") == problem) take(row);
    }
  }
}

}  // namespace

std::optional<double> lowest_cost(const ResultsFolder& results, const std::string& problem) {
  std::optional<double> lowest;
  for_each_solve(results, problem, [&lowest](const Row& row) {
    const auto cost = row.number("objective");
    if (cost && is_solved(status_named(row.text("status")))) lowest = std::min(lowest.value_or(*cost), *cost);
  });
  return lowest;
}

std::vector<ReachedOptimum> reached_optima(const ResultsFolder& results, const std::string& problem, double optimum) {
  std::map<std::string, ReachedOptimum> methods;
  for_each_solve(results, problem, [&](const Row& row) {
    ReachedOptimum& reached = methods[row.text("method")];
    reached.method = row.text("method");
    ++reached.rows;
    const auto cost = row.number("objective");
    if (!cost || !is_solved(status_named(row.text("status")))) return;
    ++reached.solved;
    const double difference = std::abs(*cost - optimum) / std::max(std::abs(optimum), 1e-300);
    if (difference <= near_enough) ++reached.near;
    reached.smallest_difference = std::min(reached.smallest_difference.value_or(difference), difference);
  });
  std::vector<ReachedOptimum> all;
  all.reserve(methods.size());
  for (const auto& [name, reached] : methods) all.push_back(reached);
  return all;
}

}  // namespace dmocbench
