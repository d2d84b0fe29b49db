// The five questions of the first screen. Every word that depends on a result is chosen by a predicate on the tables or
// by verdicts of claims; where its rows are missing, a question is left out.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "bench/claims/claim.hpp"
#include "bench/report/model.hpp"
#include "bench/report/small_picture.hpp"
#include "bench/report/words.hpp"
#include "bench/tables/ratio_interval.hpp"
#include "bench/tables/selection.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> methods{"dmoc", "hamiltonian", "tangent"};
const Json no_answer;

/// The smallest and the largest of some numbers.
struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// "1.5 to 1.7", or one number where both round to it.
  [[nodiscard]] std::string text(int digits) const {
    const std::string first = fmt::format("{:.{}f}", low, digits);
    const std::string last = fmt::format("{:.{}f}", high, digits);
    return first == last ? first : first + " to " + last;
  }
};

/// The rows of a table on the paper's problems as they are stated; none without the table.
Selection rows_of(const ResultsFolder& results, const std::string& file) {
  const auto found = std::ranges::find(results.tables, file, &ReportedTable::file);
  if (found == results.tables.end()) return {};
  return Selection(found->table).where([](const Row& row) {
    return row.text("settings").empty() && std::ranges::count(of_paper, row.text("problem")) > 0;
  });
}

/// The rows of the methods with one Gauss stage, which were solved where the table has a status, with a number in a
/// column.
Selection of_one_stage(const Selection& rows, const std::string& column) {
  return rows
      .where([](const Row& row) {
        const std::string& status = row.text("status");
        return row.text("tableau") == "gauss" && row.text("stages") == "1" && (status.empty() || status == "solved");
      })
      .with_number(column);
}

Selection rows_of(const Selection& rows, const std::string& problem, const std::string& method) {
  return rows.where("problem", problem).where("method", method);
}

/// Whether both problems have rows of these methods.
template <class Methods>
bool are_complete(const Selection& rows, const Methods& wanted) {
  return std::ranges::all_of(of_paper, [&](const std::string& problem) {
    return std::ranges::all_of(wanted, [&](const char* method) { return !rows_of(rows, problem, method).empty(); });
  });
}

/// The claims of these names on the paper's problems.
std::vector<Json> claims_of(const ResultsFolder& results, std::initializer_list<std::string_view> names) {
  std::vector<Json> claims;
  for (const Json& claim : results.claims) {
    if (std::ranges::count(names, claim.at("name").get<std::string>()) > 0 &&
        std::ranges::count(of_paper, claim.at("problem").get<std::string>()) > 0)
      claims.push_back(claim);
  }
  return claims;
}

/// The verdict of all these claims; empty if they have several or there are none.
std::string common_verdict(const std::vector<Json>& claims) {
  const bool is_one = !claims.empty() && std::ranges::all_of(claims, [&](const Json& claim) {
    return claim.at("verdict") == claims.front().at("verdict");
  });
  return is_one ? claims.front().at("verdict").get<std::string>() : "";
}

/// The sentence that fits the verdicts of a claim.
std::string by_verdict(const ResultsFolder& results, std::string_view claim, const char* holds, const char* differs,
                       const char* otherwise) {
  const std::string verdict = common_verdict(claims_of(results, {claim}));
  return verdict == "reproduced" ? holds : verdict == "differs" ? differs : otherwise;
}

