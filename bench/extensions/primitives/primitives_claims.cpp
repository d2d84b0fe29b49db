// Roadmaps of DMOC primitives: whether they lead to the global minimum, and how long a plan takes.
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "bench/claims/claim.hpp"
#include "bench/extensions/claims_of_extensions.hpp"

namespace dmocbench {

namespace {

/// Costs that differ by less are the same.
constexpr double same_cost = 1e-3;
constexpr double fewest_searches = 10.0;

/// The problems, with a column in per cent: "orbital_transfer 182.6 %, hovercraft 3.1 %".
Words shares_of(const Selection& rows, const char* column) {
  return joined(rows, ", ", [&](const Row& row) {
    const std::string& problem = row.text("problem");
    const auto share = row.number(column);
    if (!share) return worded("{} none", problem);
    return worded("{} {:.3g} %", problem, Measurement{column, 100.0 * *share, "", problem, "%"});
  });
}

/// Whether there is a path whose full solve ends at the best cost that is known, and multi-start at none that is less.
bool is_best(const Row& row) {
  const auto after = row.number("excess_after");
  const double of_starts =
      row.needed("start_motions") > 0.0 ? row.needed("excess_of_starts") : std::numeric_limits<double>::infinity();
  return row.text("status") == "solved" && row.number("excess_before") && after && *after < same_cost &&
         *after < of_starts + same_cost;
}

Finding leads_to_global_minima(const ResultTables& tables, const std::string& /*problem*/) {
  const Selection rows = tables.rows("primitives");
  require(rows.size() >= 2, "primitives.csv has {} rows; two problems are needed", rows.size());
  for (const Row& row : rows) static_cast<void>(row.needed("reference_cost"));
  const auto best = std::ranges::count_if(rows, is_best);
  Row slowest = rows.front();
  for (const Row& row : rows) {
    require(row.needed("rounds") >= fewest_searches, "{}: {} searches were timed; {} are needed", row.place(),
            row.needed("rounds"), fewest_searches);
    if (row.needed("plan_upper") > slowest.needed("plan_upper")) slowest = row;
  }
  std::vector<std::string> others;
  for (const Row& row : rows) {
    if (!is_best(row)) others.push_back(row.text("problem"));
  }
  return found(ClaimVerdict::measured,
               "on {} of {} problems, the full solve from the path ends within {:g} % of the best known cost, and "
               "multi-start reaches no lower cost in the same time",
               best, rows.size(), Measurement{"bound on the excess of the cost", 100.0 * same_cost, "", "", "%"})
      .also(worded("the path itself exceeds this cost by {}", shares_of(rows, "excess_before")))
      .also(worded("the slowest search takes {:.2g} to {:.2g} ms",
                   Measurement{"lower confidence limit of this time", slowest.needed("plan_lower"), "", "", "ms"},
                   Measurement{"upper confidence limit of this time", slowest.needed("plan_upper"), "", "", "ms"}))
      .because(others.empty() ? Words() : worded("exceptions: {}", fmt::join(others, ", ")))
      .as_sure_as("99 % of the times of searches");
}

}  // namespace

Claims primitives_claims() {
  return {{.id = "global_minima_by_primitives",
           .problems = examples,
           .where = "section 5, Global Minima",
           .whose = Whose::extension,
           .states = "share of problems on which the best path of a roadmap of DMOC primitives leads to the best known "
                     "optimum, and time of the search for the path",
           .judge = leads_to_global_minima,
           .condition = "a full solve from the path must end at the best known cost; a search uses an existing "
                        "roadmap; the number of multi-start solves in the same time depends on the machine",
           .evidence = {"primitives.csv", "figures/orbital_transfer_primitives.svg"},
           .has_verdict = false}};
}

}  // namespace dmocbench
