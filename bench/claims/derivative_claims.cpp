// The savings of automatic differentiation: "the optimization process performs in a faster and more robust way when
// providing the derivatives by automatic differentiation rather than via finite differences" (section 4.1).
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

/// The row of the same program, solved to the same tolerance with the same Hessian, or else a row without fields.
const Row& partner_of(const Row& row, const Selection& others) {
  return others.matching(row, {"method", "tableau", "stages", "intervals", "tolerance", "hessian"}).front();
}

/// A solver that ends at an optimum of the discrete program has done its work, motion or not.
bool reaches_an_optimum(const Row& row) {
  const Status status = status_named(row.text("status"));
  return is_solved(status) || is_no_motion(status);
}

/// Exact derivatives, and the differences that they are compared with.
struct Rivals {
  const char* exact;
  const char* differences;
  const char* in_words;  ///< of the exact ones
};

/// The paper's: dense forward differences against ADOL-C, which records the program once; the tape without ADOL-C.
Rivals of_the_paper(const Selection& rows) {
  const bool has_adolc = !rows.where("derivatives", "adolc_whole").empty();
  return has_adolc ? Rivals{"adolc_whole", "dense_differences", "ADOL-C, recorded once,"}
                   : Rivals{"tape", "dense_differences", "the tape"};
}
/// Both as this suite has them, interval by interval.
constexpr Rivals of_the_suite{"tape", "forward_differences", "the tape"};

/// Solves of the same programs by exact derivatives and by differences, in pairs.
struct Pairs {
  std::size_t count = 0;
  std::size_t exact = 0;
  std::size_t by_differences = 0;
  std::size_t exact_alone = 0;
  std::size_t by_differences_alone = 0;

