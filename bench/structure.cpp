// What the discrete flows preserve: momentum (th:discforcNoe, eq:noether_force_d), symplecticity, energy ("Conservation
// of a Modified Energy").
#include "bench/experiment/column.hpp"
#include "bench/experiment/table_run.hpp"
#include "bench/structure/energy_columns.hpp"
#include "bench/structure/energy_tables.hpp"
#include "bench/structure/example_systems.hpp"
#include "bench/structure/long_time_energy.hpp"
#include "bench/structure/orthogonal_forces.hpp"
#include "bench/structure/rotations.hpp"
#include "bench/structure/simulated_tables.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/transcription/elements/element.hpp"

namespace dmocbench::structure_program {

/// The energy along the unforced ellipse: of one period, or over all of them.
template <class Energy>
struct OnEllipse {
  Scheme scheme;
  int order = 0;
  int steps_per_period = 0;
  long long periods = 0;
  Energy energy;
};
using EnergyOfPeriod = OnEllipse<PeriodEnergy>;
using EnergyOfPeriods = OnEllipse<EnergyBehaviour>;

struct EnergyOrder {
  Scheme scheme;
  const char* quantity = "";
  FittedOrder fit;
};

/// The columns that begin the tables of the unforced ellipse.
template <class Record>
Columns<Record> ellipse_columns() {
  return scheme_columns<Record>() +
         Columns<Record>{{"order", "", "order of the method", &Record::order},
                         {"steps_per_period", "", "steps per period", &Record::steps_per_period}};
}

const Columns<EnergyOfPeriod> period_columns =
    ellipse_columns<EnergyOfPeriod>() + period_energy_columns(&EnergyOfPeriod::energy);

const Columns<EnergyOfPeriods> behaviour_columns =
    ellipse_columns<EnergyOfPeriods>() +
    Columns<EnergyOfPeriods>{{"periods", "", "number of periods", &EnergyOfPeriods::periods}} +
    energy_behaviour_columns(&EnergyOfPeriods::energy);

const Columns<EnergyOrder> order_columns =
    scheme_columns<EnergyOrder>() +
    Columns<EnergyOrder>{{"quantity", "", "what shrinks with the step", &EnergyOrder::quantity}} +
    fitted_order_columns(&EnergyOrder::fit);

struct EnergyResults {
  std::vector<EnergyOfPeriod> periods;
  std::vector<EnergyOfPeriods> behaviour;
  std::vector<EnergyOrder> orders;
};

Scheme on_ellipse(const LongTimeMethod& method) { return {"kepler", method.name, method.tableau, method.stages}; }

EnergyBehaviour follow(const LongTimeMethod& method, int steps_per_period, long long periods, bool with_periods,
                       EnergyResults& results) {
  const Scheme scheme = on_ellipse(method);
  const std::vector<PeriodEnergy> energies = long_time_energy(method, steps_per_period, periods);
  for (const PeriodEnergy& period : energies) {
    if (with_periods) results.periods.push_back({scheme, method.order, steps_per_period, periods, period});
  }
  const EnergyBehaviour behaviour = energy_behaviour(energies);
  results.behaviour.push_back({scheme, method.order, steps_per_period, periods, behaviour});
  return behaviour;
}

/// How the oscillation shrinks with the step: a few periods on ever finer steps.
void oscillation_over_step(const LongTimeMethod& method, EnergyResults& results) {
  constexpr long long few_periods = 20;
  std::vector<GridError> points;
  for (const int steps : {128, 192, 256, 384, 512}) {
    points.push_back({Kepler::period / steps, follow(method, steps, few_periods, false, results).oscillation});
  }
  if (const auto order = fit_order(points)) results.orders.push_back({on_ellipse(method), "oscillation", *order});
}

int write_tables(CommandLine& line) {
  int steps = 400;
  int steps_per_period = 64;
  long long periods = 10000;
  line.number("--steps", steps, 1, 1000000, "steps of the forced maps");
  line.number("--steps-per-period", steps_per_period, 16, 100000, "steps per period of the orbit");
  line.number("--periods", periods, 3, 10000000, "periods of the orbit");
  TableRun run("structure", line);
  run.show("momentum against the work of forces");
  run.add("structure_momentum", noether_table(steps));
  run.show("momentum along motions with orthogonal forces");
  run.add("structure_orthogonal_forces", orthogonal_forces_table(TableRun::solver_options()));
  run.show("rotations");
  run.add("structure_rotations", rotations_table(steps));
  run.show("the symplectic form");
  run.add("structure_symplecticity", symplecticity_table());
  run.show("modified energies");
  const ModifiedEnergyTables modified = modified_energy_tables();
  run.add("structure_modified_energy", modified.drifts);
  run.add("structure_modified_energy_slopes", modified.orders);
  run.show("energies against the work of forces");
  const EnergyWorkTables work = energy_work_tables(TableRun::solver_options());
  run.add("structure_energy_work", work.plain);
  run.add("structure_modified_work", work.modified);
  run.add("structure_energy_work_slopes", work.orders);
  EnergyResults results;
  for (const LongTimeMethod& method : long_time_methods()) {
    run.show("energy over many periods: " + method.name);
    follow(method, steps_per_period, periods, true, results);
    if (method.name == "dmoc") oscillation_over_step(method, results);
  }
  run.add("structure_energy", period_columns, results.periods);
  run.add("structure_energy_behaviour", behaviour_columns, results.behaviour);
  run.add("structure_energy_slopes", order_columns, results.orders);
  return run.write();
}

int run(int argc, char** argv) {
  return run_program(
      "structure",
      "What the discretisation preserves: momentum against the work of arbitrary forces (structure_momentum.csv), "
      "the same for rotations about three axes (structure_rotations.csv), the momentum along optimal motions whose "
      "forces are orthogonal to the symmetry (structure_orthogonal_forces.csv), the symplectic form "
      "(structure_symplecticity.csv), the energy of an eccentric orbit over many periods (structure_energy.csv, "
      "structure_energy_behaviour.csv), the modified energy of the midpoint rule along free motions "
      "(structure_modified_energy.csv), and both against the work of the forces along the optimal motions of the "
      "paper's problems (structure_energy_work.csv, structure_modified_work.csv).",
      argc, argv, write_tables);
}

}  // namespace dmocbench::structure_program
