// The savings of automatic differentiation: "the optimization process performs in a faster and more robust way when
// providing the derivatives by automatic differentiation rather than via finite differences" (section 4.1).
#include <algorithm>
#include <cmath>

#include "bench/claims/timed_ratios.hpp"
#include "bench/run/solve_case.hpp"

namespace dmocbench {

namespace {

/// The setting of the paper, as we infer it: first derivatives, quasi-Newton updates.
constexpr const char* quasi_newton = "derivatives_quasi_newton";
/// Second derivatives too, from a common start and from the guess to several tolerances.
constexpr const char* warm = "derivatives";
constexpr const char* cold = "derivatives_cold";

Selection by_ipopt(const ResultTables& tables, const char* table, const std::string& problem) {
  return tables.rows(table, problem).where("solver", "ipopt");
}

/// The row of the same program, solved to the same tolerance with the same Hessian; a row without fields if no such
/// row exists.
const Row& partner_of(const Row& row, const Selection& others) {
  return others.matching(row, {"method", "tableau", "stages", "intervals", "tolerance", "hessian"}).front();
}

/// A solver that ends at an optimum of the discrete program has done its work, motion or not.
bool reaches_an_optimum(const Row& row) {
  const Status status = status_named(row.text("status"));
  return is_solved(status) || is_no_motion(status);
}

/// Solves of the same programs by the tape and by differences, in pairs.
struct Pairs {
  std::size_t count = 0;
  std::size_t by_tape = 0;
  std::size_t by_differences = 0;
  std::size_t by_tape_alone = 0;
  std::size_t by_differences_alone = 0;

