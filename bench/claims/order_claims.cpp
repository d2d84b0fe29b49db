// Convergence of states, costates and controls (main_theorem) and the adjoint scheme that it rests on (th:orderapp),
// for every tableau against the indirect solution.
#include <algorithm>
#include <limits>
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

double expected_order(const Row& row) {
  const double s = row.needed("stages");
  return row.text("tableau") == "gauss" ? 2.0 * s : 2.0 * s - 2.0;
}

/// Fitted orders of both structured methods.
Selection orders_of(const ResultTables& tables, const std::string& problem,
                    const std::vector<std::string>& quantities) {
  return tables.rows("convergence_indirect_slopes", problem).where([&](const Row& row) {
    return is_structured(row) && std::ranges::find(quantities, row.text("quantity")) != quantities.end();
  });
}

/// The orders that were fitted.
Selection fitted_of(const Selection& orders) { return orders.where(has_order); }

/// The rows missing from the orders: orders without a fit, and solves that no fit could use.
Words not_in(const Selection& orders, const ResultTables& tables, const std::string& problem) {
  return joined(
      {left_out(orders, fitted_of(orders),
                "no order was fitted (few grids above round-off, no four that agree, or finer ones that contradict):"),
       unsolved_behind(tables, "convergence_indirect", {{"problem", problem}})},
      "; ");
}

/// Throws `Error` unless there is an order of every quantity, by both methods and every tableau that is there at all.
void require_all(const Selection& orders, const std::vector<std::string>& quantities) {
  for (const Selection& scheme : orders.group_by({"tableau", "stages"})) {
    for (const std::string method : {"dmoc", "hamiltonian"}) {
      for (const std::string& quantity : quantities) {
        require(!scheme.where("method", method).where("quantity", quantity).empty(),
                "convergence_indirect_slopes.csv has no order of {} for {}, {}, {} {}", quantity,
                scheme.front().text("problem"), method, scheme.front().text("tableau"), scheme.front().text("stages"));
      }
    }
  }
}

/// `reproduced` needs an order for every tableau that was solved. Throws `Error` that names the first without one.
void require_solved_schemes(const Selection& orders, const ResultTables& tables, const std::string& problem) {
  if (!tables.has("convergence_indirect")) return;
  for (const Selection& scheme : tables.rows("convergence_indirect", problem).group_by({"tableau", "stages"})) {
    require(!orders.matching(scheme.front(), {"tableau", "stages"}).empty(),
            "convergence_indirect_slopes.csv lacks an order for {}, {} {}, which convergence_indirect.csv contains",
            problem, scheme.front().text("tableau"), scheme.front().text("stages"));
  }
}

/// DMOC's orders by tableau: "gauss 2 (order 4): state 4.02, costate floor; ...". Where it has none, the order of
/// Hamiltonian collocation, which has the same solutions with less round-off.
Words in_words(const Selection& orders) {
  std::map<std::pair<double, std::string>, Selection> tableaus;
  for (const Row& row : orders.where("method", "dmoc")) {
    tableaus[{expected_order(row), row.text("tableau") + " " + row.text("stages")}].append(row);
  }
  std::vector<Words> all;
  for (const auto& [order_and_tableau, rows] : tableaus) {
    const auto& [expected, tableau] = order_and_tableau;
    const auto order_of_row = [&](const Row& dmoc) {
      const std::string& quantity = dmoc.text("quantity");
      const Selection others =
          fitted_of(orders.where("method", "hamiltonian").matching(dmoc, {"tableau", "stages", "quantity"}));
      const Row& row = has_order(dmoc) || others.empty() ? dmoc : others.front();
      if (!has_order(row)) return worded("{} {}", quantity, why_without_order(row));
      const std::string& method = row.text("method");
      return worded("{} {:.2f} ({}N = {} to {}, {})", quantity,
                    Measurement{"slope of the " + quantity, row.needed("slope"), method, tableau},
                    method == "dmoc" ? "" : method + ", ", row.text("coarsest"), row.text("finest"),
                    row.text("fine_end"));
    };
    all.push_back(worded("{} (order {:g}): {}", tableau, Measurement{"expected order", expected, "dmoc", tableau},
                         joined(rows, ", ", order_of_row)));
  }
  return joined(all, "; ");
}

