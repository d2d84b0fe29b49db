// "The use of an SQP solver restricts one to local minima that are dependent on the specific initial guess used."
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claim_rows.hpp"
#include "bench/claims/predicates.hpp"
#include "methods/transcription/element.hpp"

namespace dmocbench {

/// Reproduced if there are at least two minima that more than one method ends in: an artefact of one discretisation
/// does not count.
Claim local_minima_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/local_minima",
              .where = "section 4.1, Global Minima",
              .paper = "local minima depend on the initial guess",
              .measured = "no table local_minima_minima.csv",
              .verdict = ClaimVerdict::not_yet};
  const Rows rows = tables.rows("local_minima_minima", problem);
  if (rows.empty()) return claim;
  std::vector<std::string> shared;
  for (const Row* row : rows) {
    const std::vector<std::string> methods = element_names();
    const auto found_by = std::count_if(methods.begin(), methods.end(), [&](const std::string& method) {
      return row->number(method).value_or(0.0) > 0.0;
    });
    if (found_by > 1) shared.push_back(fmt::format("{:.5g}", row->number("objective").value_or(0.0)));
  }
  claim.measured = fmt::format("{} minima, of which more than one method ends in those with J = {}", rows.size(),
                               fmt::join(shared, ", "));
  claim.verdict = verdict_of(shared.size() > 1);
  return claim;
}

/// That one method finds the best minimum more often: two intervals of confidence that do not overlap.
Claim best_minimum_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/best_minimum_share",
              .where = "section 4.1, Global Minima",
              .paper = "(not stated) one method finds the best minimum more often than another",
              .measured = "no table local_minima_shares.csv",
              .verdict = ClaimVerdict::not_yet};
  const Rows rows = tables.rows("local_minima_shares", problem);
  if (rows.empty()) return claim;
  std::vector<std::string> shares;
  double highest_lower = 0.0;
  double lowest_upper = 1.0;
  for (const Row* row : rows) {
    const double lower = row->number("share_lower").value_or(0.0);
    const double upper = row->number("share_upper").value_or(1.0);
    highest_lower = std::max(highest_lower, lower);
    lowest_upper = std::min(lowest_upper, upper);
    shares.push_back(fmt::format("{} {} of {} ({:.0f} to {:.0f} %)", row->text("method"), row->text("best"),
                                 row->text("starts"), 100.0 * lower, 100.0 * upper));
  }
  claim.measured = fmt::format("{}; 95 % intervals", fmt::join(shares, ", "));
  claim.verdict = verdict_of(highest_lower > lowest_upper);
  return claim;
}

}  // namespace dmocbench
