// Structure: momentum (th:discforcNoe, eq:noether_force_d), symplecticity, energy ("Conservation of a Modified
// Energy").
#include <fmt/format.h>

#include "bench/experiment/column.hpp"
#include "bench/experiment/experiment.hpp"
#include "bench/experiment/metadata.hpp"
#include "bench/experiment/process_pool.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/structure/energy_tables.hpp"
#include "bench/structure/example_systems.hpp"
#include "bench/structure/long_time_energy.hpp"
#include "bench/structure/orthogonal_forces.hpp"
#include "bench/structure/rotations.hpp"
#include "bench/structure/simulated_tables.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/transcription/element.hpp"
#include "problems/registry.hpp"

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
    ellipse_columns<EnergyOfPeriod>() +
    Columns<EnergyOfPeriod>{
        {"period", "", "number of the period, from 0", from(&EnergyOfPeriod::energy, &PeriodEnergy::period)},
        {"energy_smallest", "", "smallest error of the energy", from(&EnergyOfPeriod::energy, &PeriodEnergy::smallest)},
        {"energy_mean", "", "mean error over the period", from(&EnergyOfPeriod::energy, &PeriodEnergy::mean)},
        {"energy_largest", "", "largest error of the energy", from(&EnergyOfPeriod::energy, &PeriodEnergy::largest)}};

constexpr auto orbit_energy = &EnergyOfPeriods::energy;
const Columns<EnergyOfPeriods> behaviour_columns =
    ellipse_columns<EnergyOfPeriods>() +
    Columns<EnergyOfPeriods>{
        {"periods", "", "number of periods", &EnergyOfPeriods::periods},
        {"oscillation", "", "max - min over the first ten periods", from(orbit_energy, &EnergyBehaviour::oscillation)},
        {"range", "", "max - min over all watched periods", from(orbit_energy, &EnergyBehaviour::range)},
        {"drift_per_period", "", "of the mean, by least squares",
         from(orbit_energy, &EnergyBehaviour::drift_per_period)},
        {"standard_error", "", "of the drift", from(orbit_energy, &EnergyBehaviour::standard_error)},
        {"change", "", "last mean minus first mean", from(orbit_energy, &EnergyBehaviour::change)}};

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
  std::filesystem::path out = "results";
  int steps = 400;
  int steps_per_period = 64;
  long long periods = 10000;
  line.option("--out", out, "folder for the results");
  line.number("--steps", steps, 1, 1000000, "steps of the forced maps");
  line.number("--steps-per-period", steps_per_period, 16, 100000, "steps per period of the orbit");
  line.number("--periods", periods, 3, 10000000, "periods of the orbit");
  const std::vector<std::string> command_line = line.parse();
  listen_for_interrupt();
  const OutputFolder folder(out);
  const ResultLock lock(out / "structure");
  const Table momentum = noether_table(steps);
  const Table symplecticity = symplecticity_table();
  EnergyResults results;
  for (const LongTimeMethod& method : long_time_methods()) {
    follow(method, steps_per_period, periods, true, results);
    if (method.name == "dmoc") oscillation_over_step(method, results);
  }
  SolverOptions options;
  options.stop_requested = interrupt_requested;
  const ModifiedEnergyTables modified = modified_energy_tables();
  const Table rotations = rotations_table(steps);
  const Table orthogonal = orthogonal_forces_table(options);
  const EnergyWorkTables work = energy_work_tables(options);
  std::vector<std::filesystem::path> files;
  const auto write = [&](const std::string& name, const Table& table) {
    const std::filesystem::path file = files.emplace_back(out / (name + ".csv"));
    write_file(file, table.csv());
    fmt::print("structure: {} rows: {}\n", table.rows().size(), file.string());
  };
  write("structure_momentum", momentum);
  write("structure_orthogonal_forces", orthogonal);
  write("structure_rotations", rotations);
  write("structure_symplecticity", symplecticity);
  write("structure_modified_energy", modified.drifts);
  write("structure_modified_energy_slopes", modified.slopes);
  write("structure_energy_work", work.plain);
  write("structure_modified_work", work.modified);
  write("structure_energy_work_slopes", work.slopes);
  write("structure_energy", table_of(period_columns, results.periods));
  write("structure_energy_behaviour", table_of(behaviour_columns, results.behaviour));
  write("structure_energy_slopes", table_of(order_columns, results.orders));
  write_complete_run(out / "structure.json", command_line, files);
  return 0;
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
