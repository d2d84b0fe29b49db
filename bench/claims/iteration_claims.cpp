// Minor iterations of the SQP method: "for DMOC the SQP solver needs about 1.7 (1.5) times less iterations".
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "bench/claims/claim_rows.hpp"
#include "bench/claims/predicates.hpp"
#include "bench/experiment/solve_case.hpp"

namespace dmocbench {

namespace {

/// What the ratio may be for "about 1.7" and "about 1.5", and from which grid on (ends of the motion weigh less there).
struct Stated {
  double lowest;
  double highest;
  double coarsest;
  const char* words;
  const char* where;
};

Stated stated_for(const std::string& problem) {
  return problem == orbit ? Stated{1.6, 1.7, 32.0, "about 1.7 times fewer minor iterations", "fig:kepler_iterations"}
                          : Stated{1.4, 1.55, 64.0, "about 1.5 times fewer minor iterations", "fig:twolink_iterations"};
}

/// Rows of one method by the SQP method from one kind of start.
Rows counted(const ResultTables& tables, const std::string& problem, const std::string& method, const char* crash) {
  const Rows rows = rows_with(tables.rows("iterations", problem), "solver", "sqp");
  return midpoint_rows(rows_with(rows, "crash", crash), method);
}

/// Ratios of collocation to DMOC on all grids from `coarsest` on.
struct Ratios {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = 0.0;
  double finest_grid = 0.0;
  int grids = 0;
  int unusable = 0;  ///< rows that are missing, not solved or on another branch

  [[nodiscard]] bool lie_between(double low, double high) const {
    return grids > 1 && unusable == 0 && lowest >= low && highest <= high;
  }
};

Ratios ratios_of(const ResultTables& tables, const std::string& problem, const char* crash, const std::string& column,
                 double coarsest) {
  Ratios ratios;
  for (const Row* row : counted(tables, problem, "dmoc", crash)) {
    const double intervals = row->number("intervals").value_or(0.0);
    if (intervals < coarsest) continue;
    ++ratios.grids;
    ratios.finest_grid = std::max(ratios.finest_grid, intervals);
    for (const char* method : {"hamiltonian", "tangent"}) {
      const Row* other = on_grid(counted(tables, problem, method, crash), intervals);
      const auto of_dmoc = row->number(column);
      if (!is_usable(*row) || other == nullptr || !of_dmoc || !other->number(column)) {
        ++ratios.unusable;
        continue;
      }
      ratios.lowest = std::min(ratios.lowest, *other->number(column) / *of_dmoc);
      ratios.highest = std::max(ratios.highest, *other->number(column) / *of_dmoc);
    }
  }
  return ratios;
}

std::string described(const Ratios& ratios, double coarsest) {
  return fmt::format("{:.3f} to {:.3f} on {} grids, N = {} to {}", ratios.lowest, ratios.highest, ratios.grids,
                     coarsest, ratios.finest_grid);
}

}  // namespace

Claim minor_iterations_claim(const ResultTables& tables, const std::string& problem) {
  const Stated stated = stated_for(problem);
  Claim claim{.id = problem + "/minor_iteration_ratio",
              .where = stated.where,
              .paper = fmt::format("DMOC needs {}", stated.words),
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Ratios ratios = ratios_of(tables, problem, "none", "minor_iterations", stated.coarsest);
  if (ratios.grids == 0) return claim;
  claim.measured = fmt::format("from the slack basis, collocation to DMOC {}", described(ratios, stated.coarsest));
  claim.verdict = verdict_of(ratios.lie_between(stated.lowest, stated.highest));
  return claim;
}

Claim agreement_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/minor_iterations_equal_variable_ratio",
              .where = problem == orbit ? "section 4.2.1" : "section 4.2.2",
              .paper = problem == orbit ? "in exact agreement with the reduced number of variables"
                                        : "this factor reflects that DMOC uses 2/3 of the variables",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  int rows = 0;
  int exact = 0;
  for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
    for (const Row* row : counted(tables, problem, method, "none")) {
      if (!is_usable(*row)) continue;
      ++rows;
      exact += row->number("minor_iterations") == row->number("predicted_minors") ? 1 : 0;
    }
  }
  if (rows == 0) return claim;
  const Ratios minors = ratios_of(tables, problem, "none", "minor_iterations", stated_for(problem).coarsest);
  const Ratios variables = ratios_of(tables, problem, "none", "free_variables", stated_for(problem).coarsest);
  claim.measured =
      fmt::format("minor iterations = free variables + major iterations - 1 in {} of {} rows; free variables {}", exact,
                  rows, described(variables, stated_for(problem).coarsest));
  constexpr double close = 0.05;
  claim.verdict =
      verdict_of(exact == rows && minors.unusable == 0 && std::abs(minors.lowest / variables.lowest - 1.0) < close &&
                 std::abs(minors.highest / variables.highest - 1.0) < close);
  return claim;
}

Claim crash_claim(const ResultTables& tables, const std::string& problem) {
  const Stated stated = stated_for(problem);
  Claim claim{.id = problem + "/minor_iteration_ratio_from_a_crash_basis",
              .where = stated.where,
              .paper = fmt::format("{}, as a property of DMOC and not of how the solver starts", stated.words),
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Ratios ratios = ratios_of(tables, problem, "basis", "minor_iterations", stated.coarsest);
  if (ratios.grids == 0) return claim;
  claim.measured =
      fmt::format("with the first basis chosen for free {}: the saving lies in phase 1 from the slack basis",
                  described(ratios, stated.coarsest));
  claim.verdict = verdict_of(ratios.lie_between(stated.lowest, stated.highest));
  return claim;
}

}  // namespace dmocbench