/// The verdicts on which an answer rests, each with links to its claims; a claim with the same verdict on both problems
/// has one link.
Json verdicts_of(const std::vector<Json>& claims) {
  std::map<std::string, Json> by_words;
  for (const Json& claim : claims) {
    const std::string words =
        verdict_in_words(claim.at("verdict").get<std::string>(), claim.at("whose").get<std::string>());
    Json& group = by_words[words];
    if (group.is_null()) group = {{"verdict", claim.at("verdict")}, {"verdict_words", words}, {"links", Json::array()}};
    std::vector<Json> same;
    std::ranges::copy_if(claims, std::back_inserter(same),
                         [&](const Json& other) { return other.at("name") == claim.at("name"); });
    const bool is_common = !common_verdict(same).empty();
    if (is_common && claim != same.front()) continue;
    const std::string section = section_of(claim);
    const std::string source = claim.at("whose") == "paper" ? "§" + section.substr(section.find(' ') + 1)
                                                            : in_words(claim.at("name").get<std::string>());
    group["links"].push_back(
        {{"claim", claim.at("claim")},
         {"words", in_words(claim.at("name").get<std::string>())},
         {"text", is_common ? source : source + (claim.at("problem") == orbit ? " orbit" : " arm")}});
  }
  Json verdicts = Json::array();
  for (auto& [words, group] : by_words) verdicts.push_back(std::move(group));
  return verdicts;
}

/// "2.1 % larger", "60 % larger" or "equal" for a ratio.
std::string compared(double ratio, const char* larger, const char* smaller) {
  const double percent = 100.0 * std::abs(ratio - 1.0);
  if (percent < 0.05) return "equal";
  const std::string number = percent < 10.0 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent);
  return fmt::format("{} % {}", number, ratio > 1.0 ? larger : smaller);
}

std::vector<MethodCurve> curves_of(const Selection& rows, const std::string& problem, const std::string& column) {
  std::vector<MethodCurve> curves;
  for (const char* const method : methods) {
    curves.push_back({.method = method, .points = {}});
    for (const Row& row : rows_of(rows, problem, method).sorted_by("intervals"))
      curves.back().points.emplace_back(row.needed("intervals"), row.needed(column));
  }
  return curves;
}

std::string in_unit(const char* quantity, const std::string& unit) {
  return unit.empty() || unit == "dimensionless" ? quantity : fmt::format("{} [{}]", quantity, unit);
}

/// A picture of each problem.
template <class Draw>
Json pictures_of(const Draw& draw) {
  Json pictures = Json::array();
  for (const std::string& problem : of_paper) {
    const ProblemCard card = make_problem(problem)->card();
    pictures.push_back({{"problem_words", card.title}, {"picture", draw(problem, card.axis_units)}});
  }
  return pictures;
}

/// A column with one method over the same with another, on the finest grid of both; and that number of intervals.
std::pair<double, int> ratio_on_finest_grid(const Selection& rows, const std::string& problem, const char* above,
                                            const std::string& column) {
  const Selection dmoc = rows_of(rows, problem, "dmoc");
  const Selection other = rows_of(rows, problem, above).where([&](const Row& row) {
    return !dmoc.where("intervals", row.text("intervals")).empty();
  });
  if (other.empty()) return {std::nan(""), 0};
  const Row& finest = other.sorted_by("intervals").back();
  const Row& same = dmoc.where("intervals", finest.text("intervals")).front();
  return {finest.needed(column) / same.needed(column), static_cast<int>(finest.needed("intervals"))};
}

/// "a on the orbit, b on the arm (N = 512)" for comparisons on the finest grids.
std::string on_both(const std::string& first, int first_grid, const char* between, const std::string& second,
                    int second_grid) {
  return first_grid == second_grid
             ? fmt::format("{} on the orbit{}{} (N = {})", first, between, second, second_grid)
             : fmt::format("{} on the orbit (N = {}){}{} (N = {})", first, first_grid, between, second, second_grid);
}

/// "with the same order, 2 (fits: 1.96 to 2.01)" where all fits round to the same order.
std::string same_order(const Selection& orders) {
  const Span fits{.low = orders.min("slope"), .high = orders.max("slope")};
  const bool is_same = std::round(fits.low) == std::round(fits.high);
  return is_same ? fmt::format("with the same order, {:.0f} (fits: {})", fits.low, fits.text(2))
                 : fmt::format("with a different order (fits of all three methods: {})", fits.text(2));
}

