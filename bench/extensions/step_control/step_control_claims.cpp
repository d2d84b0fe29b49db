// Step sizes tied to the motion: the invariants that only the variational route keeps, and its cost.
#include <cmath>
#include <limits>

#include "bench/claims/claim.hpp"
#include "bench/extensions/claims_of_extensions.hpp"

namespace dmocbench {

namespace {

constexpr const char* in_outlook = "section 5, KMLTMD";

/// The rows of a table with steps chosen in one way; at least one.
Selection by_rule(const Selection& rows, const char* rule, const char* table) {
  Selection found = rows.where("rule", rule);
  require(!found.empty(), "{}.csv has no row with {} steps", table, rule);
  return found;
}

Finding symplectic_by_principle(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double within_rounding = 100.0;
  const char* const table = "step_control_symplecticity";
  const Selection rows = tables.rows(table);
  const auto defect = [](const Row& row) {
    require(row.needed("rounding") > 0.0, "{}, column rounding: the value must be positive", row.place());
    return row.needed("defect") / row.needed("rounding");
  };
  const double variational = std::max(0.0, by_rule(rows, "variational", table).max(defect));
  const double imposed = by_rule(rows, "imposed", table).max(defect);
  const double from_left = by_rule(rows, "from_left", table).max(defect);
  return found(variational < within_rounding && std::min(imposed, from_left) > within_rounding,
               "D'ΩD - Ω of (q, t, p, -E), in units of round-off, is at most {:.1f} with variational steps, up to "
               "{:.1e} with imposed steps, and up to {:.1e} with steps computed beforehand",
               Measurement{"largest defect in units of round-off", variational, "", "variational"},
               Measurement{"largest defect in units of round-off", imposed, "", "imposed"},
               Measurement{"largest defect in units of round-off", from_left, "", "from_left"});
}

Finding momentum_by_every_route(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double rounding = 1e-11;
  constexpr double some_work = 1e-6;
  const char* const table = "step_control_momentum";
  const Selection rows = tables.rows(table);
  static_cast<void>(by_rule(rows, "variational", table));
  static_cast<void>(by_rule(rows, "imposed", table));
  const double least_work = -rows.max([](const Row& row) { return -std::abs(row.needed("work")); });
  return found(rows.max("defect") < rounding && least_work > some_work,
               "on {} trajectories of 400 steps under arbitrary thrust, with step sizes from distance, acceleration "
               "and thrust, the change in momentum minus the work is at most {:.1e}",
               rows.size(), Measurement{"largest defect", rows.max("defect")})
      .also(worded("the work is at least {:.1e}", Measurement{"least work", least_work}));
}

Finding energy_by_principle(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double bounded = 1.05;
  constexpr double drifts = 10.0;
  const char* const table = "step_control_energy_behaviour";
  const Selection rows = tables.rows(table);
  const Selection variational = by_rule(rows, "variational", table);
  const Selection from_left = by_rule(rows, "from_left", table);
  const auto stays = [](const Row& row) { return row.needed("range") < bounded * row.needed("oscillation"); };
  const auto leaves = [](const Row& row) {
    return std::abs(row.needed("change")) > drifts * std::abs(row.needed("standard_error"));
  };
  const auto words = [](const Row& row) {
    const std::string at = fmt::format("e = {}, {}", row.text("eccentricity"), row.text("rule"));
    return worded("e = {}, {}: the energy oscillates by {:.1e} and changes by {:.1e}", row.text("eccentricity"),
                  row.text("rule"), Measurement{"oscillation of the energy", row.needed("oscillation"), "", at},
                  Measurement{"change of the energy", std::abs(row.needed("change")), "", at});
  };
  return found(std::ranges::all_of(variational, stays) && std::ranges::all_of(from_left, leaves), "{}",
               joined(rows, "; ", words));
}

/// The smallest and the largest quotient of numbers of rows that agree in a key.
struct Quotients {
  double least = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  std::size_t count = 0;
};
Quotients quotients(const Selection& numerators, const Selection& denominators, const ColumnNames& key,
                    const char* column) {
  Quotients result;
  for (const Row& row : denominators) {
    const Selection beside = numerators.matching(row, key);
    if (beside.empty()) continue;
    const double value = quotient(beside.front(), row, column);
    result.least = std::min(result.least, value);
    result.largest = std::max(result.largest, value);
    ++result.count;
  }
  return result;
}

Finding accuracy_by_principle(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double resolving = 128.0;  // steps per period: on coarser grids errors are as large as the orbit
  const auto resolves = [](const Row& row) { return row.needed("steps_per_period") >= resolving; };
  const Selection forward = tables.rows("step_control").where("status", "solved").where(resolves);
  const Selection optimal = tables.rows("step_control_transfer").where("status", "solved");
  const Selection passes = tables.rows("step_control_slopes");
  const auto by = [](const Selection& rows, const char* rule) { return rows.where("rule", rule); };
  const ColumnNames key{"eccentricity", "sigma", "stages"};
  const ColumnNames on_periods{"eccentricity", "sigma", "stages", "steps_per_period"};
  const ColumnNames on_grids{"eccentricity", "sigma", "stages", "intervals"};
  const Quotients state = quotients(by(forward, "imposed"), by(forward, "variational"), on_periods, "state_error");
  const Quotients cost = quotients(by(optimal, "imposed"), by(optimal, "variational"), on_grids, "cost_error");
  const Quotients operations = quotients(by(passes, "variational"), by(passes, "imposed"), key, "operations");
  const Quotients variables = quotients(by(optimal, "variational"), by(optimal, "imposed"), on_grids, "variables");
  require(state.count >= 3 && cost.count >= 3 && operations.count >= 1,
          "step_control.csv has {} and step_control_transfer.csv {} solved pairs of imposed and variational steps, but "
          "three are needed; step_control_slopes.csv has {}",
          state.count, cost.count, operations.count);
  const auto least = [](const char* name, const Quotients& ratios) {
    return Measurement{std::string("least ratio of ") + name, ratios.least};
  };
  const auto largest = [](const char* name, const Quotients& ratios) {
    return Measurement{std::string("largest ratio of ") + name, ratios.largest};
  };
  return found(state.least > 1.0 && cost.least > 1.0,
               "with the same number of steps, the state error with imposed steps is {:.0f} to {:.0f} times the error "
               "with variational steps ({} pairs), and the cost error is {:.0f} to {:.0f} times as large ({} pairs)",
               least("state errors", state), largest("state errors", state), state.count, least("cost errors", cost),
               largest("cost errors", cost), cost.count)
      .also(worded("variational steps take {:.1f} to {:.1f} times the operations of a Newton pass and {:.2f} to {:.2f} "
                   "times the variables",
                   least("operations", operations), largest("operations", operations), least("variables", variables),
                   largest("variables", variables)));
}

}  // namespace

Claims step_control_claims() {
  return about(
      simulated, Whose::extension,
      {{.id = "variational_steps_symplectic",
        .where = in_outlook,
        .states = "step sizes that depend on the trajectory keep the extended flow symplectic only if their "
                  "constraint is part of the variational principle",
        .judge = symplectic_by_principle,
        .evidence = {"step_control_symplecticity.csv"}},
       {.id = "steps_by_the_motion_keep_momentum",
        .where = in_outlook,
        .states = "step sizes that are invariant under the group keep the balance of momentum and forces, whether "
                  "or not they are part of the variational principle",
        .judge = momentum_by_every_route,
        .evidence = {"step_control_momentum.csv"}},
       {.id = "variational_steps_energy",
        .where = in_outlook,
        .states = "with variational steps, the energy oscillates; with steps computed beforehand, the energy drifts",
        .judge = energy_by_principle,
        .evidence = {"step_control_energy_behaviour.csv", "figures/step_control.svg"}},
       {.id = "variational_steps_accuracy",
        .where = in_outlook,
        .states = "step sizes that depend on the trajectory give smaller errors as part of the variational "
                  "principle than as an imposed constraint with the same number of steps",
        .judge = accuracy_by_principle,
        .condition = "along Kepler ellipses of eccentricity 0.3 to 0.8, with step sizes from distance or "
                     "acceleration; E_0 is the initial energy",
        .evidence = {"step_control.csv", "step_control_slopes.csv", "step_control_transfer.csv",
                     "figures/step_control.svg"}}});
}

}  // namespace dmocbench
