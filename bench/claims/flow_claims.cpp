// The order of consistency (th:ordercalculation), and momentum, symplecticity and energy of the discrete flow.
#include <cmath>

#include "bench/claims/claim.hpp"
#include "methods/transcription/elements/families.hpp"

namespace dmocbench {

namespace {

/// With four stages errors reach the rounding of double coefficients before they are asymptotic.
constexpr double most_stages = 3;
/// Largest momentum defects of 400 steps that are rounding, in double and in long double.
constexpr double rounding_in_double = 1e-11;
constexpr double rounding_in_long_double = 1e-14;
/// Forces along the group must do at least this work to be conclusive.
constexpr double some_work = 1e-6;

/// Errors of two quantities fall with h^(r + 1).
Predicate has_order_of_consistency(const char* one, const char* other) {
  return [=](const ResultTables& tables, const std::string& problem) -> Finding {
    const Selection rows = tables.rows("consistency_order_slopes", problem).where("tableau", "gauss");
    Selection orders;
    std::size_t beyond = 0;
    for (const char* quantity : {one, other}) {
      const Selection of_quantity = rows.where("quantity", quantity);
      const Selection judged = of_quantity.where([](const Row& row) { return row.needed("stages") <= most_stages; });
      for (const Row& row : rows.where("quantity", quantity == one ? other : one)) {
        require(!of_quantity.matching(row, {"stages"}).empty(),
                "consistency_order_slopes.csv has no slope of {} for {} with {} Gauss stages", quantity, problem,
                row.text("stages"));
      }
      beyond += of_quantity.size() - judged.size();
      orders.append(judged);
    }
    require(!orders.empty(), "consistency_order_slopes.csv has no slope of {} or {} for {}", one, other, problem);
    const auto is_one_more = [](const Row& row) { return verdict_on_order(row, row.needed("order") + 1.0); };
    const auto words = [](const Row& row) {
      const std::string& quantity = row.text("quantity");
      const std::string stages = "gauss " + row.text("stages");
      return worded("{} {:.2f} (r = {:g})", quantity,
                    Measurement{"slope of the " + quantity, row.needed("slope"), "", stages},
                    Measurement{"order r", row.needed("order"), "", stages});
    };
    return found(verdict_on_all(orders, is_one_more), "slopes over h with Gauss: {}", joined(orders, ", ", words))
        .also(beyond == 0
                  ? Words()
                  : worded(
                        "{} slopes with four stages, which reach round-off first, are left out; this favours the claim",
                        beyond));
  };
}

/// The largest defect of tangent-space collocation for comparison: it is far above rounding, so that the simulations
/// distinguish a method that keeps the balance from one that does not.
Words defect_of_tangent(const Selection& rows) {
  const Selection tangent = rows.where("method", "tangent");
  if (tangent.empty()) return {};
  return worded("tangent up to {:.1e}", Measurement{"largest defect", tangent.max("defect"), "tangent"});
}

Selection simulations(const ResultTables& tables, const char* force) {
  Selection rows = tables.rows("invariants_momentum").where("force", force);
  require(!rows.where("method", "dmoc").empty(),
          "invariants_momentum.csv has no simulation by dmoc with a force {} the group action", force);
  return rows;
}

/// The change of momentum equals the work of f_d, which is read from its own column, and this work is not zero.
Finding forced_noether(const ResultTables& tables, const std::string& /*problem*/) {
  const Selection rows = simulations(tables, "along");
  const Selection dmoc = rows.where("method", "dmoc");
  const auto miss = [](const Row& row) {
    return std::abs(row.needed("momentum_change") - row.needed("work_of_discrete_forces"));
  };
  const double least_work = -dmoc.max([](const Row& row) { return -std::abs(row.needed("work_of_discrete_forces")); });
  const double defect = dmoc.max("defect");
  const double in_long_double = dmoc.max("defect_in_long_double");
  return found(dmoc.max(miss) < rounding_in_double && defect < rounding_in_double &&
                   in_long_double < rounding_in_long_double && least_work > some_work,
               "{} simulations of 400 steps with arbitrary controls: change of momentum minus the work of f_d is at "
               "most {:.1e}, at any single step {:.1e}, in long double {:.1e}",
               dmoc.size(), Measurement{"change of momentum minus the work", dmoc.max(miss), "dmoc"},
               Measurement{"largest defect", defect, "dmoc"},
               Measurement{"largest defect in long double", in_long_double, "dmoc"})
      .also(worded("the work is at least {:.1e}", Measurement{"least work", least_work, "dmoc"}))
      .also(defect_of_tangent(rows));
}

/// Neither the discrete forces do work nor does the momentum change.
Finding momentum_preserved(const ResultTables& tables, const std::string& /*problem*/) {
  const Selection rows = simulations(tables, "orthogonal");
  const Selection dmoc = rows.where("method", "dmoc");
  const double change = dmoc.max([](const Row& row) { return std::abs(row.needed("momentum_change")); });
  const double work = dmoc.max([](const Row& row) { return std::abs(row.needed("work_of_discrete_forces")); });
  const double defect = dmoc.max("defect");
  const double in_long_double = dmoc.max("defect_in_long_double");
  return found(change < rounding_in_double && work < rounding_in_double && defect < rounding_in_double &&
                   in_long_double < rounding_in_long_double,
               "{} simulations of 400 steps with arbitrary controls: the momentum changes by at most {:.1e}, while the "
               "forces do work of {:.1e} along the group action",
               dmoc.size(), Measurement{"largest change of momentum", change, "dmoc"},
               Measurement{"largest work", work, "dmoc"})
      .also(worded("largest defect {:.1e}, in long double {:.1e}", Measurement{"largest defect", defect, "dmoc"},
                   Measurement{"largest defect in long double", in_long_double, "dmoc"}))
      .also(defect_of_tangent(rows));
}

Finding symplectic(const ResultTables& tables, const std::string& /*problem*/) {
  const Selection rows = tables.rows("invariants_symplecticity");
  constexpr double within_rounding = 100.0;
  const auto defect = [](const Row& row) {
    require(row.needed("rounding") > 0.0, "{}, column rounding: the value must be positive", row.place());
    return row.needed("defect") / row.needed("rounding");
  };
  const auto is_tangent = [](const Row& row) { return row.text("method") == "tangent"; };
  for (const std::string& method : paper_families()) {
    require(!rows.where("method", method).empty(), "invariants_symplecticity.csv has no row of {}", method);
  }
  const double structured = std::max(0.0, rows.where(std::not_fn(is_tangent)).max(defect));
  const double tangent = std::max(0.0, rows.where(is_tangent).max(defect));
  return found(structured < within_rounding && tangent > within_rounding,
               "D'ΩD - Ω in units of round-off: DMOC and Hamiltonian at most {:.1f}, tangent-space up to {:.1e}",
               Measurement{"largest defect in units of round-off", structured, "dmoc"},
               Measurement{"largest defect in units of round-off", tangent, "tangent"});
}

/// Of the continuous flow, to what its integration allows.
Finding continuous_noether(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double within_tolerance = 1000.0;  // an integration keeps its tolerance in each of many steps
  const Selection rows = tables.rows("invariants_flow_momentum");
  const Selection along = rows.where("force", "along");
  const Selection orthogonal = rows.where("force", "orthogonal");
  require(!along.empty() && !orthogonal.empty(),
          "invariants_flow_momentum.csv has {} trajectories with forces along the group action and {} with orthogonal "
          "forces; both kinds are needed",
          along.size(), orthogonal.size());
  const auto miss = [](const Row& row) { return std::abs(row.needed("momentum_change") - row.needed("work")); };
  const auto in_tolerances = [&](const Row& row) {
    require(row.needed("tolerance") > 0.0, "{}, column tolerance: the value must be positive", row.place());
    return miss(row) / row.needed("tolerance");
  };
  const double least_work = -along.max([](const Row& row) { return -std::abs(row.needed("work")); });
  const double change = orthogonal.max([](const Row& row) { return std::abs(row.needed("momentum_change")); });
  return found(rows.max(in_tolerances) < within_tolerance && least_work > some_work,
               "{} trajectories with smooth controls: change of momentum minus the integral of the force along the "
               "group action is at most {:.1e}, the integral itself at least {:.1e}",
               rows.size(), Measurement{"largest change of momentum minus the integral", rows.max(miss)},
               Measurement{"least integral", least_work})
      .also(worded("with orthogonal forces, the momentum changes by at most {:.1e}",
                   Measurement{"largest change of momentum", change}));
}

Finding lagrangian_form(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double within_rounding = 100.0;
  const Selection rows = tables.rows("invariants_flow_symplecticity");
  const auto defect = [](const Row& row) {
    require(row.needed("rounding") > 0.0, "{}, column rounding: the value must be positive", row.place());
    return row.needed("defect") / row.needed("rounding");
  };
  return found(rows.max(defect) < within_rounding,
               "D'ΩD - Ω over T = {:g} on {} systems: at most {:.1e}, {:.1f} in units of round-off",
               Measurement{"horizon", rows.front().needed("horizon")}, rows.size(),
               Measurement{"largest defect", rows.max("defect")},
               Measurement{"largest defect in units of round-off", rows.max(defect)})
      .also(worded("for the form as printed, in which dv^dv vanishes, up to {:.1e}",
                   Measurement{"largest change of the form as printed", rows.max("printed_change")}));
}

Finding energy_oscillates(const ResultTables& tables, const std::string& /*problem*/) {
  const Selection rows = tables.rows("invariants_energy_behaviour").where("periods", "10000");
  const auto is_dmoc = [](const Row& row) { return row.text("method") == "dmoc"; };
  const auto dmoc = std::ranges::count_if(rows, is_dmoc);
  require(dmoc > 0 && rows.size() >= 3 && std::cmp_less(dmoc, rows.size()),
          "invariants_energy_behaviour.csv has {} rows over 10000 periods, {} of them by dmoc; both kinds are needed",
          rows.size(), dmoc);
  const auto is_as_stated = [&](const Row& row) {
    constexpr double bounded = 1.05;
    constexpr double drifts = 10.0;
    const double oscillation = row.needed("oscillation");
    return is_dmoc(row) ? row.needed("range") < bounded * oscillation
                        : std::abs(row.needed("change")) > drifts * oscillation;
  };
  const auto words = [](const Row& row) {
    const std::string& method = row.text("method");
    const std::string order = "order " + row.text("order");
    return worded("{} of {}: oscillation {:.1e}, change {:.1e}", method, order,
                  Measurement{"oscillation of the energy", row.needed("oscillation"), method, order},
                  Measurement{"change of the energy", std::abs(row.needed("change")), method, order});
  };
  return found(std::ranges::all_of(rows, is_as_stated), "eccentric Kepler orbit over 10000 periods: {}",
               joined(rows, "; ", words));
}

}  // namespace

/// The order of consistency.
Claims consistency_order_claims() {
  return {{.id = "order_of_discrete_lagrangian",
           .where = "section 2.3, eq:DMOC_orderL, th:ordercalculation",
           .whose = Whose::paper,
           .states = "L_d and the one-step map are exact up to h^(r + 1)",
           .judge = has_order_of_consistency("lagrangian", "map"),
           .evidence = {"consistency_order_slopes.csv", "figures/{}_consistency_order.svg"}}};
}

/// Invariants of the discrete flow.
Claims flow_claims() {
  return {
      {.id = "forced_noether_theorem",
       .problems = simulated,
       .where = "section 2.2, eq:noether_force_d",
       .whose = Whose::paper,
       .states = "the momentum changes by the work of the discrete forces along the group action",
       .judge = forced_noether,
       .evidence = {"invariants_momentum.csv"}},
      {.id = "momentum_preserved",
       .problems = simulated,
       .where = "section 2.2, th:discforcNoe",
       .whose = Whose::paper,
       .states = "a force orthogonal to the group action preserves the momentum",
       .judge = momentum_preserved,
       .evidence = {"invariants_momentum.csv"}},
      {.id = "symplectic",
       .problems = simulated,
       .where = "sections 2.2 and 3.4, equ_L_RK",
       .whose = Whose::paper,
       .states = "the unforced discrete flow is symplectic",
       .judge = symplectic,
       .evidence = {"invariants_symplecticity.csv"}},
      {.id = "continuous_forced_noether_theorem",
       .problems = simulated,
       .where = "section 2.1, eq:noether_force",
       .whose = Whose::paper,
       .states = "along the continuous flow, the momentum changes by the integral of the force along the group action, "
                 "and not at all if the force is orthogonal to the group action",
       .judge = continuous_noether,
       .condition = "trajectories are integrated like replays, with an adaptive method of order 7(8)",
       .evidence = {"invariants_flow_momentum.csv"}},
      {.id = "lagrangian_form_preserved",
       .problems = simulated,
       .where = "section 2.1, Omega_L",
       .whose = Whose::paper,
       .states = "the unforced Lagrangian flow preserves the symplectic form Omega_L on TQ",
       .judge = lagrangian_form,
       .condition = "the second term of Omega_L has dv^dq here, where the paper prints dv^dv; the derivative of the "
                    "flow is the solution of the variational equations in long double",
       .evidence = {"invariants_flow_symplecticity.csv"}},
      {.id = "energy_does_not_drift",
       .problems = simulated,
       .where = "section 3.3, Conservation of a Modified Energy",
       .states = "with DMOC, the energy of an unforced elliptic orbit oscillates without drift; with explicit "
                 "Runge-Kutta methods and Radau it drifts",
       .judge = energy_oscillates,
       .condition = "the energy itself is measured, not a modified energy; in Cartesian coordinates the mass matrix is "
                    "constant and the paper's three methods coincide, so this is not a comparison with collocation",
       .evidence = {"invariants_energy_behaviour.csv", "figures/kepler_energy.svg"}}};
}

}  // namespace dmocbench
