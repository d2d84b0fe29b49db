// Grids chosen by an error estimate: how good the estimate is, how much it saves, and whether DMOC keeps its advantage.
#include <algorithm>

#include "bench/claims/claim.hpp"
#include "methods/transcription/elements/families.hpp"

namespace dmocbench {

namespace {

constexpr double smallest_effectivity = 0.3;
constexpr double largest_effectivity = 3.0;
/// A first-order estimate is meaningful only for small errors.
constexpr double largest_estimated_error = 1e-2;
const Problems uneven_problems{"eccentric_transfer", "hypersensitive"};

double effectivity_of(const Row& row) {
  const double value = row.needed("effectivity");
  require(value >= 0.0, "{}: the effectivity is {}; it must not be negative", row.place(), value);
  return value;
}

std::size_t count_outside(const Selection& rows) {
  return static_cast<std::size_t>(std::ranges::count_if(rows, [](const Row& row) {
    return effectivity_of(row) < smallest_effectivity || effectivity_of(row) > largest_effectivity;
  }));
}

Words words_of_effectivity(const Row& row) {
  return worded(
      "{:.2f} ({}, {}, s = {}, N = {}, {})",
      Measurement{"ratio of estimated to true error", effectivity_of(row), row.text("method"), row.text("problem")},
      row.text("problem"), row.text("method"), row.text("stages"), row.text("intervals"), row.text("quantity"));
}

Finding effective(const ResultTables& tables, const std::string& /*problem*/) {
  const Selection all = tables.rows("adaptive_effectivity");
  const Selection measured = all.where("verdict", "measured");
  const auto is_small = [](const Row& row) { return row.needed("relative_error") <= largest_estimated_error; };
  const Selection judged_rows = measured.where(is_small);
  const Selection large = measured.where([&](const Row& row) { return !is_small(row); });
  require(!judged_rows.empty(), "adaptive_effectivity.csv has no error between the floor of round-off and 1 %");
  const auto [least, most] = std::ranges::minmax_element(judged_rows, {}, effectivity_of);
  const std::size_t outside = count_outside(judged_rows);
  const Selection coarse = all.where("status", "too coarse");
  const Selection unsolved =
      all.where([](const Row& row) { return row.text("status") != "solved" && row.text("status") != "too coarse"; });
  return found(outside == 0, "the ratio of estimated to true error ranges from {} to {}", words_of_effectivity(*least),
               words_of_effectivity(*most))
      .also(worded("{} of {} ratios lie outside 0.3 to 3", outside, judged_rows.size()))
      .also(worded("of {} ratios for errors above 1 %, {} lie outside", large.size(), count_outside(large)))
      .also(worded(
          "not judged: {} errors below the floor of round-off, {} solutions that are too coarse, {} unsolved programs",
          all.where("verdict", "floor").size(), coarse.size(), unsolved.size()))
      .also(worded("{} problems", measured.distinct("problem").size()));
}

/// The rows of a problem, method and kind of grid that reached the accuracy; there is at least one.
Selection reached(const ResultTables& tables, const std::string& problem, const std::string& method,
                  const std::string& grid) {
  Selection rows = tables.rows("adaptive", problem)
                       .where("method", method)
                       .where("grid", grid)
                       .where("status", "solved")
                       .with_number("intervals");
  require(!rows.empty(), "adaptive.csv has no {} grid of {} on which {} reaches the accuracy", grid, problem, method);
  return rows;
}

const Row& fewest_intervals(const Selection& rows) {
  return *std::ranges::min_element(rows, {}, [](const Row& row) {
    const double intervals = row.needed("intervals");
    require(intervals >= 1.0, "{}: {} intervals", row.place(), intervals);
    return intervals;
  });
}

/// The best number of stages for each kind of grid, and the ratio at equal numbers of stages.
Finding fewer_intervals(const ResultTables& tables, const std::string& problem) {
  std::vector<Words> words;
  for (const std::string& method : paper_families()) {
    const Selection adapted = reached(tables, problem, method, "adapted");
    const Selection uniform = reached(tables, problem, method, "uniform");
    const Row& best = fewest_intervals(adapted);
    const Row& other = fewest_intervals(uniform);
    const auto ratio = [&](const Row& uniform_row, const Row& adapted_row, const std::string& at) {
      return Measurement{"ratio of the numbers of intervals (uniform to adapted grids)",
                         quotient(uniform_row, adapted_row, "intervals"), method, at};
    };
    std::vector<Words> of_method{worded("{} {} (s = {}) instead of {} (s = {}), ratio {:.2f}", method,
                                        best.text("intervals"), best.text("stages"), other.text("intervals"),
                                        other.text("stages"), ratio(other, best, "the best numbers of stages"))};
    for (const Row& row : adapted) {
      const Selection same = uniform.matching(row, {"tableau", "stages"});
      if (same.size() != 1) continue;
      const std::string stages = "s = " + row.text("stages");
      of_method.push_back(worded("{}: {:.2f}", stages, ratio(same.front(), row, stages)));
    }
    words.push_back(joined(of_method, ", "));
  }
  return found(ClaimVerdict::measured, "intervals on adapted grids instead of uniform grids: {}", joined(words, "; "));
}

Finding more_variables_by_collocation(const ResultTables& tables, const std::string& problem) {
  const Selection dmoc = reached(tables, problem, "dmoc", "adapted");
  std::vector<Words> words;
  bool holds = true;
  for (const std::string method : {"hamiltonian", "tangent"}) {
    const Selection others = reached(tables, problem, method, "adapted");
    for (const Row& own : dmoc) {
      const Selection same = others.matching(own, {"tableau", "stages"});
      require(same.size() == 1, "adaptive.csv: {} has no adapted grid with {} stages to compare with DMOC's on {}",
              method, own.text("stages"), problem);
      const double ratio = quotient(same.front(), own, "variables_at_accuracy");
      holds = holds && ratio > 1.0;
      const std::string stages = "s = " + own.text("stages");
      words.push_back(
          worded("{} {}: {:.2f}", method, stages,
                 Measurement{"number of variables relative to DMOC at equal accuracy", ratio, method, stages}));
    }
  }
  return found(holds, "number of variables relative to DMOC at equal accuracy: {}", joined(words, ", "));
}

}  // namespace

/// Grids that an estimate of the error chooses.
Claims adaptive_claims() {
  return {
      {.id = "error_estimate_is_effective",
       .problems = examples,
       .where = "section 5, Adaptive Time Steps",
       .whose = Whose::extension,
       .states = "the errors of state, momentum, costate and cost are estimated from a single solve to within a factor "
                 "of 0.3 to 3",
       .judge = effective,
       .condition = "true errors are measured against the indirect solution; only errors above round-off count, in "
                    "solutions whose largest relative error is at most 1 %",
       .evidence = {"adaptive_effectivity.csv", "figures/adaptive_effectivity.svg"}},
      {.id = "adapted_grids_need_fewer_intervals",
       .problems = uneven_problems,
       .where = "section 5, Adaptive Time Steps",
       .whose = Whose::extension,
       .states = "ratio of the numbers of intervals for an error of 1e-8 (uniform grids to grids adapted by error "
                 "control, each with its best number of stages)",
       .judge = fewer_intervals,
       .condition = "errors are true errors of q, p and cost, relative to their ranges",
       .evidence = {"adaptive.csv", "figures/{}_adaptive.svg"},
       .has_verdict = false},
      {.id = "dmoc_keeps_its_advantage_on_adapted_grids",
       .problems = uneven_problems,
       .where = "section 5, Adaptive Time Steps",
       .whose = Whose::extension,
       .states = "on grids adapted to the same error, collocation needs more variables than DMOC",
       .judge = more_variables_by_collocation,
       .condition = "the true error and the order give the number of variables for an error of exactly 1e-8",
       .evidence = {"adaptive.csv"}}};
}

}  // namespace dmocbench
