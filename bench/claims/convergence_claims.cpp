// "For all three methods the convergence rate ... is O(h^2)", and the reference grids of the paper.
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

constexpr double lowest_slope_of_order_two = 1.9;
constexpr double highest_slope_of_order_two = 2.1;
constexpr double fewest_points = 3;

}  // namespace

Claim slope_claim(const ResultTables& tables, const std::string& problem, const std::string& quantity,
                  const std::string& table) {
  const bool against_paper = table != "convergence_slopes";
  Claim claim{.id = fmt::format("{}/{}_slope{}", problem, quantity, against_paper ? "_against_512" : ""),
              .where = problem == orbit ? "fig:kepler_error" : "fig:twolink_error",
              .paper = against_paper ? "O(h^2) for all three methods, against N = 512" : "O(h^2) for all three methods",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  std::vector<std::string> found;
  bool holds = true;
  for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
    for (const Row* row : midpoint_rows(tables.rows(table, problem), method)) {
      if (row->text("quantity") != quantity) continue;
      const double slope = row->number("slope").value_or(0.0);
      found.push_back(fmt::format("{} {:.3f}", method, slope));
      holds = holds && slope > lowest_slope_of_order_two && slope < highest_slope_of_order_two &&
              row->number("points").value_or(0.0) >= fewest_points;
    }
  }
  if (found.empty()) return claim;
  claim.measured = fmt::format("slopes {}", fmt::join(found, ", "));
  if (against_paper) claim.measured += " (an error against N_ref is c(h^2 - h_ref^2): slopes come out too large)";
  claim.verdict = verdict_of(holds && found.size() == 3);
  return claim;
}

Claim step_claim(const ResultTables& tables, const std::string& problem) {
  const bool is_orbit = problem == orbit;
  const double printed = is_orbit ? 2.9e-3 : 1.9e-3;
  const double intervals = is_orbit ? 1024.0 : 512.0;
  constexpr double last_digit = 1e-4;
  Claim claim{.id = problem + "/reference_step",
              .where = is_orbit ? "section 4.2.1" : "section 4.2.2",
              .paper = is_orbit ? "h = 2.9e-3 at N = 1024" : "h = 1.9e-3 at N = 512",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Row* row = on_grid(midpoint_rows(tables.rows("convergence", problem), "dmoc"), intervals);
  if (row == nullptr) return claim;
  const double step = row->number("step").value_or(0.0);
  claim.measured = fmt::format("h = {:.4e} {}", step, is_orbit ? "h" : "s (1.9 if cut, 2.0 if rounded)");
  claim.verdict = verdict_of(std::abs(step - printed) < last_digit);
  return claim;
}

}  // namespace dmocbench
