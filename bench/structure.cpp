// Structure: momentum (th:discforcNoe, eq:noether_force_d), symplecticity, energy ("Conservation of a Modified
// Energy").
#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "bench/experiment/experiment.hpp"
#include "bench/experiment/metadata.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/experiment/start_provider.hpp"
#include "bench/structure/example_systems.hpp"
#include "bench/structure/long_time_energy.hpp"
#include "bench/structure/simulated_tables.hpp"
#include "methods/diagnostics/convergence_order.hpp"
#include "methods/diagnostics/energy_balance.hpp"
#include "methods/error.hpp"
#include "methods/transcription/element.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

namespace {

Row row_of(const LongTimeMethod& method, int steps_per_period) {
  Row row;
  row.set("problem", Kepler().name());
  row.set("method", method.name);
  row.set("tableau", method.tableau);
  row.set("stages", static_cast<long long>(method.stages));
  row.set("order", static_cast<long long>(method.order));
  row.set("steps_per_period", static_cast<long long>(steps_per_period));
  return row;
}

struct EnergyTables {
  Table periods{{"problem", "method", "tableau", "stages", "order", "steps_per_period", "period", "energy_smallest",
                 "energy_mean", "energy_largest"}};
  Table behaviour{{"problem", "method", "tableau", "stages", "order", "steps_per_period", "periods", "oscillation",
                   "range", "drift_per_period", "standard_error", "change"}};
  Table slopes{{"problem", "method", "tableau", "stages", "quantity", "slope", "standard_error", "finest", "coarsest",
                "points"}};
};

EnergyBehaviour follow(const LongTimeMethod& method, int steps_per_period, long long periods, bool with_periods,
                       EnergyTables& tables) {
  const std::vector<PeriodEnergy> energies = long_time_energy(method, steps_per_period, periods);
  for (const PeriodEnergy& period : energies) {
    if (!with_periods) break;
    Row row = row_of(method, steps_per_period);
    row.set("period", period.period);
    row.set("energy_smallest", period.smallest);
    row.set("energy_mean", period.mean);
    row.set("energy_largest", period.largest);
    tables.periods.append(std::move(row));
  }
  const EnergyBehaviour behaviour = energy_behaviour(energies);
  Row row = row_of(method, steps_per_period);
  row.set("periods", periods);
  row.set("oscillation", behaviour.oscillation);
  row.set("range", behaviour.range);
  row.set("drift_per_period", behaviour.drift_per_period);
  row.set("standard_error", behaviour.standard_error);
  row.set("change", behaviour.change);
  tables.behaviour.append(std::move(row));
  return behaviour;
}

/// `curve` names problem, method, tableau and stages.
void append_slope(Row curve, const char* quantity, const std::vector<GridError>& points, Table& slopes) {
  const auto order = fit_order(points);
  if (!order) return;
  curve.set("quantity", quantity);
  curve.set("slope", order->slope);
  curve.set("standard_error", order->standard_error);
  curve.set("finest", order->finest);
  curve.set("coarsest", order->coarsest);
  curve.set("points", static_cast<long long>(order->points));
  slopes.append(std::move(curve));
}

/// How the oscillation shrinks with the step: a few periods on ever finer steps.
void oscillation_over_step(const LongTimeMethod& method, EnergyTables& tables) {
  constexpr long long few_periods = 20;
  std::vector<GridError> points;
  for (const int steps : {128, 192, 256, 384, 512}) {
    points.push_back({Kepler::period / steps, follow(method, steps, few_periods, false, tables).oscillation});
  }
  append_slope(row_of(method, 0), "oscillation", points, tables.slopes);
}

EnergyTables energy_tables(int steps_per_period, long long periods) {
  EnergyTables tables;
  for (const LongTimeMethod& method : long_time_methods()) {
    follow(method, steps_per_period, periods, true, tables);
    if (method.name == "dmoc") oscillation_over_step(method, tables);
  }
  return tables;
}

/// Energy change against the work of the thrust along the optimal transfer, for all methods; the slopes of their gap go
/// to `slopes`.
Table transfer_table(Table& slopes) {
  Table table({"problem", "method", "tableau", "stages", "intervals", "h", "energy_change", "work", "gap",
               "largest_gap", "largest_work"});
  const std::shared_ptr<const Problem> problem = make_problem("orbital_transfer");
  StartProvider starts("common", {});
  for (const std::string& method : element_names()) {
    Row curve;
    std::vector<GridError> points;
    for (const long long intervals : {32, 64, 128, 256}) {
      const Case what{problem, method, "gauss", 1, "ipopt", "tape", Grid::uniform(intervals), ""};
      const SolvedCase solved = solve_case(what, {starts.motion_for(what), starts.branch_for(what)}, {}, 1);
      if (!solved.trajectory || !is_usable(solved.row)) throw Error("the orbital transfer could not be solved");
      const EnergyBalance balance = energy_balance(*problem, *solved.trajectory);
      Row row;
      row.set("problem", problem->name());
      row.set("method", method);
      row.set("tableau", what.tableau);
      row.set("stages", static_cast<long long>(what.stages));
      row.set("intervals", intervals);
      row.set("h", problem->horizon() / static_cast<double>(intervals));
      row.set("energy_change", balance.change);
      row.set("work", balance.work);
      row.set("gap", balance.change - balance.work);
      row.set("largest_gap", balance.largest_gap);
      row.set("largest_work", balance.largest_work);
      curve = row;
      points.push_back({problem->horizon() / static_cast<double>(intervals), balance.largest_gap});
      table.append(std::move(row));
    }
    append_slope(std::move(curve), "transfer_gap", points, slopes);
  }
  return table;
}

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) try {
  using namespace dmocbench;  // NOLINT(google-build-using-namespace): the whole program is ours
  CommandLine line(
      "What the discretisation preserves: momentum against the work of arbitrary forces (structure_momentum.csv), the "
      "symplectic form (structure_symplecticity.csv), the energy of an eccentric orbit over many periods "
      "(structure_energy.csv, structure_energy_behaviour.csv) and along the optimal orbital transfer "
      "(structure_transfer.csv).",
      "structure");
  std::filesystem::path out = "results";
  int steps = 400;
  int steps_per_period = 64;
  long long periods = 10000;
  line.option("--out", out, "folder for the results").shows_default();
  line.option("--steps", steps, "steps of the forced maps").range(1, 1000000).shows_default();
  line.option("--steps-per-period", steps_per_period, "steps per period of the orbit").range(8, 100000).shows_default();
  line.option("--periods", periods, "periods of the orbit").range(3LL, 10000000LL).shows_default();
  return run_program(line, argc, argv, [&] {
    prepare_folder(out);
    const auto write = [&](const std::string& name, const Table& table) {
      write_file(out / (name + ".csv"), table.csv());
      fmt::print("structure: {} rows: {}\n", table.rows().size(), (out / (name + ".csv")).string());
    };
    write("structure_momentum", noether_table(steps));
    write("structure_symplecticity", symplecticity_table());
    EnergyTables energy = energy_tables(steps_per_period, periods);
    write("structure_transfer", transfer_table(energy.slopes));
    write("structure_energy", energy.periods);
    write("structure_energy_behaviour", energy.behaviour);
    write("structure_energy_slopes", energy.slopes);
    write_complete_run(out / "structure.json", std::vector<std::string>(argv, argv + argc));
    return 0;
  });
} catch (const std::exception& error) {  // what is set up before run_program can guard it
  std::fputs(error.what(), stderr);
  return 2;
}