Json accuracy(const ResultsFolder& results) {
  const Selection pairs = rows_of(results, "equivalence.csv")
                              .where("method", "hamiltonian")
                              .where("status", "solved")
                              .with_number("control_difference");
  const Selection errors = of_one_stage(rows_of(results, "convergence.csv"), "state_error");
  const Selection orders = of_one_stage(rows_of(results, "convergence_slopes.csv").where("quantity", "state"), "slope");
  if (!are_complete(pairs, std::array{"hamiltonian"}) || !are_complete(errors, methods) ||
      !are_complete(orders, methods))
    return no_answer;
  double worst = 0.0;
  for (const char* const column :
       {"configuration_difference", "momentum_difference", "control_difference", "objective_difference"})
    worst = std::max(worst, pairs.max(column));
  const auto [on_orbit, finest] = ratio_on_finest_grid(errors, orbit, "tangent", "state_error");
  const auto [on_arm, finest_on_arm] = ratio_on_finest_grid(errors, two_link, "tangent", "state_error");
  if (finest == 0 || finest_on_arm == 0) return no_answer;
  return {{"question", "Are they equally accurate?"},
          {"answer",
           by_verdict(results, "equal_solutions", "DMOC and Hamiltonian collocation have equal solutions to round-off.",
                      "DMOC and Hamiltonian collocation have different solutions.",
                      "It is undecided whether DMOC and Hamiltonian collocation have equal solutions.")},
          {"but", fmt::format("Tangent-space collocation converges {}; its state error is {}.", same_order(orders),
                              on_both(compared(on_orbit, "larger", "smaller"), finest, " and on the arm ",
                                      compared(on_arm, "larger", "smaller"), finest_on_arm))},
          {"number", scientific(worst)},
          {"unit",
           fmt::format("largest relative difference of both methods in q, p, u and cost on {} grids", pairs.size())},
          {"verdicts", verdicts_of(claims_of(results, {"equal_solutions", "state_slope"}))},
          {"cells", pictures_of([&](const std::string& problem, const AxisUnits& units) {
             return curves_picture(in_unit("state error", units.state) + " over intervals N",
                                   curves_of(errors, problem, "state_error"));
           })}};
}

/// How much DMOC's controls miss the final state, compared with the controls of tangent-space collocation.
std::string replay_in_words(const Selection& replays) {
  const auto [orbit_ratio, on_orbit] = ratio_on_finest_grid(replays, orbit, "tangent", "replay_error");
  const auto [arm_ratio, on_arm] = ratio_on_finest_grid(replays, two_link, "tangent", "replay_error");
  if (on_orbit == 0 || on_arm == 0) return "";
  const bool are_opposite = (orbit_ratio > 1.0) != (arm_ratio > 1.0);
  const auto by_how_much = [](double ratio, const char* than, const char* equal) {
    const std::string words = compared(1.0 / ratio, "more", "less");
    return words == "equal" ? std::string(equal) : "by " + words + than;
  };
  return fmt::format("{} replayed, DMOC's controls miss the final state {}.",
                     are_opposite ? "The balance does not bound the error: when" : "When",
                     on_both(by_how_much(orbit_ratio, " than", "as much as") + " tangent-space collocation", on_orbit,
                             ". On the arm they miss it ", by_how_much(arm_ratio, "", "as much"), on_arm));
}

Json structure(const ResultsFolder& results) {
  const Selection defects = of_one_stage(rows_of(results, "consistency.csv"), "momentum_defect_max");
  const Selection replays = of_one_stage(rows_of(results, "convergence.csv"), "replay_error");
  if (!are_complete(defects, methods) || !are_complete(replays, methods)) return no_answer;
  const double most =
      defects.where([](const Row& row) { return row.text("method") != "tangent"; }).max("momentum_defect_max");
  return {{"question", "Do they preserve the structure?"},
          {"answer", by_verdict(results, "momentum_consistency",
                                "DMOC and Hamiltonian collocation balance momentum and force to round-off; "
                                "tangent-space collocation does not.",
                                "DMOC and Hamiltonian collocation do not both balance momentum and force to round-off.",
                                "It is undecided whether only DMOC and Hamiltonian collocation balance momentum and "
                                "force to round-off.")},
          {"but", replay_in_words(replays)},
          {"number", scientific(most)},
          {"unit", "largest difference of momentum and force with both methods on any interval of any grid"},
          {"verdicts", verdicts_of(claims_of(results, {"momentum_consistency"}))},
          {"cells", pictures_of([&](const std::string& problem, const AxisUnits& units) {
             return curves_picture(in_unit("momentum minus force", units.momentum) + " over intervals N",
                                   curves_of(defects, problem, "momentum_defect_max"));
           })}};
}

