// "Numerically more expensive": whether collocation is so, and whether by its size or by the solver that is used.
#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claim_rows.hpp"
#include "bench/claims/predicates.hpp"

namespace dmocbench {

namespace {

/// What costs less than this times DMOC is not more expensive: the rows of the ends are within.
constexpr double more_expensive = 1.05;

constexpr const char* by_intervals = "intervals";
/// Hamiltonian rows combined without momenta are DMOC's rows (tests/transcription/combined_rows_test): eliminated in
/// this form, both methods take the same number of operations.
constexpr double of_combined_rows = 1.0;

/// Ratios of Hamiltonian collocation to DMOC on one grid.
Rows ratios_on(const ResultTables& tables, const std::string& problem, double intervals, const std::string& quantity) {
  Rows rows;
  const Rows all = midpoint_rows(tables.rows("structure_advantage_ratios", problem), "hamiltonian");
  for (const Row* row : rows_with(all, "quantity", quantity)) {
    if (row->number("intervals") == intervals && row->number("ratio_at_equal_intervals")) rows.push_back(row);
  }
  return rows;
}

double finest_grid(const Rows& rows) {
  double finest = 0.0;
  for (const Row* row : rows) finest = std::max(finest, row->number("intervals").value_or(0.0));
  return finest;
}

std::string name_of_way(const Row& row) { return row.text("solver") == "ipopt" ? "ipopt" : row.text("factorisation"); }

std::string listed(const Rows& rows) {
  std::vector<std::string> found;
  for (const Row* row : rows) {
    found.push_back(fmt::format("{} {:.2f}", name_of_way(*row), row->number("ratio_at_equal_intervals").value_or(0.0)));
  }
  return fmt::format("{}", fmt::join(found, ", "));
}

/// The smallest ratio.
double lowest(const Rows& rows) {
  double result = std::numeric_limits<double>::infinity();
  for (const Row* row : rows) result = std::min(result, row->number("ratio_at_equal_intervals").value_or(result));
  return result;
}

bool has(const Rows& rows, const char* factorisation) {
  return !rows_with(rows, "factorisation", factorisation).empty();
}

}  // namespace

Claim expense_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/collocation_more_expensive",
              .where = "rem:savings",
              .paper =
                  "twice as many state variables and (Ns + 1)n more constraints make collocation of Hamilton's "
                  "equations numerically more expensive",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const double intervals = finest_grid(tables.rows("structure_advantage_ratios", problem));
  const Rows systems = ratios_on(tables, problem, intervals, "seconds_per_linear_system");
  const Rows ipopt = rows_with(ratios_on(tables, problem, intervals, "seconds_per_iteration"), "solver", "ipopt");
  if (systems.empty() || ipopt.empty()) return claim;
  claim.measured = fmt::format("Hamiltonian to DMOC at N = {}, time per iteration: {}; time of a linear system: {}",
                               intervals, listed(ipopt), listed(systems));
  claim.verdict = verdict_of(std::min(lowest(systems), lowest(ipopt)) > more_expensive);
  return claim;
}

Claim factorisation_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/factorisation_more_expensive_by_any_solver",
              .where = "rem:savings",
              .paper = "more expensive by its size, as a property of the formulation and not of the solver",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const double intervals = finest_grid(tables.rows("structure_advantage_ratios", problem));
  const Rows eliminations = ratios_on(tables, problem, intervals, "elimination_operations");
  if (!has(eliminations, by_intervals)) return claim;
  claim.measured = fmt::format(
      "Hamiltonian to DMOC at N = {}, operations of an elimination: {}; {:.2f} after its rows are combined without "
      "momenta",
      intervals, listed(eliminations), of_combined_rows);
  claim.verdict = verdict_of(std::min(lowest(eliminations), of_combined_rows) > more_expensive);
  return claim;
}

}  // namespace dmocbench
