// What automatic differentiation saves: "the optimization process performs in a faster and more robust way when
// providing the derivatives by automatic differentiation rather than via finite differences" (section 4.1).
#include <algorithm>

#include "bench/claims/timed_ratios.hpp"
#include "bench/run/solve_case.hpp"

namespace dmocbench {

namespace {

/// Solves by Ipopt with one back end and an exact Hessian, or its own.
Selection with_back_end(const Selection& rows, const std::string& table, const char* derivatives) {
  Selection solves = rows.where("solver", "ipopt").where("hessian", "exact").where("derivatives", derivatives);
  require(!solves.empty(), "{}.csv has no solve by ipopt with {} and the Hessian exact", table, derivatives);
  return solves;
}

/// Adds the ratio of the times by two back ends, round by round the geometric mean over all methods and grids that both
/// solve, and counts the rows that it leaves out.
std::string add_ratio(TimedRatios& ratios, const Selection& rows, const char* slow, const char* fast) {
  for (const Row& row : rows) static_cast<void>(row.needed("tolerance"));
  const Selection slower = with_back_end(rows, "derivatives", slow);
  const Selection faster = with_back_end(rows, "derivatives", fast).usable();
  Selection timed;
  std::vector<std::vector<double>> of_programs;
  for (const Row& row : slower.usable()) {
    const Selection partner = faster.matching(row, {"method", "tableau", "stages", "intervals", "tolerance"});
    if (partner.empty()) continue;
    of_programs.push_back(round_ratios(row.numbers("round_seconds"), partner.front().numbers("round_seconds")));
    require(!of_programs.back().empty(), "{}, column round_seconds: there is no number", row.place());
    timed.append(row);
  }
  const std::vector<double> means = means_of_rounds(of_programs);
  if (!means.empty()) ratios.add(fmt::format("{} on {} programs", slow, of_programs.size()), means);
  return left_out(slower, timed, fmt::format("not solved by {} or {}, in favour of {} by", slow, fast, slow));
}

/// A solver that ends at an optimum of the discrete program has done its work, motion or not.
bool reaches_an_optimum(const Row& row) {
  const Status status = status_named(row.text("status"));
  return is_solved(status) || is_no_motion(status);
}

/// How many solves from the guess reach an optimum with one back end.
struct ColdSolves {
  std::size_t starts;
  std::size_t solved;

  ColdSolves(const Selection& rows, const char* derivatives)
      : starts(with_back_end(rows, "derivatives_cold", derivatives).size()),
        solved(with_back_end(rows, "derivatives_cold", derivatives).where(reaches_an_optimum).size()) {}
};

Finding more_robust(const ResultTables& tables, const std::string& problem) {
  const Selection rows = tables.rows("derivatives_cold", problem);
  std::vector<std::string> words;
  std::vector<std::string> where_not;
  for (const Selection& solves : rows.group_by({"tolerance"})) {
    const std::string tolerance = solves.front().text("tolerance");
    const ColdSolves tape(solves, "tape");
    const ColdSolves adolc(solves, "adolc");
    const ColdSolves central(solves, "finite_differences");
    const ColdSolves forward(solves, "forward_differences");
    words.push_back(fmt::format("at {}: tape {} of {}, ADOL-C {}, central differences {}, forward {}", tolerance,
                                tape.solved, tape.starts, adolc.solved, central.solved, forward.solved));
    const std::size_t exact = std::min(tape.solved, adolc.solved);
    if (exact <= central.solved) where_not.push_back("central differences at " + tolerance);
    if (exact <= forward.solved) where_not.push_back("forward differences at " + tolerance);
  }
  require(words.size() >= 3, "derivatives_cold.csv has {} tolerances of {}; three are needed", words.size(), problem);
  Finding finding = found(where_not.empty(), "solved from the guess {}", fmt::join(words, "; "));
  if (where_not.empty()) return finding;
  return std::move(finding).because(fmt::format(
      "it depends on the tolerance and the differences: as many are solved by {}", fmt::join(where_not, ", ")));
}

/// A ratio of 1 is neither faster nor slower.
constexpr double as_fast = 1.0;

Finding faster(const ResultTables& tables, const std::string& problem) {
  const Selection rows = tables.rows("derivatives", problem);
  TimedRatios ratios(as_fast);
  std::string unsolved = add_ratio(ratios, rows, "finite_differences", "tape");
  unsolved += add_ratio(ratios, rows, "forward_differences", "tape");
  require(ratios.rounds() > 0, "derivatives.csv: no program of {} is solved by differences and by the tape", problem);
  return judged(ratios, "solves take this many times those by the tape: ", unsolved);
}

Finding adolc_faster(const ResultTables& tables, const std::string& problem) {
  TimedRatios ratios(as_fast);
  const std::string unsolved = add_ratio(ratios, tables.rows("derivatives", problem), "finite_differences", "adolc");
  require(ratios.rounds() > 0, "derivatives.csv: no program of {} is solved by central differences and by ADOL-C",
          problem);
  return judged(ratios, "solves by central differences take this many times those by ADOL-C: ", unsolved);
}

}  // namespace

/// Automatic differentiation.
Claims derivative_claims() {
  const char* const section = "section 4.1, Automatic Differentiation";
  const std::vector<std::string> evidence{"derivatives.csv", "figures/{}_derivatives.svg"};
  return {
      {.id = "automatic_differentiation_more_robust",
       .where = section,
       .whose = Whose::paper,
       .states = "more solves succeed with automatic differentiation than with finite differences",
       .judge = more_robust,
       .condition = "cold, from the problem's guess; \"acceptable\" does not count",
       .evidence = {"derivatives_cold.csv"}},
      {.id = "automatic_differentiation_faster",
       .where = section,
       .whose = Whose::paper,
       .states = "solves are faster with automatic differentiation than with finite differences",
       .judge = faster,
       .condition = "warm, from the common start, where both reach the tolerance; the differences here cost one pass "
                    "over all intervals per unknown of one interval",
       .evidence = evidence},
      {.id = "adolc_faster_than_differences",
       .where = section,
       .whose = Whose::paper,
       .states = "faster, by the package ADOL-C",
       .judge = adolc_faster,
       .condition = "warm, from the common start, ADOL-C interval by interval; the differences here cost one pass "
                    "over all intervals per unknown of one interval",
       .evidence = evidence}};
}

}  // namespace dmocbench
