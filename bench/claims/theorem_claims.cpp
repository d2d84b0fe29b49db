// The paper's theorems: order of consistency (th:ordercalculation), momentum and energy of the discrete flow.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claim_rows.hpp"
#include "bench/claims/predicates.hpp"

namespace dmocbench {

namespace {

/// With four stages errors reach the rounding of double coefficients before they are asymptotic.
constexpr double most_stages = 3;
/// Largest momentum defects of 400 steps that are rounding, in double and in long double.
constexpr double rounding_in_double = 1e-11;
constexpr double rounding_in_long_double = 1e-14;

double number_or_infinity(const Row& row, const char* column) {
  return row.number(column).value_or(std::numeric_limits<double>::infinity());
}

}  // namespace

Claim consistency_order_claim(const ResultTables& tables, const std::string& problem, const ConsistencyClaim& what) {
  Claim claim{.id = problem + "/" + what.id,
              .where = what.where,
              .paper = what.paper,
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  std::vector<std::string> found;
  bool holds = true;
  for (const std::string& quantity : what.quantities) {
    for (const Row* row : rows_with(tables.rows("consistency_order_slopes", problem), "quantity", quantity)) {
      if (row->text("tableau") != "gauss" || row->number("stages").value_or(0.0) > most_stages) continue;
      const double order = row->number("order").value_or(0.0);
      const double slope = row->number("slope").value_or(std::numeric_limits<double>::quiet_NaN());
      found.push_back(fmt::format("{} {:.2f} (r = {:g})", quantity, slope, order));
      holds = holds && std::abs(slope - (order + 1.0)) < near_order;
    }
  }
  if (found.empty()) return claim;
  claim.measured = fmt::format("slopes over h by Gauss: {}", fmt::join(found, ", "));
  claim.verdict = verdict_of(holds);
  return claim;
}

Claim noether_claim(const ResultTables& tables, const char* force) {
  const bool orthogonal = force == std::string("orthogonal");
  Claim claim{.id = std::string(orbit) + (orthogonal ? "/momentum_preserved" : "/forced_noether_theorem"),
              .where = orthogonal ? "th:discforcNoe" : "eq:noether_force_d",
              .paper = orthogonal ? "a force orthogonal to the group action preserves the momentum"
                                  : "the momentum changes by the work of the discrete forces along the group action",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Rows rows = rows_with(rows_with(tables.rows("structure_momentum"), "force", force), "method", "dmoc");
  if (rows.empty()) return claim;
  const double defect = largest(rows, "defect");
  const double in_long_double = largest(rows, "defect_in_long_double");
  claim.measured =
      fmt::format("{} simulations of 400 steps with arbitrary controls: largest defect {:.1e}, in long double {:.1e}",
                  rows.size(), defect, in_long_double);
  claim.verdict = verdict_of(defect < rounding_in_double && in_long_double < rounding_in_long_double);
  return claim;
}

Claim symplecticity_claim(const ResultTables& tables) {
  Claim claim{.id = std::string(orbit) + "/symplectic",
              .where = "section 2.2, equ_L_RK",
              .paper = "the unforced discrete flow is symplectic",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Rows rows = tables.rows("structure_symplecticity");
  if (rows.empty()) return claim;
  constexpr double within_rounding = 100.0;
  double structured = 0.0;
  double tangent = 0.0;
  for (const Row* row : rows) {
    const double defect = number_or_infinity(*row, "defect") / number_or_infinity(*row, "rounding");
    double& worst = row->text("method") == "tangent" ? tangent : structured;
    worst = std::max(worst, defect);
  }
  claim.measured =
      fmt::format("D'ΩD - Ω in units of rounding: DMOC and Hamiltonian at most {:.1f}, tangent-space up to {:.1e}",
                  structured, tangent);
  claim.verdict = verdict_of(structured < within_rounding && tangent > within_rounding);
  return claim;
}

Claim modified_energy_claim(const ResultTables& tables) {
  Claim claim{.id = std::string(orbit) + "/modified_energy",
              .where = "section 2.2",
              .paper = "energy oscillates but does not drift",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Rows rows = rows_with(tables.rows("structure_energy_behaviour"), "periods", "10000");
  if (rows.empty()) return claim;
  constexpr double bounded = 1.05;
  constexpr double drifts = 10.0;
  bool holds = true;
  std::vector<std::string> found;
  for (const Row* row : rows) {
    const double oscillation = number_or_infinity(*row, "oscillation");
    const double range = number_or_infinity(*row, "range");
    const double change = std::abs(number_or_infinity(*row, "change"));
    const bool variational = row->text("method") == "dmoc";
    holds = holds && (variational ? range < bounded * oscillation : change > drifts * oscillation);
    found.push_back(fmt::format("{} of order {}: oscillation {:.1e}, change {:.1e}", row->text("method"),
                                row->text("order"), oscillation, change));
  }
  claim.measured = fmt::format("eccentric Kepler orbit over 10000 periods: {}", fmt::join(found, "; "));
  claim.verdict = verdict_of(holds && rows.size() >= 3);
  return claim;
}

}  // namespace dmocbench
