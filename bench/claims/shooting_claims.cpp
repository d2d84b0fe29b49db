// Section 3.3 names the rivals of DMOC among the direct methods: shooting and multiple shooting. Their accuracy, cost
// and reliability.
#include <algorithm>
#include <array>
#include <cmath>

#include "bench/claims/cold_start_counts.hpp"
#include "bench/claims/timed_ratios.hpp"
#include "bench/tables/ratios.hpp"

namespace dmocbench {

namespace {

constexpr const char* multiple = "multiple_shooting_rk4_1";
constexpr const char* single = "single_shooting_rk4_1";
/// The paper's problems, and a swing-up.
const Problems with_swing_up{orbit, two_link, "cart_pole"};

/// A method of shooting with a tableau of Gauss for its control, and the order that theory gives them.
struct ExpectedOrder {
  const char* table;
  const char* method;
  const char* stages;
  double order;
};
constexpr std::array expected_orders{
    ExpectedOrder{"convergence_shooting_two_stages_slopes", multiple, "2", 4.0},
    ExpectedOrder{"convergence_shooting_slopes", multiple, "1", 2.0},
    ExpectedOrder{"convergence_shooting_slopes", "multiple_shooting_midpoint_1", "1", 2.0}};

Finding order_of_shooting(const ResultTables& tables, const std::string& problem) {
  std::vector<Words> words;
  std::vector<ClaimVerdict> verdicts;
  bool is_floor = false;
  for (const auto& [table, method, stages, order] : expected_orders) {
    const Selection slopes = tables.rows(table, problem).where("quantity", "state").where("tableau", "gauss");
    const Selection rows = slopes.where("method", method).where("stages", stages);
    require(rows.size() == 1, "{}.csv has {} orders of the state of {} by {}, s = {}; one is needed", table,
            rows.size(), problem, method, stages);
    const Row& row = rows.front();
    const bool is_fitted = row.text("verdict") == "slope";
    is_floor = is_floor || !is_fitted;
    if (is_fitted) verdicts.push_back(verdict_on_order(row, order));
    const auto slope = [&] { return Measurement{"slope of the state", row.needed("slope"), row.text("method")}; };
    words.push_back(worded("{} s = {} {}", method, stages,
                           is_fitted ? worded("{:.2f}", slope()) : worded("{}", row.text("verdict"))));
  }
  const ClaimVerdict of_fitted = verdict_on_all(verdicts);
  const ClaimVerdict verdict = is_floor && of_fitted == ClaimVerdict::reproduced ? ClaimVerdict::floor : of_fitted;
  return found(verdict, "slopes of the state error relative to the indirect solution: {}", joined(words, ", "));
}

/// The row of cold starts of a method by Ipopt.
Row cold_starts_of(const ResultTables& tables, const std::string& problem, const char* method) {
  const Selection rows = midpoint(tables.rows("cold_start_shooting_shares", problem), method).where("solver", "ipopt");
  require(rows.size() == 1, "cold_start_shooting_shares.csv has {} rows of {} by {} and ipopt; one is needed",
          rows.size(), problem, method);
  return rows.front();
}

/// The verdict on "the first succeeds more often than the second", by the intervals of two differences: of the starts
/// that are solved, and of those that are also confirmed by integrating each interval. Where a grid is too coarse for a
/// method's order, its solves are not confirmed.
Finding more_often(const ResultTables& tables, const std::string& problem, const char* first, const char* second) {
  const Row row = cold_starts_of(tables, problem, first);
  const Row other = cold_starts_of(tables, problem, second);
  require(row.text("intervals") == other.text("intervals"), "{} and {} have different grids", row.place(),
          other.place());
  const auto count = [](const std::string& name, std::size_t value, const char* method) {
    return Measurement{name, static_cast<double>(value), method};
  };
  std::vector<ClaimVerdict> verdicts;
  std::vector<Words> words;
  for (const char* const column : {"solved", "confirmed"}) {
    const ShareCount own = count_of_cold_starts(row, column);
    const ShareCount others = count_of_cold_starts(other, column);
    const ShareInterval difference = difference_interval(own, others);
    verdicts.push_back(difference.lower > 0.0    ? ClaimVerdict::reproduced
                       : difference.upper <= 0.0 ? ClaimVerdict::differs
                                                 : ClaimVerdict::undecided);
    const std::string starts = fmt::format("starts {}", column);
    words.push_back(worded(
        "{} {} {} of {}, {} {} of {}, shares differ by {:+.1f} to {:+.1f} %", column, first,
        count(starts, own.hits, first), count("starts", own.trials, first), second, count(starts, others.hits, second),
        count("starts", others.trials, second),
        Measurement{"lower confidence limit of the difference of " + starts, 100.0 * difference.lower, first, "", "%"},
        Measurement{"upper confidence limit of the difference of " + starts, 100.0 * difference.upper, first, "",
                    "%"}));
  }
  const auto failures = [](const Row& of_method, const char* method) {
    const std::string& unsolved = of_method.text("failures");
    return fmt::format("{}: {}{}solved but too coarse {}", method, unsolved, unsolved.empty() ? "" : ", ",
                       of_method.text("too_coarse"));
  };
  return found(verdict_on_all(verdicts), "cold starts {}", joined(words, "; "))
      .also(worded("95 % intervals"))
      .because(worded("failures of {}; of {}", failures(row, first), failures(other, second)))
      .as_sure_as(fmt::format("95 %, {} starts", row.text("starts")));
}

/// Errors of the cost with the times of solves, one curve for each round.
using Curves = std::vector<std::vector<ErrorCostPoint>>;

Curves timed_curves(const ResultTables& tables, const std::string& problem, const char* method) {
  const Selection rows = midpoint(tables.rows("savings_by_solver_shooting", problem), method)
                             .where("solver", "ipopt")
                             .sorted_by("intervals");
  require(rows.size() > 1 && rows.are_usable(),
          "savings_by_solver_shooting.csv needs several grids of {} by {}, all solved on the required branch", problem,
          method);
  Curves curves;
  for (const Row& row : rows) {
    const std::vector<double> seconds = row.numbers("round_seconds");
    const double error = row.needed("objective_error");
    require(error > 0.0, "{}, column objective_error: {} is not positive", row.place(), error);
    if (&row == &rows.front()) curves.resize(seconds.size());
    curves.resize(std::min(curves.size(), seconds.size()));
    for (std::size_t round = 0; round < curves.size(); ++round) {
      curves[round].push_back({std::log10(error), seconds[round]});
    }
  }
  require(!curves.empty(), "{}, column round_seconds: the field contains no number", rows.front().place());
  return curves;
}

/// The error of a curve's finest grid.
double smallest_error(const Curves& curves) { return curves.front().back().log_error; }

/// The time of a method to DMOC's where both have the same error of the cost, the smallest one that both reach.
Predicate costs_more(const char* method) {
  return [method](const ResultTables& tables, const std::string& problem) -> Finding {
    constexpr double same_error = 1e-9;
    const Curves dmoc = timed_curves(tables, problem, "dmoc");
    const Curves other = timed_curves(tables, problem, method);
    const double error = std::pow(10.0, std::max(smallest_error(dmoc), smallest_error(other)));
    std::vector<double> ratios;
    for (std::size_t round = 0; round < std::min(dmoc.size(), other.size()); ++round) {
      const auto quotient_of_times =
          ratio(cost_at_error(other[round], error, same_error), cost_at_error(dmoc[round], error, same_error));
      require(quotient_of_times.has_value(),
              "savings_by_solver_shooting.csv: {} by {} and DMOC reach no common error of the cost", problem, method);
      ratios.push_back(*quotient_of_times);
    }
    TimedRatios timed(1.0);
    timed.add(method, ratios);
    return found_by_times(
        timed,
        fmt::format("solve time with Ipopt relative to DMOC at a relative error of the cost of {:.1e}: ", error));
  };
}

}  // namespace

/// Claims that compare direct shooting with DMOC.
Claims shooting_claims() {
  const std::vector<std::string> cold{"cold_start_shooting_shares.csv", "figures/{}_shooting.svg"};
  const char* const where = "section 3.3, direct methods";
  const char* const by_ipopt =
      "solved with Ipopt on one grid; DMOC is of order 2, and shooting uses rk4 with one step per interval";
  const auto succeeds_more_often = [](const char* first, const char* second) -> Predicate {
    return [=](const ResultTables& tables, const std::string& problem) {
      return more_often(tables, problem, first, second);
    };
  };
  const auto dearer = [&](const char* id, const char* method, const char* states) {
    return Claim{.id = id,
                 .where = where,
                 .states = states,
                 .judge = costs_more(method),
                 .condition = "warm solves from the common start with Ipopt, s = 1, one rk4 step per interval",
                 .evidence = {"savings_by_solver_shooting.csv"}};
  };
  return {{.id = "order_of_shooting",
           .where = where,
           .states = "the order of shooting is the smaller of the orders of its integrator (4 for rk4, 2 for the "
                     "midpoint rule) and its control (2s)",
           .judge = order_of_shooting,
           .condition = "the midpoint rule is used with s = 1, because it evaluates only the control at the midpoint",
           .evidence = {"convergence_shooting_slopes.csv", "convergence_shooting_two_stages_slopes.csv",
                        "figures/{}_shooting.svg"}},
          {.id = "multiple_shooting_more_robust_than_single",
           .problems = with_swing_up,
           .where = where,
           .states = "from cold starts (the guess and perturbed guesses), programs of multiple shooting are solved "
                     "more often, and confirmed more often, than programs of single shooting",
           .judge = succeeds_more_often(multiple, single),
           .condition = by_ipopt,
           .evidence = cold},
          {.id = "dmoc_more_robust_than_multiple_shooting",
           .problems = with_swing_up,
           .where = where,
           .states = "from cold starts (the guess and perturbed guesses), programs of DMOC are solved more often, and "
                     "confirmed more often, than programs of multiple shooting",
           .judge = succeeds_more_often("dmoc", multiple),
           .condition = by_ipopt,
           .evidence = cold},
          dearer("multiple_shooting_slower_at_equal_error", multiple,
                 "for the same error of the cost, a solve takes longer with multiple shooting than with DMOC"),
          dearer("single_shooting_slower_at_equal_error", single,
                 "for the same error of the cost, a solve takes longer with single shooting than with DMOC")};
}

}  // namespace dmocbench
