// The order of consistency (th:ordercalculation), and momentum, symplecticity and energy of the discrete flow.
#include <cmath>
#include <limits>

#include "bench/claims/claim.hpp"

namespace dmocbench {

namespace {

/// With four stages errors reach the rounding of double coefficients before they are asymptotic.
constexpr double most_stages = 3;
/// Largest momentum defects of 400 steps that are rounding, in double and in long double.
constexpr double rounding_in_double = 1e-11;
constexpr double rounding_in_long_double = 1e-14;

constexpr double not_told = std::numeric_limits<double>::infinity();

/// Errors of two quantities fall with h^(r + 1).
Predicate has_order_of_consistency(const char* one, const char* other) {
  return [=](const ResultTables& tables, const std::string& problem) -> std::optional<Finding> {
    const Selection rows =
        tables.rows("consistency_order_slopes", problem).where("tableau", "gauss").where([](const Row& row) {
          return row.number("stages", 0.0) <= most_stages;
        });
    Selection orders = rows.where("quantity", one);
    orders.append(rows.where("quantity", other));
    if (orders.empty()) return std::nullopt;
    const auto is_one_more = [](const Row& row) { return has_order(row, row.number("order", 0.0) + 1.0); };
    const auto words = [](const Row& row) {
      return fmt::format("{} {:.2f} (r = {:g})", row.text("quantity"), row.number("slope", std::nan("")),
                         row.number("order", 0.0));
    };
    return found(std::ranges::all_of(orders, is_one_more), "slopes over h by Gauss: {}", orders.in_words(", ", words));
  };
}

Predicate balances_momentum(const char* force) {
  return [=](const ResultTables& tables, const std::string& /*problem*/) -> std::optional<Finding> {
    const Selection rows = tables.rows("structure_momentum").where("force", force).where("method", "dmoc");
    if (rows.empty()) return std::nullopt;
    const double defect = rows.max("defect");
    const double in_long_double = rows.max("defect_in_long_double");
    return found(defect < rounding_in_double && in_long_double < rounding_in_long_double,
                 "{} simulations of 400 steps with arbitrary controls: largest defect {:.1e}, in long double {:.1e}",
                 rows.size(), defect, in_long_double);
  };
}

std::optional<Finding> symplectic(const ResultTables& tables, const std::string& /*problem*/) {
  const Selection rows = tables.rows("structure_symplecticity");
  if (rows.empty()) return std::nullopt;
  constexpr double within_rounding = 100.0;
  const auto defect = [](const Row& row) { return row.number("defect", not_told) / row.number("rounding", not_told); };
  const auto is_tangent = [](const Row& row) { return row.text("method") == "tangent"; };
  const double structured = std::max(0.0, rows.where(std::not_fn(is_tangent)).max(defect));
  const double tangent = std::max(0.0, rows.where(is_tangent).max(defect));
  return found(structured < within_rounding && tangent > within_rounding,
               "D'ΩD - Ω in units of rounding: DMOC and Hamiltonian at most {:.1f}, tangent-space up to {:.1e}",
               structured, tangent);
}

std::optional<Finding> modified_energy(const ResultTables& tables, const std::string& /*problem*/) {
  const Selection rows = tables.rows("structure_energy_behaviour").where("periods", "10000");
  if (rows.empty()) return std::nullopt;
  const auto is_as_stated = [](const Row& row) {
    constexpr double bounded = 1.05;
    constexpr double drifts = 10.0;
    const double oscillation = row.number("oscillation", not_told);
    return row.text("method") == "dmoc" ? row.number("range", not_told) < bounded * oscillation
                                        : std::abs(row.number("change", not_told)) > drifts * oscillation;
  };
  const auto words = [](const Row& row) {
    return fmt::format("{} of order {}: oscillation {:.1e}, change {:.1e}", row.text("method"), row.text("order"),
                       row.number("oscillation", not_told), std::abs(row.number("change", not_told)));
  };
  return found(std::ranges::all_of(rows, is_as_stated) && rows.size() >= 3,
               "eccentric Kepler orbit over 10000 periods: {}", rows.in_words("; ", words));
}

}  // namespace

Claims consistency_order_claims() {
  return {{"order_of_discrete_lagrangian", of_paper, "eq:DMOC_orderL, th:ordercalculation", Whose::paper,
           "L_d and the one-step map are exact up to h^(r + 1)", has_order_of_consistency("lagrangian", "map")},
          {"order_of_discrete_forces", of_paper, "eq:DMOC_orderf", Whose::paper, "f_d is exact up to h^(r + 1)",
           has_order_of_consistency("left_force", "right_force")},
          {"order_of_legendre_transforms", of_paper, "eq:DMOC_orderLeg", Whose::paper,
           "the discrete Legendre transforms are exact up to h^(r + 1)",
           has_order_of_consistency("left_legendre", "right_legendre")}};
}

Claims flow_claims() {
  return {
      {"forced_noether_theorem", only_orbit, "eq:noether_force_d", Whose::paper,
       "the momentum changes by the work of the discrete forces along the group action", balances_momentum("along")},
      {"momentum_preserved", only_orbit, "th:discforcNoe", Whose::paper,
       "a force orthogonal to the group action preserves the momentum", balances_momentum("orthogonal")},
      {"symplectic", only_orbit, "section 2.2, equ_L_RK", Whose::paper, "the unforced discrete flow is symplectic",
       symplectic},
      {"modified_energy", only_orbit, "section 2.2", Whose::paper, "energy oscillates but does not drift",
       modified_energy}};
}

}  // namespace dmocbench