  Pairs(const Selection& rows, const char* differences) {
    for (const Row& row : rows) static_cast<void>(row.needed("tolerance"));
    const Selection others = rows.where("derivatives", differences);
    for (const Row& row : rows.where("derivatives", "tape")) {
      const Row& other = partner_of(row, others);
      if (other.text("status").empty()) continue;
      const bool tape = reaches_an_optimum(row);
      const bool other_too = reaches_an_optimum(other);
      ++count;
      by_tape += tape ? 1 : 0;
      by_differences += other_too ? 1 : 0;
      by_tape_alone += tape && !other_too ? 1 : 0;
      by_differences_alone += other_too && !tape ? 1 : 0;
    }
  }
};

/// The chance that at least `wins` of all pairs that only one side solves are one side's, if neither is better.
double chance_of(std::size_t wins, std::size_t losses) {
  const auto pairs = static_cast<double>(wins + losses);
  double chance = 0.0;
  for (auto k = static_cast<double>(wins); k <= pairs; ++k) {
    chance += std::exp(std::lgamma(pairs + 1.0) - std::lgamma(k + 1.0) - std::lgamma(pairs - k + 1.0) -
                       pairs * std::log(2.0));
  }
  return chance;
}

/// The sign test, 95 % two-sided, on the programs that only one of both solves.
ClaimVerdict verdict_on_pairs(const Pairs& pairs) {
  constexpr double significant = 0.025;
  if (chance_of(pairs.by_tape_alone, pairs.by_differences_alone) < significant) return ClaimVerdict::reproduced;
  if (chance_of(pairs.by_differences_alone, pairs.by_tape_alone) < significant) return ClaimVerdict::differs;
  return ClaimVerdict::undecided;
}

Finding more_robust(const ResultTables& tables, const std::string& problem) {
  std::vector<ClaimVerdict> verdicts;
  std::vector<std::string> words;
  std::vector<std::string> chances;
  const auto add = [&](const char* table, const char* what) {
    const Pairs here(by_ipopt(tables, table, problem), "forward_differences");
    if (here.by_tape + here.by_differences == 0) {
      words.push_back(fmt::format("{}: none of {} programs is solved by either", what, here.count));
      return;
    }
    verdicts.push_back(verdict_on_pairs(here));
    chances.push_back(fmt::format("{:.1g}", std::min(chance_of(here.by_tape_alone, here.by_differences_alone),
                                                     chance_of(here.by_differences_alone, here.by_tape_alone))));
    words.push_back(fmt::format("{}: the tape solves {} of {}, forward differences {}", what, here.by_tape, here.count,
                                here.by_differences));
  };
  add(quasi_newton, "first derivatives, quasi-Newton, from a common start");
  if (tables.has(cold)) add(cold, "second derivatives too, from the guess");
  require(!verdicts.empty(), "{}.csv and {}.csv: {} of {}", quasi_newton, cold, fmt::join(words, "; "), problem);
  if (tables.has(cold)) {
    const Pairs central(by_ipopt(tables, cold, problem), "finite_differences");
    words.push_back(fmt::format("central differences solve {} of the same {}, {} of them alone and {} not",
                                central.by_differences, central.count, central.by_differences_alone,
                                central.by_tape_alone));
  }
  return found(verdict_on_all(verdicts), "{}", fmt::join(words, "; "))
      .as_sure_as(
          fmt::format("sign tests of programs that only one of both solves, chance {}", fmt::join(chances, ", ")));
}

/// Adds the ratio of the times by two back ends, round by round the geometric mean over all programs that both solve,
/// and counts the rows that it leaves out.
std::string add_ratio(TimedRatios& ratios, const Selection& rows, const std::string& name, const char* slow,
                      const char* fast) {
  for (const Row& row : rows) static_cast<void>(row.needed("tolerance"));
  const Selection slower = rows.where("derivatives", slow);
  const Selection faster = rows.where("derivatives", fast).usable();
  Selection timed;
  std::vector<std::vector<double>> of_programs;
  for (const Row& row : slower.usable()) {
    const Row& other = partner_of(row, faster);
    if (other.text("status").empty()) continue;
    of_programs.push_back(round_ratios(row.numbers("round_seconds"), other.numbers("round_seconds")));
    require(!of_programs.back().empty(), "{}, column round_seconds: there is no number", row.place());
    timed.append(row);
  }
  const std::vector<double> means = means_of_rounds(of_programs);
  if (!means.empty()) ratios.add(fmt::format("{} on {} programs", name, of_programs.size()), means);
  return left_out(slower, timed, fmt::format("not solved by {} or {}, in favour of {} by", slow, fast, slow));
}

/// "0.2 to 2.1": the cost of an evaluation by a back end, in units of residual evaluations.
std::string cost_of(const Selection& rows, const char* derivatives, const std::string& column) {
  const Selection costs = rows.where("derivatives", derivatives).where("hessian", "exact").with_number(column);
  return costs.empty() ? "(not measured)" : fmt::format("{:.3g} to {:.3g}", costs.min(column), costs.max(column));
}

/// The reason: the cost of a Jacobian, with the cost of dense differences by counting.
std::string costs_of_jacobians(const ResultTables& tables, const std::string& problem) {
  if (!tables.has(warm)) return "";
  const Selection rows = by_ipopt(tables, warm, problem);
  return fmt::format(
      "a Jacobian costs {} residuals by the tape, {} by forward differences interval by interval as here, {:g} to {:g} "
      "by dense ones (by counting), {} by ADOL-C interval by interval",
      cost_of(rows, "tape", "jacobian_over_residual"), cost_of(rows, "forward_differences", "jacobian_over_residual"),
      rows.min("variables"), rows.max("variables"), cost_of(rows, "adolc", "jacobian_over_residual"));
}

Finding faster(const ResultTables& tables, const std::string& problem) {
  TimedRatios ratios(1.0);
  std::string unsolved = add_ratio(ratios, by_ipopt(tables, quasi_newton, problem), "first derivatives, quasi-Newton",
                                   "forward_differences", "tape");
  if (tables.has(warm)) {
    unsolved +=
        add_ratio(ratios, by_ipopt(tables, warm, problem), "second derivatives too", "forward_differences", "tape");
  }
  require(ratios.rounds() > 0, "{}.csv and {}.csv: no program of {} is solved by forward differences and by the tape",
          quasi_newton, warm, problem);
  return judged(ratios, "ratio of the times of whole solves by forward differences and by the tape: ", unsolved)
      .because(costs_of_jacobians(tables, problem));
}

/// With second derivatives, where central differences reach the tolerance as well.
Finding times_beside_central_differences(const ResultTables& tables, const std::string& problem) {
  const Selection rows = by_ipopt(tables, warm, problem).where("hessian", "exact");
  TimedRatios ratios(1.0);
  const std::string unsolved = add_ratio(ratios, rows, "the tape", "finite_differences", "tape") +
                               add_ratio(ratios, rows, "ADOL-C", "finite_differences", "adolc");
  require(ratios.rounds() > 0, "{}.csv: no program of {} is solved by central differences and by exact derivatives",
          warm, problem);
  return found(ClaimVerdict::measured,
               "solves by central differences over those by {}; a Hessian costs {} residuals by the tape, {} by "
               "ADOL-C, {} by central differences{}",
               ratios.in_words(), cost_of(rows, "tape", "hessian_over_residual"),
               cost_of(rows, "adolc", "hessian_over_residual"),
               cost_of(rows, "finite_differences", "hessian_over_residual"), unsolved)
      .because(
          "a solve takes two or three iterations, in which derivatives take a small part of the time; ADOL-C's "
          "drivers are called once for every interval, and the differences cost one pass over all intervals per "
          "unknown of one interval")
      .as_sure_as("99 % of the medians of rounds");
}

}  // namespace

/// Automatic differentiation.
Claims derivative_claims() {
  const char* const section = "section 4.1, Automatic Differentiation";
  const char* const setting =
      "forward differences and quasi-Newton updates are our inference of what fmincon and nag_opt_nlp_sparse did; by "
      "Ipopt, and by the suite's own tape, whose derivatives agree with ADOL-C's to rounding";
  return {{.id = "automatic_differentiation_more_robust",
           .where = section,
           .whose = Whose::paper,
           .states = "the optimization is more robust with automatic differentiation than with finite differences",
           .judge = more_robust,
           .condition = setting,
           .evidence = {"derivatives_quasi_newton.csv", "derivatives_cold.csv"}},
          {.id = "automatic_differentiation_faster",
           .where = section,
           .whose = Whose::paper,
           .states = "the optimization is faster with automatic differentiation than with finite differences",
           .judge = faster,
           .condition = setting,
           .evidence = {"derivatives_quasi_newton.csv", "derivatives.csv", "figures/{}_derivatives.svg"}},
          {.id = "derivatives_beside_central_differences",
           .where = section,
           .states = "time saved by second derivatives from the tape and ADOL-C over central differences that use the "
                     "structure of the program",
           .judge = times_beside_central_differences,
           .condition = "warm, from the common start",
           .evidence = {"derivatives.csv", "figures/{}_derivatives.svg"}}};
}

}  // namespace dmocbench
