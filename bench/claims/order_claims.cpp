// Convergence of states, costates and controls (main_theorem) and the adjoint scheme behind it (th:orderapp), for every
// tableau against the indirect solution.
#include <cmath>
#include <map>
#include <utility>

#include "bench/claims/claim.hpp"

namespace dmocbench {

namespace {

/// Residuals of the adjoint scheme, relative to the costates: the most that is rounding, and the least that
/// coefficients not exchanged have to leave.
constexpr double rounding_of_costates = 1e-9;
constexpr double far_above_rounding = 1e-6;

bool is_structured(const Row& row) { return row.text("method") == "dmoc" || row.text("method") == "hamiltonian"; }

std::optional<double> fitted_order(const Row& row) {
  return row.text("verdict") == "slope" ? row.number("slope") : std::nullopt;
}

double expected_order(const Row& row) {
  const double s = row.number("stages", 0.0);
  return row.text("tableau") == "gauss" ? 2.0 * s : 2.0 * s - 2.0;
}

/// Fitted orders of both structured methods.
Selection orders_of(const ResultTables& tables, const std::string& problem,
                    const std::vector<std::string>& quantities) {
  return tables.rows("convergence_indirect_slopes", problem).where([&](const Row& row) {
    return is_structured(row) && std::ranges::find(quantities, row.text("quantity")) != quantities.end();
  });
}

/// DMOC's orders by tableau: "gauss 2 (order 4): state 4.02, costate floor; ...".
std::string in_words(const Selection& orders) {
  std::map<std::pair<double, std::string>, Selection> tableaus;
  for (const Row& row : orders.where("method", "dmoc")) {
    tableaus[{expected_order(row), row.text("tableau") + " " + row.text("stages")}].append(row);
  }
  std::string words;
  for (const auto& [tableau, rows] : tableaus) {
    words += fmt::format("{}{} (order {:g}): ", words.empty() ? "" : "; ", tableau.second, tableau.first);
    words += rows.in_words(", ", [](const Row& row) {
      const auto order = fitted_order(row);
      return row.text("quantity") + " " + (order ? fmt::format("{:.2f}", *order) : row.text("verdict"));
    });
  }
  return words;
}

/// Whether orders are as expected, if other things hold too; `floor` if no order could be fitted.
ClaimVerdict verdict_on_orders(const Selection& orders, bool others_hold = true) {
  const Selection fitted = orders.where([](const Row& row) { return fitted_order(row).has_value(); });
  const auto is_expected = [](const Row& row) { return has_order(row, expected_order(row)); };
  if (!others_hold || !std::ranges::all_of(fitted, is_expected)) return ClaimVerdict::differs;
  return fitted.empty() ? ClaimVerdict::floor : ClaimVerdict::reproduced;
}

std::optional<Finding> order_of_convergence(const ResultTables& tables, const std::string& problem) {
  const Selection orders = orders_of(tables, problem, {"state", "momentum", "costate", "control_from_costate"});
  if (orders.empty()) return std::nullopt;
  return found(verdict_on_orders(orders), "slopes of DMOC against the indirect solution: {}", in_words(orders));
}

std::optional<Finding> order_of_adjoint_scheme(const ResultTables& tables, const std::string& problem) {
  const Selection orders = orders_of(tables, problem, {"costate"});
  const Selection solves = tables.rows("equivalence", problem).where(is_structured).with_number("adjoint_residual");
  if (solves.empty() || orders.empty()) return std::nullopt;
  const double residual = solves.max("adjoint_residual");
  const double plain = solves.where("tableau", "lobatto").min("adjoint_residual_by_plain_coefficients");
  return found(verdict_on_orders(orders, residual < rounding_of_costates && plain > far_above_rounding),
               "multipliers of {} solves, carried to costates, leave at most {:.1e} of the costates in it (Lobatto, "
               "halves not exchanged: at least {:.1e}); slopes of DMOC's costate: {}",
               solves.size(), residual, plain, in_words(orders));
}

std::optional<Finding> order_of_stage_controls(const ResultTables& tables, const std::string& problem) {
  const Selection orders = orders_of(tables, problem, {"control"}).where([](const Row& row) {
    return row.text("method") == "dmoc" && row.text("tableau") == "gauss" && row.number("stages", 0.0) > 1.0 &&
           fitted_order(row);
  });
  if (orders.empty()) return std::nullopt;
  const auto is_lower = [](const Row& row) { return has_order(row, row.number("stages", 0.0) + 1.0); };
  const auto words = [](const Row& row) {
    return fmt::format("gauss {}: {:.2f}", row.text("stages"), *fitted_order(row));
  };
  return found(std::ranges::all_of(orders, is_lower), "slopes of DMOC's stage controls, s + 1 instead of 2s: {}",
               orders.in_words(", ", words));
}

}  // namespace

Claims order_claims() {
  return {{"order_of_convergence", of_paper, "main_theorem", Whose::paper,
           "order kappa for state, costate and u(x, psi) at the nodes", order_of_convergence},
          {"order_of_adjoint_scheme", of_paper, "th:orderapp, eq:stateco5-eq:stateco9", Whose::paper,
           "the adjoint scheme is that of the states with both halves exchanged, and has its order",
           order_of_adjoint_scheme}};
}

Claims stage_control_claims() {
  // Not the orbit: its costate is nearly constant, and so the low-order terms of its stages are too small to be seen.
  return {{"order_of_stage_controls", only_two_link, "remark behind main_theorem", Whose::paper,
           "the estimate holds for u(x_k, psi_k), not for the controls u_k of the stages", order_of_stage_controls}};
}

}  // namespace dmocbench
