// "DMOC ... savings in computation": over the whole library, not on the paper's two problems alone.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claim_rows.hpp"
#include "bench/claims/predicates.hpp"

namespace dmocbench {

namespace {

/// The most of a column that one competitor of a method reaches.
double most(const Rows& rows, const std::string& method, const std::string& column) {
  double largest_entry = 0.0;
  for (const Row* row : rows_with(rows, "method", method)) {
    largest_entry = std::max(largest_entry, row->number(column).value_or(0.0));
  }
  return largest_entry;
}

}  // namespace

/// That a competitor of DMOC's is the first of the whole field on more instances than any of collocation's.
Claim library_claim(const ResultTables& tables, const std::string& measure) {
  Claim claim{.id = "library/dmoc_best_by_" + measure,
              .where = "rem:savings",
              .paper = "DMOC needs less than collocation",
              .measured = "no table profile_summary.csv (bench/reproduce --all)",
              .verdict = ClaimVerdict::not_yet};
  const Rows rows = tables.rows("profile_summary");
  if (rows.empty()) return claim;
  std::vector<std::string> wins;
  for (const Row* row : rows) {
    wins.push_back(fmt::format("{} {} {} {}: best on {}, solves {}", row->text("method"), row->text("tableau"),
                               row->text("stages"), row->text("solver"), row->text("wins_" + measure),
                               row->text("successes")));
  }
  claim.measured =
      fmt::format("of {} instances, by {}: {}", rows.front()->text("instances"), measure, fmt::join(wins, "; "));
  const std::string column = "wins_" + measure;
  claim.verdict = verdict_of(most(rows, "dmoc", column) >
                             std::max(most(rows, "hamiltonian", column), most(rows, "tangent", column)));
  return claim;
}

}  // namespace dmocbench