  void add(const Selection& rows, const Rivals& rivals) {
    for (const Row& row : rows) static_cast<void>(row.needed("tolerance"));
    const Selection others = rows.where("derivatives", rivals.differences);
    for (const Row& row : rows.where("derivatives", rivals.exact)) {
      const Row& other = partner_of(row, others);
      if (other.text("status").empty()) continue;
      const bool one = reaches_an_optimum(row);
      const bool other_too = reaches_an_optimum(other);
      ++count;
      exact += one ? 1 : 0;
      by_differences += other_too ? 1 : 0;
      exact_alone += one && !other_too ? 1 : 0;
      by_differences_alone += other_too && !one ? 1 : 0;
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
  if (chance_of(pairs.exact_alone, pairs.by_differences_alone) < significant) return ClaimVerdict::reproduced;
  if (chance_of(pairs.by_differences_alone, pairs.exact_alone) < significant) return ClaimVerdict::differs;
  return ClaimVerdict::undecided;
}

/// "0.2 to 2.1 by the tape": the range of a column over the rows of a back end with exact Hessians; no words without
/// numbers.
Words range_of(const Selection& rows, const char* derivatives, const char* in_words, const std::string& column) {
  const Selection measured = rows.where("derivatives", derivatives).where("hessian", "exact").with_number(column);
  if (measured.empty()) return {};
  return worded("{:.3g} to {:.3g} by {}", Measurement{"least " + column, measured.min(column), "", derivatives},
                Measurement{"largest " + column, measured.max(column), "", derivatives}, in_words);
}

/// All settings together, as one sign test for each pair of rivals; in no setting differences may be better.
Finding more_robust(const ResultTables& tables, const std::string& problem) {
  std::vector<Selection> settings{by_ipopt(tables, quasi_newton, problem)};
  std::vector<const char*> names{"quasi-Newton with first derivatives, from a common start"};
  if (tables.has(cold)) {
    settings.push_back(by_ipopt(tables, cold, problem));
    names.push_back("first and second derivatives, from the guess");
  }
  std::vector<ClaimVerdict> verdicts;
  std::vector<Words> words;
  std::vector<std::string> chances;
  for (const Rivals& rivals : {of_the_paper(settings.front()), of_the_suite}) {
    Pairs all;
    std::vector<std::string> counts;
    for (std::size_t i = 0; i < settings.size(); ++i) {
      Pairs here;
      here.add(settings[i], rivals);
      all.add(settings[i], rivals);
      if (here.count == 0) continue;
      if (verdict_on_pairs(here) == ClaimVerdict::differs) verdicts.push_back(ClaimVerdict::differs);
      counts.push_back(fmt::format("{}: {} and {} of {}", names[i], here.exact, here.by_differences, here.count));
    }
    if (all.exact + all.by_differences == 0) continue;
    verdicts.push_back(verdict_on_pairs(all));
    chances.push_back(fmt::format("{:.1g}", std::min(chance_of(all.exact_alone, all.by_differences_alone),
                                                     chance_of(all.by_differences_alone, all.exact_alone))));
    words.push_back(
        worded("programs solved with {} and {} ({})", rivals.in_words, rivals.differences, fmt::join(counts, "; ")));
  }
  require(!verdicts.empty(), "{}.csv and {}.csv: no program of {} is solved with exact derivatives or with differences",
          quasi_newton, cold, problem);
  Words reason = worded("solves with differences end above the tolerance");
  if (tables.has(cold)) {
    Pairs central;
    central.add(settings.back(), {"tape", "finite_differences", ""});
    words.push_back(
        worded("from the guess, central differences solve {} of {} programs; {} are solved only with central "
               "differences, {} only with exact derivatives",
               central.by_differences, central.count, central.by_differences_alone, central.exact_alone));
    const Words errors = joined({range_of(settings.back(), "dense_differences", "dense differences", "jacobian_error"),
                                 range_of(settings.back(), "adolc_whole", "ADOL-C", "jacobian_error")},
                                ", ");
    if (!errors.is_empty()) {
      reason = worded("{}; relative to the largest entry, the errors of Jacobians are: {}", reason, errors);
    }
  }
  return Finding{.clauses = std::move(words), .verdict = verdict_on_all(verdicts)}.because(reason).as_sure_as(
      fmt::format("sign tests on programs that only one of the two solves, p = {}", fmt::join(chances, ", ")));
}

/// Adds the ratio of the times by two back ends, round by round the geometric mean over all programs that both solve,
/// and counts the rows that it leaves out.
Words add_ratio(TimedRatios& ratios, const Selection& rows, const std::string& name, const char* slow,
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
    require(!of_programs.back().empty(), "{}, column round_seconds: the field contains no number", row.place());
    timed.append(row);
  }
  const std::vector<double> means = means_of_rounds(of_programs);
  if (!means.empty()) ratios.add(fmt::format("{} on {} programs", name, of_programs.size()), means);
  return left_out(slower, timed, fmt::format("not solved with {} or {}, which favours {} with", slow, fast, slow));
}

/// "12 % by the tape": the share of time in evaluations of solves, where both were measured; no words elsewhere.
Words share_of_evaluations(const Selection& rows, const char* derivatives) {
  double evaluations = 0.0;
  double seconds = 0.0;
  for (const Row& row : rows.where("derivatives", derivatives).usable()) {
    const auto of_row = row.number("evaluation_seconds");
    if (!of_row || !row.number("seconds")) continue;
    evaluations += *of_row;
    seconds += *row.number("seconds");
  }
  if (seconds <= 0.0) return {};
  return worded("{:.0f} % by {}",
                Measurement{"share of time in evaluations", 100.0 * evaluations / seconds, "", derivatives, "%"},
                derivatives);
}

/// The reason: the cost of a Jacobian.
Words costs_of_jacobians(const ResultTables& tables, const std::string& problem) {
  if (!tables.has(warm)) return {};
  const Selection rows = by_ipopt(tables, warm, problem);
  const auto cost = [&](const char* derivatives, const char* in_words) {
    return range_of(rows, derivatives, in_words, "jacobian_over_residual");
  };
  const Words costs = joined({cost("dense_differences", "dense differences"),
                              cost("adolc_whole", "ADOL-C recorded once"), cost("adolc", "ADOL-C interval by interval"),
                              cost("forward_differences", "structured differences"), cost("tape", "the tape")},
                             ", ");
  return costs.is_empty() ? costs : worded("the cost of a Jacobian, in residuals: {}", costs);
}

/// Solves of a kind with a name.
struct Setting {
  Selection rows;
  const char* name;
};

std::vector<Setting> settings_of(const ResultTables& tables, const std::string& problem) {
  std::vector<Setting> settings{{by_ipopt(tables, quasi_newton, problem), "quasi-Newton with first derivatives"}};
  if (tables.has(warm)) settings.push_back({by_ipopt(tables, warm, problem), "first and second derivatives"});
  return settings;
}

/// A number of solves by differences over the same of exact ones, program by program; of all programs, or of those that
/// both solve.
std::vector<Measurement> ratios_by_program(const Setting& setting, const Rivals& rivals, const char* column,
                                           bool of_solved) {
  for (const Row& row : setting.rows) static_cast<void>(row.needed("tolerance"));
  const auto by = [&](const char* derivatives) {
    const Selection rows = setting.rows.where("derivatives", derivatives);
    return of_solved ? rows.usable() : rows;
  };
  const Selection exact = by(rivals.exact);
  std::vector<Measurement> ratios;
  for (const Row& row : by(rivals.differences)) {
    const Row& other = partner_of(row, exact);
    if (other.text("status").empty()) continue;
    ratios.push_back({std::string(column) + " with differences over exact derivatives", quotient(row, other, column),
                      row.text("method"), fmt::format("{}, N = {}", setting.name, row.text("intervals"))});
  }
  return ratios;
}

/// "1.2 to 1.4 on 3 programs, geometric mean 1.3".
Words range_of(const std::vector<Measurement>& ratios) {
  if (ratios.empty()) return worded("(none)");
  const auto [least, most] = std::ranges::minmax(ratios, {}, &Measurement::value);
  double sum = 0.0;
  for (const Measurement& ratio : ratios) sum += std::log(ratio.value);
  const Measurement mean{"geometric mean of " + least.name, std::exp(sum / static_cast<double>(ratios.size()))};
  return worded("{:.2f} to {:.2f} on {} programs, geometric mean {:.2f}", least, most, ratios.size(), mean);
}

/// By the iterations of the programs that both solve, a count that repeats, in every setting; the time of a Jacobian
/// stands next to it and decides nothing.
Finding faster(const ResultTables& tables, const std::string& problem) {
  const std::vector<Setting> settings = settings_of(tables, problem);
  const Rivals rivals = of_the_paper(settings.front().rows);
  std::vector<ClaimVerdict> verdicts;
  std::vector<Words> words;
  for (const Setting& setting : settings) {
    const std::vector<Measurement> jacobians = ratios_by_program(setting, rivals, "jacobian_over_residual", false);
    if (jacobians.empty()) continue;
    const std::vector<Measurement> iterations = ratios_by_program(setting, rivals, "major_iterations", true);
    words.push_back(worded("{}: ratio of iterations {} (where both solve), ratio of times of a Jacobian {}",
                           setting.name, range_of(iterations), range_of(jacobians)));
    if (iterations.empty()) continue;
    const auto [least, most] = std::ranges::minmax(iterations, {}, &Measurement::value);
    verdicts.push_back(verdict_on_interval(least.value, most.value, 1.0, std::numeric_limits<double>::infinity()));
  }
  require(!words.empty(), "{}.csv has no program of {} with {} and with {}", quasi_newton, problem, rivals.differences,
          rivals.exact);
  const Words shares = joined({share_of_evaluations(settings.front().rows, rivals.differences),
                               share_of_evaluations(settings.front().rows, rivals.exact)},
                              ", ");
  return found(verdicts.empty() ? ClaimVerdict::undecided : verdict_on_all(verdicts), "{} over {}, {}",
               rivals.differences, rivals.exact, joined(words, "; "))
      .because(
          shares.is_empty()
              ? shares
              : worded(
                    "first derivatives and residuals take {} of the time of a quasi-Newton solve, so the "
                    "time of a whole solve follows the number of iterations (`automatic_differentiation_saves_time`)",
                    shares));
}

Finding saves_time(const ResultTables& tables, const std::string& problem) {
  const std::vector<Setting> settings = settings_of(tables, problem);
  const Rivals rivals = of_the_paper(settings.front().rows);
  TimedRatios ratios(1.0);
  TimedRatios structured(1.0);
  std::vector<Words> unsolved;
  for (const auto& [rows, name] : settings) {
    unsolved.push_back(add_ratio(ratios, rows, name, rivals.differences, rivals.exact));
    static_cast<void>(add_ratio(structured, rows, name, of_the_suite.differences, of_the_suite.exact));
  }
  require(ratios.rounds() > 0, "{}.csv and {}.csv: no program of {} is solved with {} and with {}", quasi_newton, warm,
          problem, rivals.differences, rivals.exact);
  const Words aside = structured.rounds() > 0
                          ? worded("with structured differences and with the tape: {}", structured.in_words())
                          : Words();
  return found_by_times(ratios, fmt::format("ratio of times of whole solves with {} and with {}: ", rivals.differences,
                                            rivals.exact))
      .also(aside)
      .also(joined(unsolved, "; "))
      .because(costs_of_jacobians(tables, problem));
}

}  // namespace

/// Automatic differentiation.
Claims derivative_claims() {
  const char* const section = "section 4.1, Automatic Differentiation";
  const char* const setting =
      "solved with Ipopt to the tolerances 1e-6 (as with fmincon) and 1e-8 in at most 150 iterations; dense "
      "differences are used up to N = 64; we infer that fmincon and nag_opt_nlp_sparse used dense forward differences "
      "and quasi-Newton updates";
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
          {.id = "automatic_differentiation_saves_time",
           .where = section,
           .states = "whole solves take less time with automatic differentiation than with finite differences",
           .judge = saves_time,
           .condition = setting,
           .evidence = {"derivatives_quasi_newton.csv", "derivatives.csv", "figures/{}_derivatives.svg"}}};
}

}  // namespace dmocbench