Span span_of(const Selection& rows, const std::string& column) {
  return {.low = rows.min(column), .high = rows.max(column)};
}

Json size(const ResultsFolder& results) {
  const Selection rows = of_one_stage(rows_of(results, "convergence_equal_accuracy.csv"), "variables_ratio");
  const Selection state = rows.where("quantity", "state");
  const Selection replay = rows.where("quantity", "replay");
  if (!are_complete(state, methods) || !are_complete(replay, std::array{"tangent"})) return no_answer;
  const Span others =
      span_of(state.where([](const Row& row) { return row.text("method") != "dmoc"; }), "variables_ratio");
  const Span on_orbit = span_of(rows_of(replay, orbit, "tangent"), "variables_ratio");
  const Span on_arm = span_of(rows_of(replay, two_link, "tangent"), "variables_ratio");
  return {{"question", "Which needs fewer unknowns?"},
          {"answer", others.low > 1.0    ? "DMOC, on both problems, because positions are its only states."
                     : others.high < 1.0 ? "Collocation, on both problems."
                                         : "It depends on the problem and on the accuracy."},
          {"but", fmt::format("At equal replay error, tangent-space collocation needs {} times DMOC's variables on the "
                              "orbit{}{} times on the arm.",
                              on_orbit.text(2), on_arm.high < on_orbit.low ? ", but only " : " and ", on_arm.text(2))},
          {"number", span_of(state.where("method", "hamiltonian"), "variables_ratio").text(1) + " ×"},
          {"unit", "DMOC's variables, with Hamiltonian collocation at equal state error"},
          {"verdicts", verdicts_of(claims_of(results, {"variable_ratio", "savings_at_equal_state_error"}))},
          {"cells", pictures_of([&](const std::string& problem, const AxisUnits&) {
             std::vector<std::pair<std::string, double>> bars;
             for (const char* const method : methods) {
               const Selection own = rows_of(state, problem, method);
               double sum = 0.0;
               for (const Row& row : own) sum += row.needed("variables_ratio");
               bars.emplace_back(method, sum / static_cast<double>(own.size()));
             }
             return bars_picture("variables for equal state error, DMOC = 1", bars);
           })}};
}

/// A way to solve whose times are compared: an iteration of Ipopt, a linear system of the own solver.
struct TimedWay {
  const char* name;
  const char* solver;
  const char* factorisation;
  const char* quantity;
};
constexpr std::array<TimedWay, 3> timed_ways{
    {{"Ipopt", "ipopt", "", "seconds_per_iteration"},
     {"sparse KKT", "interior_point", "sparse", "seconds_per_linear_system"},
     {"structured KKT", "interior_point", "intervals", "seconds_per_linear_system"}}};

/// The ratios of times of a problem on the finest grid, a line for each way.
std::vector<IntervalLine> lines_of_times(const Selection& rows, const std::string& problem) {
  std::vector<IntervalLine> lines;
  for (const TimedWay& way : timed_ways) {
    lines.push_back({.name = way.name, .intervals = {}});
    for (const char* const method : {"hamiltonian", "tangent"}) {
      const Selection own = rows_of(rows, problem, method)
                                .where("solver", way.solver)
                                .where("factorisation", way.factorisation)
                                .where("quantity", way.quantity);
      if (own.empty()) continue;
      const Row& finest = own.sorted_by("intervals").back();
      const double ratio = ratio_interval(finest.numbers("round_ratios")).ratio;
      lines.back().intervals.push_back({.method = method,
                                        .value = ratio,
                                        .lower = finest.number("ratio_lower", ratio),
                                        .upper = finest.number("ratio_upper", ratio)});
    }
  }
  std::erase_if(lines, [](const IntervalLine& line) { return line.intervals.size() != 2; });
  return lines;
}

