// The invariants of the discrete flows: momentum (th:discforcNoe, eq:noether_force_d), symplecticity, energy
// ("Conservation of a Modified Energy").
#include <functional>

#include <fmt/format.h>

#include "bench/experiments/invariants/continuous_flow.hpp"
#include "bench/experiments/invariants/energy_tables.hpp"
#include "bench/experiments/invariants/example_systems.hpp"
#include "bench/experiments/invariants/impact_tables.hpp"
#include "bench/experiments/invariants/long_time_energy.hpp"
#include "bench/experiments/invariants/momentum_tables.hpp"
#include "bench/experiments/invariants/simulated_tables.hpp"
#include "bench/run/column.hpp"
#include "bench/run/options.hpp"
#include "bench/run/start_provider.hpp"
#include "bench/run/table_run.hpp"
#include "bench/tables/selection.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/error.hpp"
#include "problems/registry.hpp"

namespace dmocbench::invariants_program {

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
         Columns<Record>{{"order", "", "order of the method", &Record::order, in_key},
                         {"steps_per_period", "", "steps per period", &Record::steps_per_period, in_key}};
}

const Columns<EnergyOfPeriod> period_columns =
    ellipse_columns<EnergyOfPeriod>() + period_energy_columns(&EnergyOfPeriod::energy);

const Columns<EnergyOfPeriods> behaviour_columns =
    ellipse_columns<EnergyOfPeriods>() +
    Columns<EnergyOfPeriods>{{"periods", "", "number of periods", &EnergyOfPeriods::periods, in_key}} +
    energy_behaviour_columns(&EnergyOfPeriods::energy);

const Columns<EnergyOrder> order_columns =
    scheme_columns<EnergyOrder>() +
    Columns<EnergyOrder>{{"quantity", "", "quantity whose order is fitted", &EnergyOrder::quantity, in_key}} +
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

/// The choices of a user.
struct StructureOptions {
  int steps = 400;
  int steps_per_period = 64;
  long long periods = 10000;
  ProblemOptions asked = {};  ///< without problems the examples
};

void add_options(CommandLine& line, StructureOptions& options) {
  line.number("--steps", options.steps, 1, 1000000, "number of steps of the forced examples");
  line.number("--steps-per-period", options.steps_per_period, 16, 100000, "number of steps per period of the orbit");
  line.number("--periods", options.periods, 3, 10000000, "number of periods of the orbit");
  options.asked.add_to(line);
}

/// Rows of each table on a terminal.
constexpr std::size_t most_shown = 5;

/// The largest defect of the symplectic form, by problem and method.
Table largest_defects(const Table& symplecticity) {
  const ColumnNames scheme{"problem", "method"};
  Table largest({"problem", "method", "symplectic defect", "rounding"});
  for (const Selection& group : Selection(symplecticity).group_by(scheme)) {
    Row row = fields_of(group.front(), scheme);
    const Selection measured = group.with_number("defect");
    if (!measured.empty()) {
      row.set("symplectic defect", fmt::format("{:.1e}", measured.max("defect")));
      row.set("rounding", fmt::format("{:.1e}", measured.max("rounding")));
    }
    largest.append(std::move(row));
  }
  return largest;
}

void add_symplecticity(TableRun& run, const std::vector<MappedStates>& systems) {
  const SymplecticityTable symplecticity = symplecticity_table(systems);
  run.add("invariants_symplecticity", symplecticity.table, symplecticity.unsolved);
}

void add_energy_against_work(TableRun& run, const std::vector<std::shared_ptr<const Problem>>& problems) {
  const EnergyWorkTables work = energy_work_tables(problems, TableRun::solver_options());
  run.add("invariants_energy_work", work.plain, work.unsolved);
  run.add("invariants_modified_work", work.modified);
  run.add("invariants_energy_work_slopes", work.orders);
}

void show_findings(TableRun& run) {
  run.summary().show("the defect of the symplectic form", largest_defects(run.table("invariants_symplecticity")), {},
                     "invariants_symplecticity.csv", most_shown);
  run.summary().show("the orders of the gap between energy and work", run.table("invariants_energy_work_slopes"),
                     {"problem", "method", "quantity", "truncation", "slope", "standard_error"},
                     "invariants_energy_work_slopes.csv", most_shown);
}

