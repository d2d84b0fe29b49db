// Feedback by plans: which differences between methods are left where an exact plant is measured and planned for anew.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claim.hpp"
#include "bench/tables/ratio_interval.hpp"

namespace dmocbench {

namespace {

const char* const loops_file = "closed_loop.csv";
const Problems of_loops{orbit, two_link, "cart_pole", "container_crane"};
const Problems of_loops_with_momentum{orbit, two_link, "cart_pole"};

/// A method compared with DMOC, on the same grid or with as many unknowns as nearly as grids permit.
struct Rivalry {
  std::string method;
  bool has_equal_intervals = false;
  [[nodiscard]] std::string name() const {
    return fmt::format("{}, equal {}", method, has_equal_intervals ? "intervals" : "unknowns");
  }
};
/// On the same grid Hamiltonian collocation has DMOC's plans.
const std::vector<Rivalry> rivalries{{"tangent", true}, {"tangent", false}, {"hamiltonian", false}};

/// The loops of a problem with plans of one stage.
Selection loops_of(const ResultTables& tables, const std::string& problem, const char* feedback, bool is_disturbed) {
  Selection loops =
      tables.rows("closed_loop", problem).where("stages", "1").where("feedback", feedback).where([&](const Row& row) {
        return (row.needed("draw") > 0.0) == is_disturbed;
      });
  require(!loops.empty(), "{} has no loops of {} that are {} and {}disturbed", loops_file, problem, feedback,
          is_disturbed ? "" : "un");
  return loops;
}

/// The rival's loop next to one of DMOC.
const Row& rival_of(const Row& dmoc, const Selection& loops, const Rivalry& rivalry) {
  const Selection same = loops.where("method", rivalry.method).matching(dmoc, {"draw"});
  const auto distance = [&](const Row& row) {
    return rivalry.has_equal_intervals ? std::abs(row.needed("intervals") - dmoc.needed("intervals"))
                                       : std::abs(std::log(quotient(row, dmoc, "variables")));
  };
  require(!same.empty(), "{} has no loop of {} by {}", loops_file, dmoc.text("problem"), rivalry.method);
  const Row& nearest = std::ranges::min_element(same, {}, distance)->get();
  require(distance(nearest) < 0.1, "{}: no loop of {} has the {} of N = {} by DMOC", loops_file, rivalry.name(),
          rivalry.has_equal_intervals ? "intervals" : "unknowns", dmoc.text("intervals"));
  return nearest;
}

/// "0.98 to 1.02": the range of numbers.
Words range_of_loops(const std::string& name, const std::vector<double>& numbers, const Rivalry& rivalry) {
  const auto [least, most] = std::ranges::minmax(numbers);
  return worded("{:.3g} to {:.3g}", Measurement{"least " + name, least, rivalry.method, rivalry.name()},
                Measurement{"largest " + name, most, rivalry.method, rivalry.name()});
}

Finding feedback_corrects(const ResultTables& tables, const std::string& problem) {
  const Selection closed = loops_of(tables, problem, "closed", false);
  const Selection open = loops_of(tables, problem, "open", false);
  std::vector<double> ratios;
  for (const Row& row : closed) {
    const Selection same = open.matching(row, {"method", "intervals"});
    require(same.size() == 1, "{} has no open loop next to {}", loops_file, row.place());
    ratios.push_back(quotient(row, same.front(), "final_distance"));
  }
  return found(std::ranges::max(ratios) < 1.0, "ratio of the final distances, closed to open, {} loops: {}",
               ratios.size(), range_of_loops("ratio of final distances, closed to open", ratios, {}));
}

Finding order_under_feedback(const ResultTables& tables, const std::string& problem) {
  const Selection closed = loops_of(tables, problem, "closed", false);
  const Selection open = loops_of(tables, problem, "open", false);
  std::vector<std::string> turned;
  std::vector<Words> words;
  for (const Rivalry& rivalry : rivalries) {
    std::vector<double> of_open;
    std::vector<double> of_closed;
    for (const Row& row : open.where("method", "dmoc")) {
      const Selection same = closed.where("method", "dmoc").matching(row, {"intervals"});
      require(same.size() == 1, "{} has no closed loop next to {}", loops_file, row.place());
      of_open.push_back(quotient(rival_of(row, open, rivalry), row, "final_distance"));
      of_closed.push_back(quotient(rival_of(same.front(), closed, rivalry), same.front(), "final_distance"));
      if ((of_open.back() > 1.0) == (of_closed.back() > 1.0)) continue;
      turned.push_back(fmt::format("{}, N = {}", rivalry.name(), row.text("intervals")));
    }
    require(!of_open.empty(), "{} has no loop of {} by dmoc", loops_file, problem);
    words.push_back(worded("{}: {} open, {} closed", rivalry.name(),
                           range_of_loops("ratio of final distances, open", of_open, rivalry),
                           range_of_loops("ratio of final distances, closed", of_closed, rivalry)));
  }
  return found(turned.empty(), "ratio of final distances to DMOC's: {}", joined(words, "; "))
      .also(turned.empty() ? Words() : worded("the order turns round: {}", fmt::join(turned, "; ")));
}

/// Loops of DMOC and a rival under the same disturbances.
using LoopPairs = std::vector<std::pair<std::reference_wrapper<const Row>, std::reference_wrapper<const Row>>>;

/// Those whose plans are all solved: failures of solvers decide nothing.
LoopPairs paired(const Selection& dmoc, const Selection& loops, const Rivalry& rivalry) {
  LoopPairs pairs;
  for (const Row& row : dmoc) {
    const Row& rival = rival_of(row, loops, rivalry);
    if (row.needed("failed") == 0.0 && rival.needed("failed") == 0.0) pairs.emplace_back(row, rival);
  }
  require(pairs.size() >= fewest_rounds, "{}: {} draws of {} are planned throughout", loops_file, pairs.size(),
          rivalry.name());
  return pairs;
}

/// The root mean square over draws of the difference between rivals, relative to the standard deviation of DMOC's.
double difference_over_spread(const LoopPairs& pairs, const char* column) {
  double square = 0.0;
  double sum = 0.0;
  double square_of_spread = 0.0;
  for (const auto& [dmoc, rival] : pairs) {
    square += std::pow(rival.get().needed(column) - dmoc.get().needed(column), 2);
    sum += dmoc.get().needed(column);
  }
  const double mean = sum / static_cast<double>(pairs.size());
  for (const auto& [dmoc, rival] : pairs) square_of_spread += std::pow(dmoc.get().needed(column) - mean, 2);
  return std::sqrt(square / square_of_spread);
}

double total(const Selection& loops, const char* column) {
  double sum = 0.0;
  for (const Row& row : loops) sum += row.needed(column);
  return sum;
}

Finding disturbances_exceed_differences(const ResultTables& tables, const std::string& problem) {
  const Selection loops = loops_of(tables, problem, "closed", true);
  double largest = 0.0;
  std::vector<Words> words;
  for (const Rivalry& rivalry : rivalries) {
    std::vector<double> distances;
    std::vector<double> costs;
    for (const Selection& dmoc : loops.where("method", "dmoc").group_by({"intervals"})) {
      const LoopPairs pairs = paired(dmoc, loops, rivalry);
      distances.push_back(difference_over_spread(pairs, "final_distance"));
      costs.push_back(difference_over_spread(pairs, "cost"));
      largest = std::max({largest, distances.back(), costs.back()});
    }
    require(!costs.empty(), "{} has no loop of {} by dmoc", loops_file, problem);
    words.push_back(worded("{}: {} of final distances, {} of costs", rivalry.name(),
                           range_of_loops("difference of final distances over spread", distances, rivalry),
                           range_of_loops("difference of costs over spread", costs, rivalry)));
  }
  return found(largest < 1.0, "difference of a method to DMOC over the standard deviation of draws: {}",
               joined(words, "; "))
      .also(worded("{:.0f} of {:.0f} plans were not solved; their loops are left out",
                   Measurement{"plans without a solution", total(loops, "failed")},
                   Measurement{"plans", total(loops, "plans")}));
}

Finding momentum_under_feedback(const ResultTables& tables, const std::string& problem) {
  const Selection loops = loops_of(tables, problem, "closed", true);
  const Selection undisturbed = loops_of(tables, problem, "closed", false);
  std::vector<Words> words;
  for (const Selection& dmoc : loops.where("method", "dmoc").group_by({"intervals"})) {
    std::vector<double> ratios;
    for (const auto& [row, rival] : paired(dmoc, loops, rivalries.front())) {
      ratios.push_back(quotient(rival, row, "momentum_miss"));
    }
    const RatioInterval of_draws = ratio_interval(ratios);
    const std::string at = "N = " + dmoc.front().text("intervals");
    const auto number = [&](const char* name, double value) { return Measurement{name, value, "tangent", at}; };
    words.push_back(worded("{} {:.4f} ({:.4f} to {:.4f})", at, number("ratio of misses", of_draws.ratio),
                           number("lower end", of_draws.lower), number("upper end", of_draws.upper)));
  }
  const auto largest = [](const char* name, const Selection& of, const char* column) {
    const Selection dmoc = of.where("method", "dmoc");
    const auto of_rival = [&](const Row& row) { return rival_of(row, of, rivalries.front()).needed(column); };
    return worded("{:.1e} with DMOC, {:.1e} with tangent-space collocation",
                  Measurement{name, dmoc.max(column), "dmoc"}, Measurement{name, dmoc.max(of_rival), "tangent"});
  };
  return found(ClaimVerdict::measured, "ratio of misses with disturbances: {}", joined(words, ", "))
      .also(worded("largest miss without: {}", largest("largest miss", undisturbed, "momentum_miss")))
      .also(worded("largest defect of momentum and forces in plans: {}",
                   largest("largest defect", loops, "momentum_defect")));
}

}  // namespace

/// Claims about plans at every sample on an exact plant.
Claims closed_loop_claims() {
  const char* const section = "section 4.2";
  const std::vector<std::string> evidence{loops_file, "figures/{}_closed_loop.svg"};
  return {
      {.id = "feedback_corrects_plans",
       .problems = of_loops,
       .where = section,
       .states = "without disturbances, plans at every sample end nearer to the final state than the first plan, "
                 "with every method on every grid",
       .judge = feedback_corrects,
       .condition = "16 samples, the last plan after three quarters of the horizon, plans of one stage. One grid on "
                    "which feedback ends farther away would refute it",
       .evidence = evidence},
      {.id = "order_under_feedback",
       .problems = of_loops,
       .where = section,
       .states = "without disturbances, the method whose first plan ends nearer to the final state ends nearer with "
                 "plans at every sample, too",
       .judge = order_under_feedback,
       .condition = "for equal intervals and, as nearly as grids permit, for equal unknowns; times decide nothing. "
                    "One grid on which the order turns round would refute it",
       .cause = "the last plan decides on the final distance, and its error has another constant than the error of the "
                "whole motion",
       .evidence = evidence},
      {.id = "disturbances_exceed_differences",
       .problems = of_loops,
       .where = section,
       .states = "with disturbances, plans at every sample by another method than DMOC change final distance and "
                 "cost less than other draws of the disturbances do",
       .judge = disturbances_exceed_differences,
       .condition = "forces on every coordinate, constant over a sample, up to a tenth of the mean rate that covers "
                    "the range of its momentum; all methods meet the same draws. A ratio of 1 or more would refute "
                    "it",
       .cause = "on coarse grids the plans themselves cost more than the disturbances do",
       .evidence = evidence},
      {.id = "momentum_under_feedback",
       .problems = of_loops_with_momentum,
       .where = "section 4.2, Consistent Momentum-Force",
       .states = "ratio of the distances by which the plant's momentum misses the plan's at the next sample, "
                 "tangent-space collocation to DMOC, with and without disturbances",
       .judge = momentum_under_feedback,
       .condition =
           "equal intervals; medians over draws with intervals of 99 %. Disturbances add their impulses to the "
           "misses, whatever the plan",
       .evidence = evidence,
       .has_verdict = false}};
}

}  // namespace dmocbench
