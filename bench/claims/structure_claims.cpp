// Momentum-force consistency "to numerical accuracy", and which methods have equal solutions.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claim_rows.hpp"
#include "bench/claims/predicates.hpp"
#include "bench/experiment/solve_case.hpp"

namespace dmocbench {

namespace {

/// Rounding of a momentum difference, relative to the work of the forces over one interval or absolute.
constexpr double rounding_of_balance = 1e-11;
/// Tangent-space collocation has to miss the balance by this factor on the coarsest grid to "fail to capture" it.
constexpr double clearly_larger = 1e3;

constexpr double equal_solutions_tolerance = 1e-9;
constexpr double equal_costates_tolerance = 1e-8;
constexpr double foreign_rows_tolerance = 1e-10;

}  // namespace

Claim consistency_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{
      .id = problem + "/momentum_consistency",
      .where = problem == orbit ? "fig:kepler_J" : "fig:twolink_obj b)",
      .paper =
          "change in momentum equals the forces to numerical accuracy for DMOC and Hamiltonian collocation, not "
          "for tangent-space collocation",
      .measured = "",
      .verdict = ClaimVerdict::not_yet};
  const Rows rows = tables.rows("consistency", problem);
  const Rows dmoc = midpoint_rows(rows, "dmoc");
  const Rows hamiltonian = midpoint_rows(rows, "hamiltonian");
  const Rows tangent = midpoint_rows(rows, "tangent");
  if (dmoc.empty() || hamiltonian.empty() || tangent.empty()) return claim;
  const auto relative_defect = [](const Rows& of_method) {
    double worst = 0.0;
    for (const Row* row : of_method) {
      const double defect = row->number("momentum_defect_max").value_or(std::numeric_limits<double>::infinity());
      worst = std::max(worst, defect / std::max(1.0, row->number("largest_force").value_or(1.0)));
    }
    return worst;
  };
  const double structured = std::max(relative_defect(dmoc), relative_defect(hamiltonian));
  const double defect_of_tangent = largest({tangent.front()}, "momentum_defect_max");
  const double defect_of_dmoc = largest({dmoc.front()}, "momentum_defect_max");
  const std::size_t unusable = count_unusable(dmoc) + count_unusable(hamiltonian) + count_unusable(tangent);
  claim.measured = fmt::format(
      "largest defect of an interval over all N: dmoc {:.1e}, hamiltonian {:.1e}; tangent {:.1e} at N = {} to {:.1e} "
      "at N = "
      "{}",
      largest(dmoc, "momentum_defect_max"), largest(hamiltonian, "momentum_defect_max"), defect_of_tangent,
      tangent.front()->text("intervals"), largest({tangent.back()}, "momentum_defect_max"),
      tangent.back()->text("intervals"));
  claim.verdict = verdict_of(unusable == 0 && structured < rounding_of_balance &&
                             defect_of_tangent > clearly_larger * std::max(defect_of_dmoc, rounding_of_balance * 1e-3));
  return claim;
}

Claim equality_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/equal_solutions",
              .where = "th:equi, equ_L_RK, ex:RK",
              .paper = "DMOC and Hamiltonian collocation by the same tableau have equal solutions",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Rows rows = rows_with(tables.rows("equivalence", problem), "method", "hamiltonian");
  if (rows.empty()) return claim;
  bool rows_agree = true;
  std::set<std::string> tableaus;
  for (const Row* row : rows) {
    const auto left = [&](const char* violation, const char* rounding) {
      const auto value = row->number(violation);
      return value && *value < std::max(foreign_rows_tolerance, row->number(rounding).value_or(0.0));
    };
    rows_agree = rows_agree && left("violation_in_rows_of_dmoc", "rounding_in_rows_of_dmoc") &&
                 left("violation_of_dmoc_here", "rounding_here");
    tableaus.insert(row->text("tableau") + row->text("stages"));
  }
  std::vector<std::string> found;
  double worst = 0.0;
  for (const auto& [column, symbol] :
       {std::pair{"configuration_difference", "q"}, std::pair{"momentum_difference", "p"},
        std::pair{"control_difference", "u"}, std::pair{"objective_difference", "J"}}) {
    const double difference = largest(rows, column);
    found.push_back(fmt::format("{} {:.0e}", symbol, difference));
    worst = std::max(worst, difference);
  }
  const double costates = largest(rows, "costate_difference");
  claim.measured = fmt::format(
      "{} grids with {} tableaus, largest relative difference: {}, costates {:.0e}; answers in the other's rows leave "
      "{}",
      rows.size(), tableaus.size(), fmt::join(found, ", "), costates, rows_agree ? "rounding" : "more than rounding");
  claim.verdict = verdict_of(worst < equal_solutions_tolerance && costates < equal_costates_tolerance && rows_agree &&
                             count_unusable(rows) == 0);
  return claim;
}

Claim difference_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{
      .id = problem + "/tangent_differs",
      .where = "section 4.2",
      .paper = "collocation on the tangent space is another discretisation: its solutions are not those of DMOC",
      .measured = "",
      .verdict = ClaimVerdict::not_yet};
  const Rows rows = midpoint_rows(tables.rows("equivalence", problem), "tangent");
  if (rows.size() < 2) return claim;
  const double coarse = largest({rows.front()}, "configuration_difference");
  const double fine = largest({rows.back()}, "configuration_difference");
  claim.measured = fmt::format("relative difference in q {:.1e} at N = {}, {:.1e} at N = {}", coarse,
                               rows.front()->text("intervals"), fine, rows.back()->text("intervals"));
  bool has_order = false;
  for (const Row* row : rows_with(tables.rows("equivalence_slopes", problem), "tableau", "gauss")) {
    if (row->text("verdict") != "slope") continue;
    const double slope = row->number("slope").value_or(0.0);
    claim.measured += fmt::format("{} s = {}: {:.2f}", has_order ? "," : "; slopes", row->text("stages"), slope);
    has_order = true;
    if (!(std::abs(slope - 2.0 * row->number("stages").value_or(0.0)) < near_order)) {
      claim.verdict = ClaimVerdict::differs;
      return claim;
    }
  }
  claim.verdict =
      verdict_of(has_order && fine > equal_solutions_tolerance / 10.0 &&
                 coarse > clearly_larger * equal_solutions_tolerance && fine < coarse && count_unusable(rows) == 0);
  return claim;
}

Claim coincidence_claim(const ResultTables& tables) {
  Claim claim{.id = std::string(oscillator) + "/tangent_coincides",
              .where = "section 4.2, ex:RK",
              .paper = "where L_vv is constant, collocation on the tangent space by Gauss is Hamiltonian collocation",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Rows rows =
      rows_with(rows_with(tables.rows("equivalence", oscillator), "method", "tangent"), "tableau", "gauss");
  if (rows.empty()) return claim;
  double worst = 0.0;
  for (const char* column :
       {"configuration_difference", "momentum_difference", "control_difference", "objective_difference"}) {
    worst = std::max(worst, largest(rows, column));
  }
  claim.measured = fmt::format("largest relative difference from DMOC on {} grids: {:.0e}, costates {:.0e}",
                               rows.size(), worst, largest(rows, "costate_difference"));
  claim.verdict =
      verdict_of(worst < equal_solutions_tolerance && largest(rows, "costate_difference") < equal_costates_tolerance &&
                 count_unusable(rows) == 0);
  return claim;
}

}  // namespace dmocbench