/// Whether orders are as expected, if other things hold too; `floor` if less than half of them could be fitted, if a
/// quantity has no fit, or if a tableau of second or of fourth order, whose errors are far above round-off on many
/// grids, has none of state or costate. An error that never falls looks like a floor.
ClaimVerdict verdict_on_orders(const Selection& orders, bool others_hold = true) {
  const Selection fitted = fitted_of(orders);
  const auto is_expected = [](const Row& row) { return verdict_on_order(row, expected_order(row)); };
  const ClaimVerdict of_fitted = verdict_on_all({verdict_on(others_hold), verdict_on_all(fitted, is_expected)});
  if (of_fitted != ClaimVerdict::reproduced) return of_fitted;
  const auto has_no_fit = [](const Selection& some) { return fitted_of(some).empty(); };
  const auto needs_a_fit = [](const Row& row) {
    return expected_order(row) <= 4.0 && (row.text("quantity") == "state" || row.text("quantity") == "costate");
  };
  if (std::ranges::any_of(orders.where(needs_a_fit).group_by({"tableau", "stages", "quantity"}), has_no_fit) ||
      std::ranges::any_of(orders.group_by({"quantity"}), has_no_fit))
    return ClaimVerdict::floor;
  return 2 * fitted.size() < orders.size() ? ClaimVerdict::floor : ClaimVerdict::reproduced;
}

Finding order_of_convergence(const ResultTables& tables, const std::string& problem) {
  const std::vector<std::string> quantities{"state", "momentum", "costate", "control_from_costate"};
  const Selection orders = orders_of(tables, problem, quantities);
  require(!orders.empty(), "convergence_indirect_slopes.csv has no order of the states of {}", problem);
  require_all(orders, quantities);
  const ClaimVerdict verdict = verdict_on_orders(orders);
  if (verdict == ClaimVerdict::reproduced) require_solved_schemes(orders, tables, problem);
  return found(verdict, "slopes of DMOC's errors relative to the indirect solution: {}", in_words(orders))
      .also(not_in(orders, tables, problem));
}

Finding order_of_adjoint_scheme(const ResultTables& tables, const std::string& problem) {
  const Selection orders = orders_of(tables, problem, {"costate"});
  const Selection all = tables.rows("equivalence", problem).where(is_structured);
  const Selection solves = all.usable();
  const Selection lobatto = solves.where("tableau", "lobatto");
  require(!orders.empty(), "convergence_indirect_slopes.csv has no order of the costate of {}", problem);
  require_all(orders, {"costate"});
  require(!lobatto.empty() && lobatto.size() < solves.size(),
          "equivalence.csv has {} solves of {} with Lobatto and {} with Gauss; both are needed", lobatto.size(),
          problem, solves.size() - lobatto.size());
  const double residual = solves.max("adjoint_residual");
  const double plain = lobatto.min("adjoint_residual_by_plain_coefficients");
  return found(verdict_on_orders(orders, residual < rounding_of_costates && plain > far_above_rounding),
               "costates from the multipliers of {} solves have a relative residual of at most {:.1e} (for Lobatto "
               "without exchanging the halves: at least {:.1e})",
               solves.size(), Measurement{"largest residual of the adjoint scheme", residual},
               Measurement{"smallest residual without exchanging the coefficients", plain})
      .also(left_out(all, solves))
      .also(worded("slopes of DMOC's costate: {}", in_words(orders)))
      .also(not_in(orders, tables, problem));
}

/// The error of the state over the sum of the errors of all intervals, on the coarsest and the finest grid.
Finding stability_constant(const ResultTables& tables, const std::string& problem) {
  const Selection all = tables.rows("convergence_indirect_jumps", problem).where([](const Row& row) {
    return is_structured(row) && row.text("tableau") == "gauss" && row.text("stages") == "1";
  });
  const Selection rows = all.where("verdict", "slope");
  require(!rows.empty(), "convergence_indirect_jumps.csv has no fitted row of {} with the midpoint rule among {} rows",
          problem, all.size());
  const auto words = [](const Row& row) {
    const auto ratio = [&](const char* column, const char* grid) {
      return Measurement{"error of the state divided by N times the largest jump", row.needed(column),
                         row.text("method"), "N = " + row.text(grid)};
    };
    return worded("{} {:.4f} at N = {}, {:.4f} at N = {}", row.text("method"),
                  ratio("error_of_jumps_coarsest", "coarsest"), row.text("coarsest"),
                  ratio("error_of_jumps_finest", "finest"), row.text("finest"));
  };
  return found(ClaimVerdict::measured, "error of the state divided by N times the largest jump between intervals: {}",
               joined(rows, ", ", words));
}

