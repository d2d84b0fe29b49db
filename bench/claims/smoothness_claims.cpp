// Convergence for nonsmooth optimal controls, free final states, and coercivity: the assumptions of (main_theorem).
#include <cmath>
#include <limits>

#include "bench/claims/claim.hpp"

namespace dmocbench {

namespace {

/// The quantities in (main_theorem); psi^q jumps where a bound on the state becomes active.
const std::vector<std::string> of_theorem{"state", "costate_p", "node_control"};

/// Slopes of DMOC with a number of stages, of some quantities, in selected situations.
template <class Picks>
Selection orders_of(const ResultTables& tables, const char* stages, const std::vector<std::string>& quantities,
                    const Picks& picks) {
  Selection orders;
  const Selection rows = tables.rows("smoothness_slopes").where("method", "dmoc").where("stages", stages).where(picks);
  for (const std::string& quantity : quantities) {
    const Selection of_quantity = rows.where("quantity", quantity);
    require(!of_quantity.empty(), "smoothness_slopes.csv has no slope of {} with {} stages in a required situation",
            quantity, stages);
    orders.append(of_quantity);
  }
  return orders;
}

auto with_active(std::string bound) {
  return [bound = std::move(bound)](const Row& row) { return row.text("active") == bound; };
}

Words orders_in_words(const Selection& orders) {
  return joined(orders, ", ", [](const Row& row) {
    const std::string& quantity = row.text("quantity");
    return worded("{} {} {:.2f}", row.text("situation"), quantity,
                  Measurement{"slope of the " + quantity, row.needed("slope"), "dmoc",
                              row.text("situation") + ", s = " + row.text("stages")});
  });
}

Finding order_2_within_control_bounds(const ResultTables& tables, const std::string& /*problem*/) {
  // The error's factor changes with the place of a kink within its interval. O(h^2) is an upper estimate.
  constexpr double beside = 0.35;
  const Selection orders = orders_of(tables, "1", of_theorem, with_active("control"));
  const auto is_2 = [](const Row& row) {
    const double half_width = 2.0 * row.needed("standard_error");
    const double slope = row.needed("slope");
    return verdict_on_interval(slope - half_width, slope + half_width, 2.0 - beside,
                               std::numeric_limits<double>::infinity());
  };
  return found(verdict_on_all(orders, is_2), "slopes with the midpoint rule: {}", orders_in_words(orders));
}

Finding kinks_leave_order_2(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double nearer_to_2 = 3.0;
  const auto has_kinks = [](const Row& row) { return row.text("active") != "nothing"; };
  const Selection kinked = orders_of(tables, "2", {"state"}, has_kinks);
  const Selection smooth = orders_of(tables, "2", {"state"}, std::not_fn(has_kinks));
  const auto lost = [](const Row& row) {
    const double half_width = 2.0 * row.needed("standard_error");
    return verdict_on_interval(row.needed("slope") - half_width, row.needed("slope") + half_width, 1.5, nearer_to_2);
  };
  const auto kept = [](const Row& row) { return verdict_on_order(row, 4.0); };
  return found(verdict_on_all({verdict_on_all(kinked, lost), verdict_on_all(smooth, kept)}),
               "slopes of the state with Gauss, s = 2, where the control has kinks: {}", orders_in_words(kinked))
      .also(worded("without: {}", orders_in_words(smooth)));
}

Finding free_end_has_the_order(const ResultTables& tables, const std::string& /*problem*/) {
  const auto is_free = [](const Row& row) { return row.text("active") == "nothing" && row.text("end") == "free"; };
  Selection orders;
  for (const char* stages : {"1", "2"}) {
    orders.append(orders_of(tables, stages, {"state", "costate_q", "costate_p", "node_control"}, is_free));
  }
  const auto is_own = [](const Row& row) { return verdict_on_order(row, row.needed("order")); };
  return found(verdict_on_all(orders, is_own), "slopes of DMOC, s = 1 and 2: {}", orders_in_words(orders));
}

Finding state_bound_orders(const ResultTables& tables, const std::string& /*problem*/) {
  const auto is_arc = [](const Row& row) { return row.text("situation") == "beam"; };  // the other one only touches
  const Selection theorem = orders_of(tables, "1", of_theorem, is_arc);
  const Selection control = orders_of(tables, "1", {"control"}, is_arc);
  const Selection jumping = orders_of(tables, "1", {"costate_q"}, is_arc);
  const auto has = [](double order) { return [=](const Row& row) { return verdict_on_order(row, order); }; };
  const ClaimVerdict verdict = verdict_on_all(
      {verdict_on_all(theorem, has(2.0)), verdict_on_all(control, has(1.0)), verdict_on_all(jumping, has(0.0))});
  return found(verdict, "slopes with the midpoint rule: {}", orders_in_words(theorem))
      .also(orders_in_words(control))
      .also(orders_in_words(jumping));
}

/// The smallest curvature of DMOC over the grids, coarsest first.
Selection curvatures(const ResultTables& tables, const std::string& problem, const char* end) {
  Selection rows = tables.rows("coercivity", problem).where("end", end).where("method", "dmoc").sorted_by("intervals");
  require(rows.size() >= 3, "coercivity.csv has {} rows of dmoc for {} with its final state {}; three are needed",
          rows.size(), problem, end);
  return rows;
}

Finding coercive(const ResultTables& tables, const std::string& problem, const char* end) {
  constexpr double bounded_below = 0.5;
  constexpr double settled = 0.01;
  const Selection rows = curvatures(tables, problem, end);
  const auto curvature = [](const Row& row) { return row.needed("smallest_curvature"); };
  const double last = curvature(rows.back());
  double least = last;
  double before_last = last;
  for (const Row& row : rows) {
    least = std::min(least, curvature(row));
    if (&row != &rows.back()) before_last = curvature(row);
  }
  return found(last > 0.0 && least > bounded_below * last && std::abs(before_last - last) < settled * last,
               "alpha_h on {} grids: at least {:.4f}, {:.4f} on the finest", rows.size(),
               Measurement{"least alpha_h", least, "dmoc"}, Measurement{"alpha_h on the finest grid", last, "dmoc"});
}

Finding not_coercive(const ResultTables& tables, const std::string& /*problem*/) {
  const Selection rows = curvatures(tables, "brachistochrone", "stated");
  const auto curvature = [](const Row& row) { return row.needed("smallest_curvature"); };
  const double first = curvature(rows.front());
  const double last = curvature(rows.back());
  const double refined = rows.back().needed("intervals") / rows.front().needed("intervals");
  bool falls = last >= 0.0;
  double coarser = std::numeric_limits<double>::infinity();
  for (const Row& row : rows) {
    falls = falls && curvature(row) < coarser;
    coarser = curvature(row);
  }
  return found(falls && last * refined < first, "alpha_h falls from {:.2e} to {:.2e} as h is divided by {:g}",
               Measurement{"alpha_h on the coarsest grid", first, "dmoc"},
               Measurement{"alpha_h on the finest grid", last, "dmoc"},
               Measurement{"ratio of the step sizes", refined});
}

}  // namespace

/// The assumption of coercivity.
Claims coercivity_claims() {
  const auto at_end = [](const char* end) {
    return [=](const ResultTables& tables, const std::string& problem) { return coercive(tables, problem, end); };
  };
  const char* const where = "section 3.5, assumption of coercivity";
  return {
      {.id = "coercive",
       .where = where,
       .states =
           "along the discrete optima, the second variation is coercive on variations that keep the fixed final state",
       .judge = at_end("stated"),
       .condition = "the largest alpha_h with d^2 L >= alpha_h h sum b_i |dU_i|^2 is bounded below as h falls",
       .evidence = {"coercivity.csv"}},
      {.id = "coercive_with_a_free_end",
       .where = where,
       .states = "the assumption of main_theorem holds along the discrete optima: the second variation is coercive "
                 "on the space M of the paper, whose variations move the final state",
       .judge = at_end("free"),
       .condition = "x = (q, p) at T is free along the variations, and V = 0, as the cost has no final term and r "
                    "is linear; the optimum belongs to the stated problem",
       .cause = "M leaves out the fixed final state; variations that move it lower the cost to second order, so "
                "main_theorem does not cover this problem, although its optima converge with the order of the theorem",
       .evidence = {"coercivity.csv"},
       .headline = true}};
}

/// Optima that are not smooth, free final states.
Claims smoothness_claims() {
  const std::vector<std::string> evidence{"smoothness_slopes.csv", "smoothness.csv", "figures/smoothness.svg"};
  return {{.id = "order_within_control_bounds",
           .problems = examples,
           .where = "section 3.6, second remark below main_theorem",
           .whose = Whose::paper,
           .states = "order 2 also holds with constraints on the control",
           .judge = order_2_within_control_bounds,
           .evidence = evidence},
          {.id = "order_with_a_free_end",
           .problems = examples,
           .where = "section 3.6, main_theorem",
           .whose = Whose::paper,
           .states = "with a free final state, state, costate and u(x, psi) have the order of the method",
           .judge = free_end_has_the_order,
           .evidence = evidence},
          {.id = "kinks_leave_order_2",
           .problems = examples,
           .where = "section 3.6, eq:conv_estimate",
           .states = "where the optimal control has kinks, a method of order 4 has only about order 2",
           .judge = kinks_leave_order_2,
           .condition = "tau(d^3 u*/dt^3; h) of eq:conv_estimate does not exist at kinks; it exists for u* and its "
                        "first derivative, which gives h^2",
           .evidence = evidence},
          {.id = "order_within_a_state_bound",
           .problems = examples,
           .where = "section 3.6, main_theorem",
           .states =
               "with a bound on the state that is active along an arc, state, psi^p and u(x, psi) keep order 2, stage "
               "controls have order 1, and psi^q, which jumps, does not converge",
           .judge = state_bound_orders,
           .evidence = evidence},
          {.id = "brachistochrone_not_coercive",
           .problems = examples,
           .where = "section 3.5, assumption of coercivity",
           .states = "for a problem that is linear in its control, the constant of coercivity tends to 0",
           .judge = not_coercive,
           .evidence = {"coercivity.csv"}}};
}

}  // namespace dmocbench
