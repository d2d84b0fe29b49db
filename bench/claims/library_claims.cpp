// Over many starts and many problems: "the use of an SQP solver restricts one to local minima that are dependent on the
// specific initial guess used", and "savings in computation" on more than the paper's two problems.
#include <algorithm>

#include "bench/claims/claim.hpp"
#include "bench/tables/profile_tables.hpp"
#include "methods/runtime/counted.hpp"
#include "methods/transcription/elements/families.hpp"

namespace dmocbench {

namespace {

/// Holds if there are at least two minima that are motions and more than one method ends in: a minimum of one
/// discretisation alone may be spurious.
Finding local_minima(const ResultTables& tables, const std::string& problem) {
  const Selection rows = tables.rows("local_minima_minima", problem);
  const Selection motions = rows.where("is_motion", "yes");
  const Selection shared = motions.where([methods = paper_families()](const Row& row) {
    return std::ranges::count_if(methods, [&](const auto& method) { return row.needed(method) > 0.0; }) > 1;
  });
  const auto objective = [](const Row& row) { return fmt::format("{:.5g}", row.needed("objective")); };
  return found(
      shared.size() > 1,
      "minima whose intervals join when they are replayed: {}, and more than one method ends in {} of them: J = {}; "
      "not counted: {} that are no motions but artefacts of the grid",
      motions.size(), shared.size(), shared.empty() ? "(none)" : shared.in_words(", ", objective),
      rows.size() - motions.size());
}

/// A number between 0 and 1.
double share(const Row& row, const char* column) {
  const double value = row.needed(column);
  require(value >= 0.0 && value <= 1.0, "{}, column {}: {} is no share", row.place(), column, value);
  return value;
}

/// Holds if two intervals of confidence do not overlap.
Finding best_minimum_share(const ResultTables& tables, const std::string& problem) {
  const Selection rows = tables.rows("local_minima_shares", problem);
  require(rows.size() > 1, "local_minima_shares.csv has one method of {} to compare", problem);
  const auto lower = [](const Row& row) { return share(row, "share_lower"); };
  const auto upper = [](const Row& row) { return share(row, "share_upper"); };
  const auto words = [&](const Row& row) {
    return fmt::format("{} {:g} of {:g} ({:.0f} to {:.0f} %)", row.text("method"), row.needed("best"),
                       row.needed("starts"), 100.0 * lower(row), 100.0 * upper(row));
  };
  const double lowest_upper = -rows.max([&](const Row& row) { return -upper(row); });
  return found(rows.max(lower) > lowest_upper, "{}; 95 % intervals", rows.in_words(", ", words));
}

/// Throws `Error` if some of the rows tell a measure and others do not. Some solvers never tell one.
void require_told(const Selection& successes, const std::string& measure) {
  const auto tells = [&](const Row& row) { return !row.text(measure).empty(); };
  if (std::ranges::any_of(successes, tells)) static_cast<void>(successes.max(measure));
}

/// Holds if, by every solver, a competitor of DMOC's is the best on more instances than any of collocation's. Solvers
/// are not compared with each other: their counters and speed are no property of a method.
Predicate dmoc_best_by(const std::string& measure) {
  return [wins = "wins_" + measure, measure](const ResultTables& tables, const std::string&) -> Finding {
    const Selection rows = tables.rows("profile");
    const Selection successes = rows.where("success", "yes");
    require(!successes.empty(), "profile.csv has no success among its {}", counted(rows.size(), "row"));
    for (const Row& row : successes) static_cast<void>(row.needed("objective"));
    const auto wins_in_words = [&](const Row& row) {
      return fmt::format("{} {} {}: best on {}, solves {}", row.text("method"), row.text("tableau"), row.text("stages"),
                         row.text(wins), row.text("successes"));
    };
    std::string measured = fmt::format("by {}, methods compared within one solver", measure);
    bool holds = true;
    for (const Selection& solves : rows.group_by({"solver"})) {
      require_told(solves.where("success", "yes"), measure);
      const Table table = profile_summary(solves);
      const Selection summary(table);
      const auto is_dmoc = [](const Row& row) { return row.text("method") == "dmoc"; };
      const auto most_wins = [&](const Selection& competitors) { return std::max(0.0, competitors.max(wins)); };
      holds = holds && most_wins(summary.where(is_dmoc)) > most_wins(summary.where(std::not_fn(is_dmoc)));
      measured +=
          fmt::format("; {}, {} instances: ", solves.front().text("solver"), summary.front().text("instances")) +
          summary.in_words(", ", wins_in_words);
    }
    return found(holds, "{}", measured);
  };
}

}  // namespace

/// Local minima.
Claims minima_claims() {
  return {{.id = "local_minima",
           .where = "section 4.1, SQP Method; section 5, Global Minima",
           .whose = Whose::remark,
           .states = "local minima depend on the initial guess",
           .judge = local_minima,
           .evidence = {"local_minima_minima.csv", "figures/{}_local_minima.svg"}},
          {.id = "best_minimum_share",
           .where = "section 5, Global Minima",
           .states = "one method finds the best minimum more often than another",
           .judge = best_minimum_share,
           .evidence = {"local_minima_shares.csv", "figures/{}_local_minima.svg"}}};
}

/// The whole library.
Claims library_claims() {
  Claims claims;
  for (const std::string& measure : profile_measures()) {
    claims.push_back({.id = "dmoc_best_by_" + measure,
                      .problems = Problems(1, "library"),
                      .where = "section 5, on two problems",
                      .states = "DMOC needs less than collocation on more problems than the paper's two",
                      .judge = dmoc_best_by(measure),
                      .evidence = {"profile.csv", "figures/profile.svg"},
                      .needs = "profile"});
  }
  return claims;
}

}  // namespace dmocbench
