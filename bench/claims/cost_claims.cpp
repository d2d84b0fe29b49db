// The savings of DMOC: variables and constraints ("needs less discrete variables and less constraints"), time
// ("numerically more expensive"), and how much remains when the methods are equally accurate.
#include <functional>
#include <limits>

#include "bench/claims/timed_ratios.hpp"
#include "bench/run/solve_case.hpp"

namespace dmocbench {

namespace {

/// A method that costs as much as DMOC is not more expensive.
constexpr double more_expensive = 1.0;

/// Hamiltonian collocation to DMOC by one quantity.
Selection hamiltonian_ratios(const ResultTables& tables, const std::string& problem, const std::string& quantity) {
  Selection ratios =
      midpoint(tables.rows("savings_by_solver_ratios", problem), "hamiltonian").where("quantity", quantity);
  require(!ratios.empty(), "savings_by_solver_ratios.csv has no {} of {} by hamiltonian", quantity, problem);
  return ratios;
}

/// Those on the finest grid of the table.
Selection on_finest_grid(const Selection& ratios) {
  return ratios.where("intervals", ratios.sorted_by("intervals").back().text("intervals"));
}

std::string way_of(const Row& row) { return row.text(row.text("solver") == "ipopt" ? "solver" : "factorisation"); }

std::vector<double> rounds_of(const Row& row) {
  std::vector<double> of_rounds = row.numbers("round_ratios");
  require(!of_rounds.empty(), "{}, column round_ratios: the field contains no number", row.place());
  return of_rounds;
}

/// Hamiltonian collocation to DMOC, a ratio per way to solve: of an iteration by Ipopt, of a linear system by the
/// others.
using ExpenseByWay = std::function<void(TimedRatios&, const Selection&)>;

Predicate more_expensive_by(const ExpenseByWay& add_ratios) {
  return [=](const ResultTables& tables, const std::string& problem) -> Finding {
    const Selection ipopt = hamiltonian_ratios(tables, problem, "seconds_per_iteration").where("solver", "ipopt");
    require(!ipopt.empty(), "savings_by_solver_ratios.csv has no seconds_per_iteration of {} by ipopt", problem);
    TimedRatios ratios(more_expensive);
    add_ratios(ratios, ipopt);
    add_ratios(ratios, hamiltonian_ratios(tables, problem, "seconds_per_linear_system"));
    return found_by_times(ratios,
                          "ratio of the times of Hamiltonian collocation to DMOC, for an iteration of ipopt and a "
                          "linear system of interior_point: ");
  };
}

void add_finest_grid(TimedRatios& ratios, const Selection& rows) {
  for (const Row& row : on_finest_grid(rows))
    ratios.add(fmt::format("{} N = {}", way_of(row), row.text("intervals")), rounds_of(row));
}

/// Entries of the factor of the KKT matrix, which every iteration of a solver that factorises it computes: a count, so
/// that no clock decides.
Finding more_entries_of_factors(const ResultTables& tables, const std::string& problem) {
  const Selection ratios = midpoint(tables.rows("iterations_common_ratios", problem), "hamiltonian");
  const auto of = [&](const char* currency) {
    const Selection rows = ratios.where("currency", currency);
    require(!rows.empty(), "iterations_common_ratios.csv has no {} of {} by hamiltonian", currency, problem);
    return rows;
  };
  const Selection factors = of("factor_nonzeros");
  const auto range = [](const Selection& rows) {
    const std::string name = rows.front().text("currency") + " over DMOC's";
    return worded("{:.2f} to {:.2f}", Measurement{"least " + name, rows.min("ratio_at_equal_intervals"), "hamiltonian"},
                  Measurement{"largest " + name, rows.max("ratio_at_equal_intervals"), "hamiltonian"});
  };
  return found(verdict_on_interval(factors.min("ratio_at_equal_intervals"), factors.max("ratio_at_equal_intervals"),
                                   more_expensive, std::numeric_limits<double>::infinity()),
               "ratio of Hamiltonian collocation to DMOC on {} grids in entries of the factor of the KKT matrix: {}",
               factors.distinct("intervals").size(), range(factors))
      .also(worded("ratio in entries of the matrix: {}", range(of("kkt_nonzeros"))));
}

/// The grids coarser than the finest one together, for each way separately: the smallest program alone takes less time
/// than the variation between runs.
void add_coarse_grids(TimedRatios& ratios, const Selection& rows) {
  const std::string finest = rows.sorted_by("intervals").back().text("intervals");
  const Selection coarse = rows.where([&](const Row& row) { return row.text("intervals") != finest; });
  require(!coarse.empty(), "savings_by_solver_ratios.csv has only N = {}; a coarser grid is needed", finest);
  for (const Selection& way : coarse.group_by({"solver", "factorisation"})) {
    std::vector<std::vector<double>> of_grids;
    for (const Row& row : way) of_grids.push_back(rounds_of(row));
    ratios.add(fmt::format("{} N = {}", way_of(way.front()), fmt::join(way.distinct("intervals"), " and ")),
               means_of_rounds(of_grids));
  }
}

/// The counts of (rem:savings) for n configurations and s stages; for DMOC without the 2n conditions at the ends.
Finding counts_of_remark(const ResultTables& tables, const std::string& problem) {
  const double n = 2.0;
  const double m = problem == orbit ? 1.0 : 2.0;
  const Selection rows =
      tables.rows("convergence_stages", problem).where([](const Row& row) { return row.text("method") != "tangent"; });
  const auto is_as_stated = [&](const Row& row) {
    const double sN = row.needed("stages") * row.needed("intervals");
    const bool is_dmoc = row.text("method") == "dmoc";
    const double states = row.needed("variables") - sN * m;
    const double constraints = row.needed("constraints") - (is_dmoc ? 2.0 * n : 0.0);
    return states == (is_dmoc ? 1.0 : 2.0) * (sN + 1.0) * n && constraints == (is_dmoc ? (sN - 1.0) * n : 2.0 * n * sN);
  };
  const Selection as_stated = rows.where(is_as_stated);
  require(rows.group_by({"stages"}).size() > 1 && rows.group_by({"method"}).size() == 2,
          "convergence_stages.csv needs rows of {} by dmoc and hamiltonian with several numbers of stages", problem);
  return found(as_stated.size() == rows.size(),
               "(Ns + 1)n positions and (Ns - 1)n equations for DMOC, 2(Ns + 1)n and 2nNs for Hamiltonian collocation, "
               "in {} of {} programs with {} stages",
               as_stated.size(), rows.size(), fmt::join(rows.distinct("stages"), ", "));
}

/// Free variables of collocation to DMOC's where an error is the same.
Predicate saves_at_equal(const char* quantity) {
  return [=](const ResultTables& tables, const std::string& problem) -> Finding {
    const Selection rows = tables.rows("convergence_equal_accuracy", problem).where("quantity", quantity);
    std::vector<Words> words;
    double smallest = std::numeric_limits<double>::infinity();
    for (const char* method : {"hamiltonian", "tangent"}) {
      const Selection of_method = midpoint(rows, method);
      require(!of_method.empty(), "convergence_equal_accuracy.csv has no {} error of {} that {} and dmoc both reach",
              quantity, problem, method);
      const double least = of_method.min("variables_ratio");
      const std::string at = fmt::format("equal {} error", quantity);
      words.push_back(
          worded("{} {:.2f} to {:.2f}", method, Measurement{"least ratio of free variables", least, method, at},
                 Measurement{"largest ratio of free variables", of_method.max("variables_ratio"), method, at}));
      smallest = std::min(smallest, least);
    }
    return found(smallest > more_expensive, "free variables of collocation divided by DMOC's at equal {} error: {}",
                 quantity, joined(words, ", "));
  };
}

/// Iterations and time of whole solves of collocation to DMOC's, where the errors are the same.
Finding whole_solves(const ResultTables& tables, const std::string& problem) {
  std::vector<Words> words;
  const auto append = [&](const Selection& rows, const std::string& name) {
    for (const char* method : {"hamiltonian", "tangent"}) {
      const Selection ratios = midpoint(rows, method).with_number("ratio_at_equal_accuracy");
      if (ratios.empty()) continue;
      words.push_back(worded("{} of {} {:.2f} to {:.2f} on {} grids", name, method,
                             Measurement{"least ratio of " + name, ratios.min("ratio_at_equal_accuracy"), method},
                             Measurement{"largest ratio of " + name, ratios.max("ratio_at_equal_accuracy"), method},
                             ratios.size()));
    }
  };
  const Selection counts = tables.rows("iterations_common_ratios", problem);
  append(counts.where("currency", "ipopt_iterations"), "iterations by ipopt");
  append(counts.where("currency", "sqp_major_iterations"), "major iterations by sqp");
  const Selection times = tables.rows("savings_by_solver_ratios", problem).where("quantity", "seconds");
  for (const Selection& way : times.group_by({"solver", "factorisation"}))
    append(way, fmt::format("seconds by {}", way_of(way.front())));
  require(!words.empty(),
          "iterations_common_ratios.csv and savings_by_solver_ratios.csv have no ratio of {} at equal "
          "accuracy",
          problem);
  return found(ClaimVerdict::measured, "ratio of collocation to DMOC: {}", joined(words, ", "));
}

}  // namespace

/// Variables, operations, time, also at equal accuracy.
Claims cost_claims() {
  const std::vector<std::string> advantage{"savings_by_solver_ratios.csv", "figures/{}_savings_by_solver.svg"};
  const std::vector<std::string> accuracy{"convergence_equal_accuracy.csv", "figures/{}_work_precision.svg"};
  const char* const warm = "times are measured for warm solves from the common start";
  return {
      {.id = "counts_of_variables_and_constraints",
       .where = "section 3.4, rem:savings",
       .whose = Whose::paper,
       .states = "collocation of Hamilton's equations has twice as many state variables and (Ns + 1)n more constraints",
       .judge = counts_of_remark,
       .condition = "DMOC's constraints are counted without the 2n boundary conditions, as in the paper",
       .evidence = {"convergence_stages.csv"},
       .by_counting = true},
      {.id = "collocation_more_expensive",
       .where = "section 3.4, rem:savings",
       .whose = Whose::paper,
       .states = "because of its size, collocation of Hamilton's equations is numerically more expensive",
       .judge = more_entries_of_factors,
       .condition = "the paper does not state how expense is measured; here it is the number of entries of a sparse "
                    "factor (approximate minimum degree), which the times follow (`collocation_takes_longer`)",
       .evidence = {"iterations_common_ratios.csv", "iterations_common.csv"},
       .by_counting = true},
      {.id = "collocation_takes_longer",
       .where = "section 3.4, rem:savings",
       .states = "on the finest grid, an iteration and a linear system take longer with collocation of Hamilton's "
                 "equations than with DMOC",
       .judge = more_expensive_by(add_finest_grid),
       .condition = warm,
       .evidence = advantage},
      {.id = "collocation_more_expensive_on_coarse_grids",
       .where = "section 3.4, rem:savings",
       .states = "collocation of Hamilton's equations is more expensive on coarse grids too",
       .judge = more_expensive_by(add_coarse_grids),
       .condition = "times are measured for warm solves from the common start; geometric mean over the coarse grids",
       .evidence = advantage},
      {.id = "whole_solves_at_equal_accuracy",
       .where = "section 4.2",
       .states = "ratio of collocation to DMOC in iterations and in the time of whole solves, at equal accuracy",
       .judge = whole_solves,
       .condition = "solves are warm, from the common start; iterations are compared at equal replay errors, times at "
                    "equal errors of the cost",
       .evidence = {"iterations_common_ratios.csv", "savings_by_solver_ratios.csv"},
       .has_verdict = false},
      {.id = "savings_at_equal_state_error",
       .where = "section 5",
       .states = "DMOC saves variables at equal state error",
       .judge = saves_at_equal("state"),
       .condition = "errors are measured against the method's own solution with N = 1024",
       .evidence = accuracy},
      {.id = "savings_at_equal_replay_error",
       .where = "section 5",
       .states = "DMOC saves variables at equal replay error",
       .judge = saves_at_equal("replay"),
       .condition = "a replay integrates the continuous equations with the computed controls",
       .evidence = accuracy},
  };
}

}  // namespace dmocbench