/// The numbers of a claim on a problem whose names begin with "lowest" and "highest", "1.64 to 1.66"; empty without.
std::string measured_range(const ResultsFolder& results, std::string_view name, const std::string& problem) {
  Span span;
  for (const Json& claim : claims_of(results, {name})) {
    if (claim.at("problem") != problem || claim.at("measured").empty()) continue;
    for (const Json& number : claim.at("measured").front().at("numbers")) span.add(number.at("value").get<double>());
  }
  return span.low > span.high ? "" : span.text(2);
}

/// The paper's claim on iterations, from the first basis that it starts at and from a free one.
std::string iterations_in_words(const ResultsFolder& results) {
  const std::string slack_orbit = measured_range(results, "minor_iteration_ratio", orbit);
  const std::string slack_arm = measured_range(results, "minor_iteration_ratio", two_link);
  const std::string free_orbit = measured_range(results, "minor_iterations_saved_in_phase_1", orbit);
  const std::string free_arm = measured_range(results, "minor_iterations_saved_in_phase_1", two_link);
  if (slack_orbit.empty() || slack_arm.empty() || free_orbit.empty() || free_arm.empty()) return "";
  const std::string verdict = common_verdict(claims_of(results, {"minor_iteration_ratio"}));
  return fmt::format(
      "From the slack basis, collocation takes {} times DMOC's minor iterations on the orbit and {} times on the "
      "arm{}; from a basis chosen without iterations, {} and {} times.",
      slack_orbit, slack_arm, verdict == "reproduced" ? ", as in the paper" : "", free_orbit, free_arm);
}

/// Which method is faster, by the verdict on Hamiltonian collocation and the intervals of all ratios.
std::string faster(const std::vector<IntervalLine>& lines, const std::string& verdict) {
  Span ends;
  Span values;
  for (const IntervalLine& line : lines) {
    for (const MethodInterval& interval : line.intervals) {
      ends.add(interval.lower);
      ends.add(interval.upper);
      values.add(interval.value);
    }
  }
  const char* const depends = values.high > 1.1 * values.low ? " The ratio depends on the linear algebra." : "";
  if (verdict == "reproduced" && ends.low > 1.0) return fmt::format("DMOC, per iteration.{}", depends);
  if (verdict == "differs" && ends.high < 1.0) return fmt::format("Collocation, per iteration.{}", depends);
  if (values.low <= 1.0 && values.high >= 1.0) return "Undecided: the ratios of times lie on both sides of 1.";
  const bool excludes_equal_times = ends.low > 1.0 || ends.high < 1.0;
  return fmt::format("{} by the medians, but {}.", values.low > 1.0 ? "DMOC" : "Collocation",
                     excludes_equal_times ? "the claim is undecided" : "the rounds do not always exclude equal times");
}

Json cost(const ResultsFolder& results) {
  const Selection rows =
      of_one_stage(rows_of(results, "savings_by_solver_ratios.csv"), "intervals").where([](const Row& row) {
        return !row.text("round_ratios").empty();
      });
  std::vector<IntervalLine> all;
  std::map<std::string, std::vector<IntervalLine>> by_problem;
  for (const std::string& problem : of_paper) {
    by_problem[problem] = lines_of_times(rows, problem);
    if (by_problem[problem].empty()) return no_answer;
    all.insert(all.end(), by_problem[problem].begin(), by_problem[problem].end());
  }
  Span of_hamiltonian;
  for (const IntervalLine& line : all) of_hamiltonian.add(line.intervals.front().value);
  const std::string finest = rows.sorted_by("intervals").back().text("intervals");
  return {{"question", "Which is faster?"},
          {"answer", faster(all, common_verdict(claims_of(results, {"collocation_takes_longer"})))},
          {"but", iterations_in_words(results)},
          {"number", of_hamiltonian.text(1) + " ×"},
          {"unit", fmt::format("DMOC's time per iteration, with Hamiltonian collocation and N = {}", finest)},
          {"verdicts", verdicts_of(claims_of(results, {"collocation_takes_longer", "minor_iteration_ratio"}))},
          {"cells", pictures_of([&](const std::string& problem, const AxisUnits&) {
             return intervals_picture(fmt::format("time of an iteration, N = {}", finest), by_problem[problem]);
           })}};
}