void add_long_time_energy(TableRun& run, const StructureOptions& options) {
  for (const LongTimeMethod& method : long_time_methods()) {
    const Scheme scheme = on_ellipse(method);
    run.stage(fmt::format("energy {} {} {}", scheme.method, scheme.tableau, scheme.stages), [&] {
      EnergyResults results;
      run.show("energy over many periods: " + method.name);
      follow(method, options.steps_per_period, options.periods, true, results);
      if (method.name == "dmoc") oscillation_over_step(method, results);
      run.add("invariants_energy", period_columns, results.periods);
      run.add("invariants_energy_behaviour", behaviour_columns, results.behaviour);
      run.add("invariants_energy_slopes", order_columns, results.orders);
    });
  }
}

/// Tables of examples that were chosen for their structure.
void add_examples(TableRun& run, const StructureOptions& options) {
  const auto stage = [&run](const std::string& activity, const std::function<void()>& measure) {
    run.stage(activity, [&] {
      run.show(activity);
      measure();
    });
  };
  stage("momentum and the work of forces", [&] { run.add("invariants_momentum", noether_table(options.steps)); });
  stage("the continuous flow", [&] {
    run.add("invariants_flow_momentum", flow_momentum_table());
    run.add("invariants_flow_symplecticity", flow_symplecticity_table(example_states()));
  });
  stage("momentum along trajectories with orthogonal forces",
        [&] { run.add("invariants_orthogonal_forces", orthogonal_forces_table(TableRun::solver_options())); });
  stage("rotations", [&] { run.add("invariants_rotations", rotations_table(options.steps)); });
  stage("the symplectic form", [&] { add_symplecticity(run, example_states()); });
  stage("modified energies", [&] {
    const ModifiedEnergyTables modified = modified_energy_tables();
    run.add("invariants_modified_energy", modified.drifts);
    run.add("invariants_modified_energy_slopes", modified.orders);
  });
  stage("impacts", [&] {
    const ImpactTables tables = impact_tables({16, 32, 64, 128, 256});
    run.add("invariants_impacts", tables.impacts);
    run.add("invariants_impacts_slopes", tables.orders);
  });
  stage("energies and the work of forces", [&] {
    std::vector<std::shared_ptr<const Problem>> problems;
    for (const std::string& name : paper_problem_names()) problems.push_back(make_problem(name));
    add_energy_against_work(run, problems);
  });
  add_long_time_energy(run, options);
}

/// Tables of any problem, along its optimal motions.
void add_problems(TableRun& run, const std::vector<std::shared_ptr<const Problem>>& problems) {
  StartProvider starts({}, TableRun::solver_options());
  for (const auto& problem : problems) {
    run.stage(problem->name(), [&] {
      run.show(problem->name() + ": the symplectic form along an optimal trajectory");
      const Case fine{.problem = problem, .method = "dmoc", .stages = 2, .solver = "ipopt", .grid = Grid::uniform(256)};
      add_symplecticity(run, {states_along(problem, starts.solve(fine))});
      run.show(problem->name() + ": energies and the work of forces");
      add_energy_against_work(run, {problem});
    });
  }
}

int write_tables(CommandLine& line) {
  StructureOptions options;
  add_options(line, options);
  TableRun run("invariants", line, TableRun::Resumes::yes);
  if (!options.asked.problems.empty()) {
    add_problems(run, run.selected(options.asked));
  } else {
    if (!options.asked.settings.empty()) throw Error("--set needs --problem");
    add_examples(run, options);
  }
  show_findings(run);
  return run.write();
}

int run(int argc, char** argv) {
  return run_program(
      "invariants",
      "Measures invariants of the discrete flows on examples. Momentum compared with the work of arbitrary forces: "
      "invariants_momentum.csv, and invariants_rotations.csv for rotations about three axes. Momentum along optimal "
      "trajectories whose forces are orthogonal to the symmetry: invariants_orthogonal_forces.csv. Symplectic form: "
      "invariants_symplecticity.csv. Momentum and symplectic form along the continuous flow: "
      "invariants_flow_momentum.csv and invariants_flow_symplecticity.csv. Energy of an eccentric orbit over many "
      "periods: invariants_energy.csv and invariants_energy_behaviour.csv. Elastic impacts with three conditions on "
      "the impulse: invariants_impacts.csv. Modified energy of the midpoint rule along unforced trajectories: "
      "invariants_modified_energy.csv. Energy and modified energy compared with the work of the forces along the "
      "optimal trajectories of the paper's problems: invariants_energy_work.csv and invariants_modified_work.csv. "
      "--problem replaces the examples: for each problem, the program measures the symplectic form at states of an "
      "optimal trajectory and compares energy and modified energy with the work of the forces.",
      argc, argv, write_tables);
}

}  // namespace dmocbench::invariants_program
