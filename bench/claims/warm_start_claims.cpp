// Sequences of problems that start from each other's answers: does DMOC start warm better than collocation?
#include <cmath>

#include "bench/claims/claim.hpp"
#include "bench/claims/timed_ratios.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

/// The share of a sequence's steps that both methods have to solve.
constexpr double enough_steps = 0.9;

/// Collocation's number over DMOC's, at every step of a sequence that both solved.
struct StepRatios {
  std::string method;    ///< "hamiltonian"
  std::string sequence;  ///< "homotopy"
  std::vector<double> microseconds;
  double iterations = 0.0;  ///< of all these steps, over DMOC's
  std::size_t left_out = 0;

  [[nodiscard]] std::string name() const { return method + ", " + sequence; }
};

double count(const Row& row, const char* column) {
  const double value = row.needed(column);
  require(value >= 0.0 && value == std::floor(value), "{}: {} is {}, which is not a count", row.place(), column, value);
  return value;
}

StepRatios ratios_of(const Selection& dmoc, const Selection& others, const std::string& method,
                     const std::string& sequence) {
  StepRatios ratios{.method = method, .sequence = sequence, .microseconds = {}};
  double own_iterations = 0.0;
  double other_iterations = 0.0;
  for (const Row& own : dmoc) {
    const Selection same = others.matching(own, {"tableau", "stages", "intervals", "step"});
    if (same.size() != 1 || own.text("status") != "solved" || same.front().text("status") != "solved") {
      ++ratios.left_out;
      continue;
    }
    const Row& other = same.front();
    own_iterations += count(own, "iterations");
    other_iterations += count(other, "iterations");
    ratios.microseconds.push_back(quotient(other, own, "microseconds"));
  }
  const auto steps = static_cast<double>(dmoc.size());
  require(static_cast<double>(ratios.microseconds.size()) >= enough_steps * steps,
          "sequence.csv: only {} of {} steps of {} are solved by both methods", ratios.microseconds.size(), steps,
          ratios.name());
  require(own_iterations > 0.0, "sequence.csv: the steps of dmoc take no iterations ({})", ratios.name());
  ratios.iterations = other_iterations / own_iterations;
  return ratios;
}

/// Of every kind of collocation and every sequence.
std::vector<StepRatios> all_ratios(const ResultTables& tables, const std::string& problem) {
  const Selection rows = tables.rows("sequence", problem);
  std::vector<StepRatios> all;
  for (const std::string sequence : {"receding_horizon", "homotopy"}) {
    const Selection of_sequence = rows.where("sequence", sequence);
    require(!of_sequence.empty(), "sequence.csv has no {} of {}", sequence, problem);
    const Selection dmoc = midpoint(of_sequence, "dmoc");
    require(!dmoc.empty(), "sequence.csv has no {} of {} by dmoc", sequence, problem);
    for (const std::string method : {"hamiltonian", "tangent"}) {
      const Selection others = midpoint(of_sequence, method);
      require(!others.empty(), "sequence.csv has no {} of {} by {}", sequence, problem, method);
      all.push_back(ratios_of(dmoc, others, method, sequence));
    }
  }
  return all;
}

Words left_out_of(const std::vector<StepRatios>& all) {
  std::size_t count = 0;
  for (const StepRatios& ratios : all) count += ratios.left_out;
  return count == 0 ? Words() : worded("{} left out: not solved by both methods", counted(count, "step"));
}

Finding ratios_of_iterations(const ResultTables& tables, const std::string& problem) {
  const std::vector<StepRatios> all = all_ratios(tables, problem);
  const auto in_words = [](const StepRatios& ratios) {
    return worded("{} {:.2f}", ratios.name(),
                  Measurement{"iterations relative to DMOC", ratios.iterations, ratios.method, ratios.sequence});
  };
  return found(ClaimVerdict::measured, "iterations relative to DMOC: {}", joined(all, ", ", in_words))
      .also(left_out_of(all));
}

Finding less_time(const ResultTables& tables, const std::string& problem) {
  const std::vector<StepRatios> all = all_ratios(tables, problem);
  TimedRatios timed(1.0);
  for (const StepRatios& ratios : all) timed.add(ratios.name(), ratios.microseconds);
  return found_by_times(timed, "time of a step relative to DMOC: ").also(left_out_of(all));
}

}  // namespace

/// Sequences that start from each other's answers.
Claims warm_start_claims() {
  return {{.id = "iterations_of_warm_starts",
           .where = "section 4.1, SQP Method",
           .states = "ratio of iterations (collocation to DMOC) for warm starts from the unknowns and multipliers of "
                     "the previous problem",
           .judge = ratios_of_iterations,
           .condition = "solved with interior_point",
           .evidence = {"sequence.csv", "figures/{}_sequence.svg"},
           .has_verdict = false},
          {.id = "warm_starts_in_less_time",
           .where = "section 3.4, rem:savings",
           .states = "with warm starts from the unknowns and multipliers of the previous problem, a step takes less "
                     "time with DMOC than with collocation",
           .judge = less_time,
           .condition = "solved with interior_point; the time of each step is the shortest of its repeats",
           .evidence = {"sequence.csv", "figures/{}_sequence.svg"}}};
}

}  // namespace dmocbench
