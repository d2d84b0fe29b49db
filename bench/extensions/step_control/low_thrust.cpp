// Transfers by low thrust over many revolutions (section 4.2.1 of the paper with a long horizon): the cost of few steps
// per revolution.
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/extensions/step_control/reference_transfer.hpp"
#include "bench/run/column.hpp"
#include "bench/run/options.hpp"
#include "bench/run/solve_case.hpp"
#include "bench/run/table_run.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/trajectory_error.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/elements/shooting_element.hpp"

namespace dmocbench::low_thrust_program {

/// The errors of one solve.
struct TransferErrors {
  double cost = 0.0;      ///< |J - J_ref| / J_ref
  double state = 0.0;     ///< max over the nodes of |q - q_ref|
  double control = 0.0;   ///< max over the stages of |u - u_ref|
  double momentum = 0.0;  ///< largest defect of an interval between momentum and work
  double balance = 0.0;   ///< the same over the whole horizon
};

struct Measured {
  Scheme scheme;
  int revolutions = 0;
  int steps = 0;  ///< per revolution
  double h = 0.0;
  std::string status;
  std::string branch;
  std::optional<int> iterations = std::nullopt;
  std::string reference;
  double digits = 0.0;
  std::optional<double> objective = std::nullopt;
  std::optional<TransferErrors> errors = std::nullopt;
  std::optional<double> replay_error = std::nullopt;
};

constexpr auto errors = &Measured::errors;
const Columns<Measured> columns =
    scheme_columns<Measured>() +
    Columns<Measured>{
        {"revolutions", "", "number of revolutions d", &Measured::revolutions, in_key},
        {"steps_per_revolution", "", "N/d", &Measured::steps, in_key},
        {"intervals", "", "number of intervals N", [](const Measured& m) { return m.revolutions * m.steps; }},
        {"h", "", "step size", &Measured::h},
        {"status", "", "status of the solve", &Measured::status},
        {"branch", "", "same (as the reference) or other", &Measured::branch},
        {"iterations", "", "number of iterations of interior_point", &Measured::iterations},
        {"objective", "", "cost J", &Measured::objective},
        {"reference", "", "reference of the errors: the indirect solution, or a fine grid on which two methods agree",
         &Measured::reference},
        {"reference_digits", "", "number of digits on which two routes to the reference agree", &Measured::digits},
        {"cost_error", "", "|J - J_ref| / J_ref", from(errors, &TransferErrors::cost)},
        {"state_error", "", "max over the nodes of |q - q_ref|", from(errors, &TransferErrors::state)},
        {"control_error", "", "max over the stages of |u - u_ref|", from(errors, &TransferErrors::control)},
        {"momentum_defect", "",
         "largest difference between the change of angular momentum and the work of the thrust over an interval",
         from(errors, &TransferErrors::momentum)},
        {"momentum_balance", "", "change of angular momentum minus the work of the thrust, over the horizon",
         from(errors, &TransferErrors::balance)},
        {"replay_error", "", "distance between the end of the replay and the final state", &Measured::replay_error}};

struct Reference {
  std::string problem;
  int revolutions = 0;
  std::string kind;
  double digits = 0.0;
  double cost = 0.0;
};
const Columns<Reference> reference_columns{
    {"problem", "", "name of the problem", &Reference::problem, in_key},
    {"revolutions", "", "number of revolutions d", &Reference::revolutions, in_key},
    {"reference", "", "indirect solution, or a fine grid on which two methods agree", &Reference::kind},
    {"digits", "", "number of digits on which two routes agree", &Reference::digits},
    {"cost", "cost", "J", &Reference::cost}};

std::vector<std::string> families() {
  std::vector<std::string> names = paper_families();
  for (const char* integrator : {"midpoint", "rk4"}) {
    names.push_back(shooting_name(shooting_family(Shooting::multiple), integrator, 1));
  }
  return names;
}

TransferErrors errors_of(const ReferenceTransfer& reference, const Trajectory& trajectory) {
  const TrajectoryError error = trajectory_error(trajectory, reference.like(trajectory));
  const MomentumConsistency momentum = momentum_consistency(*reference.problem(), trajectory);
  return {.cost = std::abs(trajectory.cost / reference.cost() - 1.0),
          .state = error.state,
          .control = error.control,
          .momentum = momentum.largest,
          .balance = momentum.total};
}

Measured measured(const ReferenceTransfer& reference, const std::string& method, int revolutions, int steps,
                  const Solver& solver) {
  const Case the_case{.problem = reference.problem(),
                      .method = method,
                      .stages = 1,
                      .solver = "interior_point",
                      .grid = Grid::uniform(static_cast<long long>(revolutions) * steps)};
  const Start start{.motion = reference.motion(), .branch = reference.motion()};
  SolvedCase solved = solve_case(the_case, start, solver, solver.options().tolerance, 1, true);
  Measured row{.scheme = {reference.problem()->name(), method, "gauss", 1},
               .revolutions = revolutions,
               .steps = steps,
               .h = reference.problem()->horizon() / static_cast<double>(the_case.intervals()),
               .status = std::string(name_of(solved.solution.status)),
               .branch = solved.branch,
               .iterations = solved.solution.major_iterations,
               .reference = reference.kind(),
               .digits = reference.digits()};
  if (!solved.trajectory || !is_discrete_optimum(solved)) return row;
  row.objective = solved.trajectory->cost;
  row.errors = errors_of(reference, *solved.trajectory);
  if (const auto replayed = replay(solved)) row.replay_error = replayed->norm();
  return row;
}

std::vector<int> whole_numbers(const char* option, const std::string& text) {
  const std::vector<long long> parsed = parse_intervals(option, text);
  remark(remark_on_ranges(option, text));
  return {parsed.begin(), parsed.end()};
}

int measure_all(CommandLine& line) {
  std::vector<std::string> problems{"orbital_transfer"};
  std::string revolutions_text = "10,20";
  std::string steps_text = "8,12,16,24,32";
  line.list("--problem", problems, "orbital_transfer (polar coordinates), or kepler_cartesian (Cartesian)");
  line.option("--revolutions", revolutions_text, "numbers of revolutions, such as 10,20,50 or 10:160");
  line.option("--steps", steps_text, "numbers of steps per revolution, such as 8,16 or 8:32");
  TableRun run("low_thrust", line);
  const std::vector<int> all_revolutions = whole_numbers("--revolutions", revolutions_text);
  const std::vector<int> all_steps = whole_numbers("--steps", steps_text);
  const SolverOptions options = TableRun::solver_options();
  const std::unique_ptr<Solver> solver = make_solver("interior_point", options);
  std::vector<Measured> rows;
  std::vector<Reference> references;
  for (const std::string& problem : problems) {
    for (const int revolutions : all_revolutions) {
      run.show(fmt::format("{} with {} revolutions: the optimum", problem, revolutions));
      const ReferenceTransfer reference(problem, revolutions, options);
      references.push_back({problem, revolutions, reference.kind(), reference.digits(), reference.cost()});
      for (const std::string& method : families()) {
        for (const int steps : all_steps) {
          run.show(fmt::format("{} with {} revolutions: {}, {} steps in each", problem, revolutions, method, steps));
          rows.push_back(measured(reference, method, revolutions, steps, *solver));
        }
      }
    }
  }
  run.add("low_thrust", columns, rows);
  run.add("low_thrust_reference", reference_columns, references);
  return run.write();
}

int run(int argc, char** argv) {
  return run_program(
      "low_thrust",
      "Solves the orbital transfer with many revolutions, few steps per revolution and one Gauss stage. Measures the "
      "errors of cost, state and control compared with a certified optimum, the momentum compared with the work of the "
      "thrust, and the replay of the controls (low_thrust.csv; optima in low_thrust_reference.csv).",
      argc, argv, measure_all);
}

}  // namespace dmocbench::low_thrust_program