Finding order_of_stage_controls(const ResultTables& tables, const std::string& problem) {
  const Selection all = orders_of(tables, problem, {"control"}).where([](const Row& row) {
    return row.text("method") == "dmoc" && row.text("tableau") == "gauss" && row.needed("stages") > 1.0;
  });
  const Selection orders = fitted_of(all);
  require(!orders.empty(),
          "convergence_indirect_slopes.csv has no fitted order of the control for {} by dmoc with two or more stages",
          problem);
  const auto is_lower = [](const Row& row) { return verdict_on_order(row, row.needed("stages") + 1.0); };
  const auto words = [](const Row& row) {
    return worded("gauss {}: {:.2f}", row.text("stages"),
                  Measurement{"slope of the control", row.needed("slope"), "dmoc", "gauss " + row.text("stages")});
  };
  return found(verdict_on_all(orders, is_lower), "slopes of DMOC's stage controls, s + 1 instead of 2s: {}",
               joined(orders, ", ", words))
      .also(not_in(all, tables, problem));
}

Finding order_eight(const ResultTables& tables, const std::string& problem) {
  const Selection all =
      orders_of(tables, problem, {"state", "costate", "control_from_costate"}).where([](const Row& row) {
        return row.text("tableau") == "gauss" && row.text("stages") == "4";
      });
  const Selection orders = fitted_of(all);
  require(!all.empty(), "convergence_indirect_slopes.csv has no order for {} with gauss 4", problem);
  const auto is_eight = [](const Row& row) { return verdict_on_order(row, 8.0); };
  const auto words = [](const Row& row) {
    const std::string& quantity = row.text("quantity");
    return worded("{} {}: {:.2f} (N = {} to {})", row.text("method"), quantity,
                  Measurement{"slope of the " + quantity, row.needed("slope"), row.text("method"), "gauss 4"},
                  row.text("coarsest"), row.text("finest"));
  };
  return found(orders.empty() ? ClaimVerdict::floor : verdict_on_all(orders, is_eight),
               "slopes with four Gauss stages: {}",
               orders.empty() ? worded("none above round-off") : joined(orders, ", ", words))
      .also(not_in(all, tables, problem));
}

/// Every fitted order of some quantities is the one of `expected`, and each quantity has one by every tableau that the
/// table has; otherwise the claim is not judged.
Finding first_order_orders(const ResultTables& tables, const std::string& table, const std::string& problem,
                           const std::vector<std::string>& quantities, double (*expected)(const Row&)) {
  const Selection all = tables.rows(table, problem).where([&](const Row& row) {
    return std::ranges::find(quantities, row.text("quantity")) != quantities.end();
  });
  const Selection fitted = all.where([](const Row& row) { return row.text("verdict") == "slope"; });
  std::vector<Words> words;
  for (const Selection& scheme : all.group_by({"tableau", "stages"})) {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (const std::string& quantity : quantities) {
      const Selection of_quantity = fitted.matching(scheme.front(), {"tableau", "stages"}).where("quantity", quantity);
      require(!of_quantity.empty(), "{}.csv has no fitted order of {} for {}, {} {}", table, quantity, problem,
              scheme.front().text("tableau"), scheme.front().text("stages"));
      lowest = std::min(lowest, of_quantity.min("slope"));
      highest = std::max(highest, of_quantity.max("slope"));
    }
    const std::string tableau = scheme.front().text("tableau") + " " + scheme.front().text("stages");
    words.push_back(worded("{}: {:.2f} to {:.2f} (order {:g})", tableau,
                           Measurement{"lowest slope", lowest, "", tableau},
                           Measurement{"highest slope", highest, "", tableau},
                           Measurement{"expected order", expected(scheme.front()), "", tableau}));
  }
  require(!words.empty(), "{}.csv has no order for {}", table, problem);
  const auto verdict_of = [&](const Row& row) { return verdict_on_order(row, expected(row)); };
  return found(verdict_on_all(fitted, verdict_of), "lowest and highest slope of all methods: {}", joined(words, "; "))
      .also(left_out(all, fitted, "no order was fitted, which favours the claim:"));
}

Finding orders_with_first_order_states(const ResultTables& tables, const std::string& problem) {
  return first_order_orders(
      tables, "convergence_first_order_slopes", problem,
      {"state", "momentum", "costate", "first_order", "first_order_costate", "control_from_costate"}, expected_order);
}