/// "75 to 80 % of the starts lead to a confirmed solution, 42 to 47 % to the best minimum".
std::string starts_in_words(const Selection& rows) {
  Span solved;
  Span best;
  for (const Row& row : rows) {
    solved.add(100.0 * row.needed("confirmed") / row.needed("starts"));
    best.add(100.0 * row.needed("best") / row.needed("starts"));
  }
  const std::string first = fmt::format("{} % of the starts lead to a confirmed solution", solved.text(0));
  return best.text(0) == solved.text(0) ? first + ", which is the best minimum"
                                        : fmt::format("{}, and {} % to the best minimum", first, best.text(0));
}

Json robustness(const ResultsFolder& results) {
  const Selection rows = of_one_stage(rows_of(results, "cold_start_shares.csv"), "starts")
                             .where("solver", "interior_point")
                             .where("start_kind", "cold");
  if (!are_complete(rows, methods)) return no_answer;
  Span gaps;
  bool are_same = true;  // the differences of every problem as the ones of both
  for (const std::string& problem : of_paper) {
    Span own;
    const auto share = [&](const char* method, const char* column) {
      const Row& row = rows_of(rows, problem, method).front();
      return 100.0 * row.needed(column) / row.needed("starts");
    };
    for (const char* const column : {"confirmed", "best"}) {
      for (const char* const method : {"hamiltonian", "tangent"})
        own.add(share(method, column) - share("dmoc", column));
    }
    are_same = are_same && (own.low != 0.0 || own.high != 0.0);
    gaps.add(own.low);
    gaps.add(own.high);
  }
  const std::string where = are_same ? "on both problems" : "on one of the problems";
  return {{"question", "Which starts more reliably?"},
          {"answer", gaps.low < 0.0 && gaps.high > 0.0 ? "No method is clearly ahead: the differences have both signs."
                     : gaps.low == 0.0 && gaps.high == 0.0 ? "All methods are equally reliable."
                     : gaps.low >= 0.0                     ? "Collocation, " + where + "."
                                                           : "DMOC, " + where + "."},
          {"but", fmt::format("On the orbit {}. On the arm {}.", starts_in_words(rows.where("problem", orbit)),
                              starts_in_words(rows.where("problem", two_link)))},
          {"number", fmt::format("{:.1f} points", std::max(-gaps.low, gaps.high))},
          {"unit", "largest difference between DMOC and collocation in confirmed solutions and best minima"},
          {"verdicts", verdicts_of(claims_of(results, {"cold_starts_confirmed", "cold_starts_best"}))},
          {"cells", pictures_of([&](const std::string& problem, const AxisUnits&) {
             std::vector<MethodShares> shares;
             for (const char* const method : methods) {
               const Row& row = rows_of(rows, problem, method).front();
               shares.push_back({.method = method,
                                 .best = row.needed("best"),
                                 .other = row.needed("elsewhere"),
                                 .all = row.needed("starts")});
             }
             return shares_picture(fmt::format("{:.0f} starts", shares.front().all), shares);
           })}};
}

}  // namespace

PageModel answers_model(const ResultsFolder& results) {
  Json answers = Json::array();
  for (const auto& answer : {accuracy, structure, size, cost, robustness}) {
    Json found = answer(results);
    if (!found.is_null()) answers.push_back(std::move(found));
  }
  return answers;
}

}  // namespace dmocbench
