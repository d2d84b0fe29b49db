// "Numerically more expensive": whether collocation is so by its size, or by the solver that is used.
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

/// What costs less than this times DMOC is not more expensive: boundary rows and what combining rows takes are within.
constexpr double more_expensive = 1.1;

constexpr const char* by_intervals = "intervals";
constexpr const char* recombined = "recombined";

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

}  // namespace

Claim advantage_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/collocation_more_expensive_by_any_solver",
              .where = "rem:savings",
              .paper =
                  "twice as many state variables and (Ns + 1)n more constraints make collocation of Hamilton's "
                  "equations numerically more expensive",
              .measured = "",
              .verdict = Verdict::not_yet};
  const double intervals = finest_grid(tables.rows("structure_advantage_ratios", problem));
  const Rows operations = ratios_on(tables, problem, intervals, "operations");
  const bool has_both = !rows_with(operations, "factorisation", by_intervals).empty() &&
                        !rows_with(operations, "factorisation", recombined).empty();
  if (!has_both) return claim;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Row* row : operations) {
    lowest = std::min(lowest, row->number("ratio_at_equal_intervals").value_or(lowest));
  }
  claim.measured =
      fmt::format("Hamiltonian to DMOC at N = {}, operations of a factorisation: {}", intervals, listed(operations));
  const Rows elimination =
      rows_with(ratios_on(tables, problem, intervals, "elimination_operations"), "factorisation", recombined);
  if (!elimination.empty()) {
    claim.measured += fmt::format(" (the elimination alone {:.2f})", largest(elimination, "ratio_at_equal_intervals"));
  }
  const Rows systems = ratios_on(tables, problem, intervals, "seconds_per_linear_system");
  if (!systems.empty()) claim.measured += fmt::format("; time of a linear system: {}", listed(systems));
  const Rows ipopt = rows_with(ratios_on(tables, problem, intervals, "seconds_per_iteration"), "solver", "ipopt");
  if (!ipopt.empty()) claim.measured += fmt::format("; time per iteration: {}", listed(ipopt));
  claim.measured += lowest > more_expensive ? "" : "; the rest is what a solver makes of it";
  claim.verdict = verdict_of(lowest > more_expensive);
  return claim;
}

}  // namespace dmocbench
