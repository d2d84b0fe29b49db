// Convergence of states, costates and controls (main_theorem) and the adjoint scheme behind it (th:orderapp), for every
// tableau against the indirect solution.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claim_rows.hpp"
#include "bench/claims/predicates.hpp"

namespace dmocbench {

namespace {

/// Residuals of the adjoint scheme, relative to the costates, that are rounding; and what only other coefficients
/// leave.
constexpr double rounding_of_costates = 1e-9;
constexpr double far_above_rounding = 1e-6;

double order_of(const Row& row) {
  const double s = row.number("stages").value_or(0.0);
  return row.text("tableau") == "gauss" ? 2.0 * s : 2.0 * s - 2.0;
}

bool is_structured(const Row& row) { return row.text("method") == "dmoc" || row.text("method") == "hamiltonian"; }

std::string tableau_of(const Row& row) { return row.text("tableau") + " " + row.text("stages"); }

/// Slopes of some quantities by tableau, DMOC's in words and those of both structured methods judged.
class Orders {
 public:
  Orders(const ResultTables& tables, const std::string& problem, const std::vector<std::string>& quantities) {
    for (const Row* row : tables.rows("convergence_indirect_slopes", problem)) {
      const bool wanted = std::find(quantities.begin(), quantities.end(), row->text("quantity")) != quantities.end();
      if (wanted && is_structured(*row)) add(*row);
    }
  }

  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] bool hold() const { return hold_; }
  [[nodiscard]] bool has_slopes() const { return slopes_ > 0; }
  /// "gauss 2 (order 4): state 4.02, costate floor; ...".
  [[nodiscard]] std::string text() const {
    std::vector<std::string> parts;
    for (const auto& [order, entries] : entries_) {
      for (const auto& [tableau, found] : entries) {
        parts.push_back(fmt::format("{} (order {:g}): {}", tableau, order, fmt::join(found, ", ")));
      }
    }
    return fmt::format("{}", fmt::join(parts, "; "));
  }

 private:
  void add(const Row& row) {
    const double order = order_of(row);
    const auto slope = row.number("slope");
    const bool is_slope = row.text("verdict") == "slope" && slope.has_value();
    if (is_slope) {
      ++slopes_;
      hold_ = hold_ && std::abs(*slope - order) < near_order;
    }
    if (row.text("method") != "dmoc") return;
    const std::string word = is_slope ? fmt::format("{:.2f}", *slope) : row.text("verdict");
    entries_[order][tableau_of(row)].push_back(row.text("quantity") + " " + word);
  }

  std::map<double, std::map<std::string, std::vector<std::string>>> entries_;
  bool hold_ = true;
  int slopes_ = 0;
};

ClaimVerdict verdict_of(const Orders& orders, bool holds) {
  if (!holds) return ClaimVerdict::differs;
  return orders.has_slopes() ? ClaimVerdict::reproduced : ClaimVerdict::floor;
}

}  // namespace

Claim convergence_order_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/order_of_convergence",
              .where = "main_theorem",
              .paper = "order kappa for state, costate and u(x, psi) at the nodes",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Orders orders(tables, problem, {"state", "momentum", "costate", "control_from_costate"});
  if (orders.empty()) return claim;
  claim.measured = "slopes of DMOC against the indirect solution: " + orders.text();
  claim.verdict = verdict_of(orders, orders.hold());
  return claim;
}

Claim adjoint_order_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/order_of_adjoint_scheme",
              .where = "th:orderapp, eq:stateco5-eq:stateco9",
              .paper = "the adjoint scheme is that of the states with both halves exchanged, and has its order",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  const Orders orders(tables, problem, {"costate"});
  Rows rows;
  for (const Row* row : tables.rows("equivalence", problem)) {
    if (is_structured(*row) && row->number("adjoint_residual")) rows.push_back(row);
  }
  if (rows.empty() || orders.empty()) return claim;
  const double residual = largest(rows, "adjoint_residual");
  double plain = std::numeric_limits<double>::infinity();
  for (const Row* row : rows_with(rows, "tableau", "lobatto")) {
    plain = std::min(plain, row->number("adjoint_residual_by_plain_coefficients").value_or(0.0));
  }
  claim.measured = fmt::format(
      "multipliers of {} solves, carried to costates, leave at most {:.1e} of the costates in it (Lobatto, halves not "
      "exchanged: at least {:.1e}); slopes of DMOC's costate: {}",
      rows.size(), residual, plain, orders.text());
  claim.verdict = verdict_of(orders, orders.hold() && residual < rounding_of_costates && plain > far_above_rounding);
  return claim;
}

Claim stage_control_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/order_of_stage_controls",
              .where = "remark behind main_theorem",
              .paper = "the estimate holds for u(x_k, psi_k), not for the controls u_k of the stages",
              .measured = "",
              .verdict = ClaimVerdict::not_yet};
  std::vector<std::string> found;
  bool holds = true;
  for (const Row* row : rows_with(tables.rows("convergence_indirect_slopes", problem), "quantity", "control")) {
    const auto slope = row->number("slope");
    const double stages = row->number("stages").value_or(0.0);
    const bool several = row->text("tableau") == "gauss" && stages > 1.0;
    if (row->text("method") != "dmoc" || !several || !slope || row->text("verdict") != "slope") continue;
    found.push_back(fmt::format("gauss {:g}: {:.2f}", stages, *slope));
    holds = holds && std::abs(*slope - (stages + 1.0)) < near_order;
  }
  if (found.empty()) return claim;
  claim.measured = fmt::format("slopes of DMOC's stage controls, s + 1 instead of 2s: {}", fmt::join(found, ", "));
  claim.verdict = verdict_of(holds);
  return claim;
}

}  // namespace dmocbench
