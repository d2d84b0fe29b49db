#include "bench/run/outcome.hpp"

#include <algorithm>
#include <map>
#include <ranges>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/run/solve_case.hpp"
#include "methods/program/status.hpp"

namespace dmocbench {

namespace {

/// ", 3 too coarse (dmoc 1, tangent 2)"; empty if the count is 0.
std::string counted_by_method(Status status, const std::map<std::string, std::ptrdiff_t>& by_method) {
  std::ptrdiff_t all = 0;
  std::vector<std::string> counts;
  for (const auto& [method, count] : by_method) {
    all += count;
    counts.push_back(fmt::format("{} {}", method, count));
  }
  return all == 0 ? "" : fmt::format(", {} {} ({})", all, name_of(status), fmt::join(counts, ", "));
}

}  // namespace

Outcome outcome_of(const Table& table) {
  Outcome outcome;
  std::map<std::string, std::ptrdiff_t> coarse;
  std::map<std::string, std::ptrdiff_t> violating;
  std::map<std::vector<std::string>, bool> is_usable_curve;
  for (const Row& row : table.rows()) {
    std::vector<std::string> curve;
    for (const char* const column : {"problem", "library", "method", "tableau", "stages", "solver", "derivatives"})
      curve.push_back(row.text(column));
    is_usable_curve[curve] |= is_usable(row);
    const std::string& status = row.text("status");
    if (status == name_of(Status::too_coarse)) {
      ++outcome.too_coarse;
      ++coarse[row.text("method")];
    } else if (status == name_of(Status::violates_between_stages)) {
      ++outcome.violating;
      ++violating[row.text("method")];
    } else if (!is_solved(status_named(status))) {
      if (++outcome.failures == 1) {
        outcome.first_failure = fmt::format("{} {} N = {}: {}", row.text("problem"), row.text("method"),
                                            row.text("intervals"), row.text("message"));
      }
    }
    if (row.text("branch") == "other") ++outcome.other_branch;
  }
  outcome.unusable_curves = std::ranges::count(is_usable_curve | std::views::values, false);
  outcome.no_motions_by_method =
      counted_by_method(Status::too_coarse, coarse) + counted_by_method(Status::violates_between_stages, violating);
  return outcome;
}

void describe(const Outcome& outcome, nlohmann::ordered_json& metadata) {
  metadata["not_solved"] = outcome.failures;
  metadata["too_coarse"] = outcome.too_coarse;
  metadata["violates_between_stages"] = outcome.violating;
  metadata["on_another_branch"] = outcome.other_branch;
}

}  // namespace dmocbench