Finding stage_controls_of_first_order_states(const ResultTables& tables, const std::string& problem) {
  return first_order_orders(tables, "convergence_stage_controls_slopes", problem, {"control"}, [](const Row& row) {
    return row.needed("stages") + (row.text("tableau") == "gauss" ? 1.0 : -1.0);
  });
}

}  // namespace

/// Orders of state and costate for every tableau.
Claims order_claims() {
  const Problems with_first_order_states{"two_link_with_motors", "orbital_transfer_with_mass"};
  const std::vector<std::string> first_order_evidence{"convergence_first_order_slopes.csv",
                                                      "convergence_first_order.csv", "figures/{}_first_order.svg"};
  return {
      {.id = "order_of_convergence",
       .where = "section 3.6, main_theorem",
       .whose = Whose::paper,
       .states = "state, costate and u(x, psi) have order kappa at the nodes",
       .judge = order_of_convergence,
       .condition = "the optimum is smooth, so tau of (eq:conv_estimate), which no table contains, is O(h); the final "
                    "state is fixed, which the theorem excludes",
       .evidence = {"convergence_indirect_slopes.csv", "convergence_indirect.csv", "figures/{}_orders.svg"}},
      {.id = "order_eight_of_four_stages",
       .where = "section 3.6, main_theorem",
       .states = "four Gauss stages have order 8 in state, costate and u(x, psi)",
       .judge = order_eight,
       .condition = "round-off leaves few grids; a fit needs four grids above round-off",
       .evidence = {"convergence_indirect_slopes.csv", "figures/{}_orders.svg"}},
      {.id = "order_of_adjoint_scheme",
       .where = "section 3.5, th:orderapp, eq:stateco5-eq:stateco9",
       .whose = Whose::paper,
       .states = "the adjoint scheme is the scheme of the states with both halves exchanged and has the same order",
       .judge = order_of_adjoint_scheme,
       .condition = "Gauss is its own conjugate, so only Lobatto can distinguish the two",
       .evidence = {"equivalence.csv", "convergence_indirect_slopes.csv", "figures/{}_adjoint.svg"}},
      {.id = "stability_constant",
       .where = "section 3.6, abstract_result",
       .states = "the factor with which consistency errors of the state equations enter the error of the optimum as "
                 "the grid is refined",
       .judge = stability_constant,
       .condition = "the factor is a lower bound on the constant of (abstract_result) for errors in this direction; "
                    "the reference, the indirect method, supports only the midpoint rule and fixed ends. The paper "
                    "quotes (abstract_result) and assumes (P1) to (P3): no table contains epsilon, r or sigma",
       .evidence = {"convergence_indirect_jumps.csv"},
       .has_verdict = false},
      {.id = "order_with_first_order_states",
       .problems = with_first_order_states,
       .where = "section 3.6, main_theorem",
       .states =
           "with first-order states, collocated by half A of the tableau, all three methods have order 2s (Gauss) "
           "and 2s - 2 (Lobatto) at the nodes, in q, p, y, u(x, psi) and all costates",
       .judge = orders_with_first_order_states,
       .evidence = first_order_evidence,
       .needs = "convergence_first_order_slopes"}};
}

/// And of the controls of the stages.
Claims stage_control_claims() {
  return {
      {.id = "order_of_stage_controls",
       .where = "section 3.6, remark after main_theorem",
       .states = "the controls of the s > 1 Gauss stages have order s + 1, not the order 2s of u(x_k, psi_k) at the "
                 "nodes",
       .judge = order_of_stage_controls,
       .condition = "the paper estimates u(x_k, psi_k) and states nothing about the controls u_k of the stages",
       .cause = "the costate of the optimum is nearly constant: terms of order s + 1 are too small to be visible on "
                "these grids, and the errors fall as at the nodes",
       .evidence = {"convergence_indirect_slopes.csv", "figures/{}_orders.svg"}},
      {.id = "stage_controls_of_first_order_states",
       .problems = {"two_link_with_motors"},
       .where = "section 3.6, remark after main_theorem",
       .states = "stage controls that drive first-order states have order s + 1 (Gauss) and s - 1 (Lobatto)",
       .judge = stage_controls_of_first_order_states,
       .condition = "H_u contains the costate of y, which is discretised with the other half of the tableau",
       .evidence = {"convergence_stage_controls_slopes.csv", "convergence_stage_controls.csv"},
       .needs = "convergence_stage_controls_slopes"}};
}

}  // namespace dmocbench
