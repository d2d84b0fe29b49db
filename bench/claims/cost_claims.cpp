// "DMOC only uses 3/5 (2/3) of the number of variables", and the optimal cost over N.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claim_rows.hpp"
#include "bench/claims/predicates.hpp"
#include "bench/experiment/solve_case.hpp"

namespace dmocbench {

namespace {

/// Boundary values make the ratio of a finite grid differ from the limit by a few over N.
constexpr double nodes_at_the_ends = 4.0;

constexpr double equally_well = 2.0;

constexpr double identical_costs = 1e-9;

}  // namespace

Claim variable_claim(const ResultTables& tables, const std::string& problem) {
  const double stated = problem == orbit ? 3.0 / 5.0 : 2.0 / 3.0;
  Claim claim{
      .id = problem + "/variable_ratio",
      .where = problem == orbit ? "section 4.2.1, rem:savings" : "section 4.2.2, rem:savings",
      .paper = problem == orbit ? "DMOC uses 3/5 of the variables of collocation" : "DMOC uses 2/3 of the variables",
      .measured = "",
      .verdict = ClaimVerdict::not_yet};
  const Rows rows = tables.rows("convergence", problem);
  const Rows dmoc = midpoint_rows(rows, "dmoc");
  if (dmoc.empty()) return claim;
  const Row& finest = *dmoc.back();
  const double intervals = finest.number("intervals").value_or(0.0);
  bool holds = true;
  std::vector<std::string> found;
  for (const char* method : {"hamiltonian", "tangent"}) {
    const Row* other = on_grid(midpoint_rows(rows, method), intervals);
    if (other == nullptr) return claim;
    const double ratio = finest.number("free_variables").value_or(0.0) / other->number("free_variables").value_or(0.0);
    found.push_back(fmt::format("{:.4f} of {}", ratio, method));
    holds = holds && std::abs(ratio - stated) < nodes_at_the_ends / intervals;
  }
  claim.measured = fmt::format("free variables at N = {}: {}", intervals, fmt::join(found, ", "));
  claim.verdict = verdict_of(holds);
  return claim;
}

Claim objective_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/objective_evolution",
              .where = problem == orbit ? "(not shown in the paper)" : "fig:twolink_obj a)",
              .paper = "DMOC and Hamiltonian have identical cost; tangent-space collocation performs equally well",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Rows rows = tables.rows("objective", problem);
  const Rows dmoc = midpoint_rows(rows, "dmoc");
  if (dmoc.size() < 2) return claim;
  const double limit = dmoc.back()->number("objective").value_or(0.0);
  double identical = 0.0;
  double worst_ratio = 0.0;
  for (const Row* row : dmoc) {
    const double intervals = row->number("intervals").value_or(0.0);
    const Row* hamiltonian = on_grid(midpoint_rows(rows, "hamiltonian"), intervals);
    const Row* tangent = on_grid(midpoint_rows(rows, "tangent"), intervals);
    if (hamiltonian == nullptr || tangent == nullptr || !is_usable(*row)) {
      claim.measured = fmt::format("not all methods are solved on the same branch at N = {}", intervals);
      claim.verdict = ClaimVerdict::differs;
      return claim;
    }
    const double of_dmoc = row->number("objective").value_or(0.0);
    identical = std::max(identical, std::abs(hamiltonian->number("objective").value_or(0.0) / of_dmoc - 1.0));
    const double error = std::abs(of_dmoc - limit);
    const double error_of_tangent = std::abs(tangent->number("objective").value_or(0.0) - limit);
    const double scale = std::max(error, 1e-6 * std::abs(limit));
    worst_ratio = std::max(worst_ratio, error_of_tangent / scale);
  }
  claim.measured = fmt::format(
      "J of dmoc and hamiltonian differ by {:.0e} relative; error of tangent at most {:.2f} times that of dmoc",
      identical, worst_ratio);
  claim.verdict = verdict_of(identical < identical_costs && worst_ratio < equally_well);
  return claim;
}

}  // namespace dmocbench
