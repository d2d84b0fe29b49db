// Cold starts: how often a method converges from the problem's guess and near it, which warm starts cannot show.
#include <algorithm>
#include <string_view>

#include "bench/claims/claim.hpp"
#include "bench/claims/cold_start_counts.hpp"
#include "bench/tables/ratio_interval.hpp"

namespace dmocbench {

namespace {

/// The interval of a difference in words.
const char* in_words(const ShareInterval& difference) {
  if (difference.lower > 0.0) return "DMOC succeeds more often";
  return difference.upper < 0.0 ? "DMOC succeeds less often" : "no significant difference";
}

/// "dmoc 4 of 5"
Words share_in_words(const std::string& method, const ShareCount& count) {
  return worded("{} {} of {}", method, Measurement{"starts that succeeded", static_cast<double>(count.hits), method},
                Measurement{"starts", static_cast<double>(count.trials), method});
}

/// How often DMOC succeeds compared with each kind of collocation, by interior_point. All methods use the same starts;
/// the interval treats them as independent, which makes it slightly too wide.
Finding how_often(const ResultTables& tables, const std::string& problem, const char* column) {
  const Selection rows = tables.rows("cold_start_shares", problem).where("solver", "interior_point");
  const Selection dmoc = midpoint(rows, "dmoc");
  require(dmoc.size() == 1, "cold_start_shares.csv has {} rows of {} by dmoc and interior_point; one is needed",
          dmoc.size(), problem);
  const ShareCount own = count_of_cold_starts(dmoc.front(), column);
  Finding finding =
      found(ClaimVerdict::measured, "cold starts that are {}: {}",
            std::string_view(column) == "best" ? "confirmed in the best minimum" : column, share_in_words("dmoc", own));
  for (const std::string method : {"hamiltonian", "tangent"}) {
    const Selection others = midpoint(rows, method).matching(dmoc.front(), {"intervals", "derivatives"});
    require(others.size() == 1, "cold_start_shares.csv has {} rows of {} by {} to compare with dmoc; one is needed",
            others.size(), problem, method);
    const ShareCount count = count_of_cold_starts(others.front(), column);
    const ShareInterval difference = difference_interval(own, count);
    finding.clauses.push_back(worded("{}, shares differ by {:+.1f} to {:+.1f} %: {}", share_in_words(method, count),
                                     Measurement{"lower confidence limit of DMOC's share minus the method's",
                                                 100.0 * difference.lower, method, "", "%"},
                                     Measurement{"upper confidence limit of DMOC's share minus the method's",
                                                 100.0 * difference.upper, method, "", "%"},
                                     in_words(difference)));
  }
  if (tables.has("cold_start_indirect")) {
    const Selection rows_of_indirect = tables.rows("cold_start_indirect").where("problem", problem);
    for (const Row& row : rows_of_indirect) {
      const auto of_indirect = [&](const char* name, double value, const char* unit = "") {
        return Measurement{name, value, "indirect", "costates 0", unit};
      };
      finding.clauses.push_back(worded(
          "with costates 0, the indirect method converges from {} of {} starts ({:.0f} to {:.0f} %), from {} of them "
          "to the best branch",
          of_indirect("converged", row.needed("converged")), of_indirect("starts", row.needed("starts")),
          of_indirect("lower confidence limit of the converged share", 100.0 * row.needed("converged_lower"), "%"),
          of_indirect("upper confidence limit of the converged share", 100.0 * row.needed("converged_upper"), "%"),
          of_indirect("in the best minimum", row.needed("best"))));
    }
  }
  return std::move(finding).also(worded("95 % intervals")).as_sure_as(fmt::format("95 %, {} starts", own.trials));
}

Predicate how_often_in(const char* column) {
  return
      [column](const ResultTables& tables, const std::string& problem) { return how_often(tables, problem, column); };
}

}  // namespace

ShareCount count_of_cold_starts(const Row& row, const char* column) {
  require(row.text("start_kind") == "cold", "{}, column start_kind: the claim needs cold starts", row.place());
  const double starts = row.needed("starts");
  const double hits = row.needed(column);
  constexpr double most_starts = 1e9;
  const bool are_counts = starts == std::floor(starts) && hits == std::floor(hits);
  require(are_counts && starts >= 1.0 && starts <= most_starts && hits >= 0.0 && hits <= starts,
          "{}: {} of {} starts is not a valid count in column {}", row.place(), hits, starts, column);
  return {.hits = static_cast<std::size_t>(hits), .trials = static_cast<std::size_t>(starts)};
}

/// Starts at the guess and near it.
Claims cold_start_claims() {
  const std::vector<std::string> evidence{"cold_start_shares.csv", "cold_start_indirect.csv",
                                          "figures/{}_cold_start.svg"};
  return {{.id = "cold_starts_confirmed",
           .where = "section 4.1, SQP Method",
           .states = "share of cold starts (the guess and perturbed guesses) with a solved and confirmed program, for "
                     "DMOC and collocation",
           .judge = how_often_in("confirmed"),
           .condition = "direct methods use interior_point; section 3.3 names the indirect methods",
           .evidence = evidence,
           .has_verdict = false},
          {.id = "cold_starts_best",
           .where = "section 5, Global Minima",
           .states = "share of cold starts (the guess and perturbed guesses) that end in the best minimum, for DMOC "
                     "and collocation",
           .judge = how_often_in("best"),
           .condition = "solved with interior_point",
           .evidence = evidence,
           .has_verdict = false}};
}

}  // namespace dmocbench
