// Grids that the error chooses: how good the estimate of the error is, and how many intervals it saves.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/experiments/adaptive/effectivity.hpp"
#include "bench/experiments/adaptive/needed_intervals.hpp"
#include "bench/run/options.hpp"
#include "bench/run/table_run.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/start.hpp"

namespace dmocbench::adaptive_program {

/// Alternately slow and fast motions, for which adaptive grids are made.
const std::vector<std::string> uneven{"eccentric_transfer", "hypersensitive"};

/// The paper's, with several minima near the guess.
const std::vector<std::string> with_several_minima{"orbital_transfer", "two_link_manipulator"};

/// The default problems: the paper's, the uneven ones and eight of the library.
const std::vector<std::string> all_problems{"orbital_transfer",  "two_link_manipulator", "eccentric_transfer",
                                            "hypersensitive",    "kepler_cartesian",     "link_chain",
                                            "double_integrator", "forced_oscillator",    "cart_pole",
                                            "planar_quadrotor",  "spherical_pendulum",   "hovercraft"};

bool is_one_of(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

struct Tables {
  std::vector<MeasuredEffectivity> effectivity;
  std::vector<NeededGrid> needed;
  std::vector<StepOfGrid> steps;
};

/// Adapted grids and, on request, uniform grids for the same accuracy.
void compare_grids(const TableRun& run, const CertifiedProblem& certified, bool with_uniform, int rounds,
                   const std::string& solver, Tables& tables) {
  constexpr double accuracy = 1e-8;
  const std::string name = certified.problem().name();
  const SolverOptions options = TableRun::solver_options();
  const bool has_several_minima = is_one_of(with_several_minima, name);
  // Timed solves begin where a user begins.
  const Motion start = has_several_minima ? smooth_motion(certified.motion()) : guessed_motion(certified.problem());
  for (const std::string& method : paper_families()) {
    for (const int stages : {2, 3, 4}) {
      const Scheme scheme{name, method, "gauss", stages};
      run.show(fmt::format("{} {} s = {}, adapted", name, method, stages));
      tables.needed.push_back(needed_adapted(certified, scheme, accuracy, start,
                                             !has_several_minima && method == "dmoc" ? rounds : 0, solver, options,
                                             tables.steps));
      if (!with_uniform) continue;
      run.show(fmt::format("{} {} s = {}, uniform", name, method, stages));
      tables.needed.push_back(needed_uniform(certified, scheme, accuracy, solver, options));
    }
  }
}

void measure_effectivities(const TableRun& run, const CertifiedProblem& certified, const std::string& solver,
                           Tables& tables) {
  for (const std::string& method : paper_families()) {
    for (const int stages : {1, 2}) {
      run.show(fmt::format("{} {} s = {}, effectivity", certified.problem().name(), method, stages));
      const auto rows = measure_effectivity(certified, method, stages, solver, TableRun::solver_options());
      tables.effectivity.insert(tables.effectivity.end(), rows.begin(), rows.end());
    }
  }
}

int measure_all(CommandLine& line) {
  int rounds = 11;
  bool is_quick = false;
  std::string solver = "auto";
  ProblemOptions asked{.problems = all_problems};
  asked.add_to(line);
  line.number("--rounds", rounds, 0, 10000, "number of timed repetitions of the refinement");
  line.option("--solver", solver, "name of a solver; see `dmocbench list`");
  line.flag("--quick", is_quick, "use only the problems with short fast phases, unless --problem names others");
  line.ignored_unless(
      "--quick", [&asked] { return asked.problems == all_problems; }, "--problem already selects the problems");
  TableRun run("adaptive", line, TableRun::Resumes::yes);
  static_cast<void>(make_solver(solver));  // rejects unknown names before anything is solved
  const bool is_named = asked.problems != all_problems;
  for (const std::shared_ptr<const Problem>& problem : run.selected(asked)) {
    const bool is_uneven = is_one_of(uneven, problem->name());
    if (is_quick && !is_named && !is_uneven) continue;
    run.stage(problem->name(), [&] {
      Tables tables;
      run.show(problem->name() + ", certified");
      const CertifiedProblem certified(problem, TableRun::solver_options());
      measure_effectivities(run, certified, solver, tables);
      const bool with_uniform = is_named || is_uneven;
      if (with_uniform || is_one_of(with_several_minima, problem->name()))
        compare_grids(run, certified, with_uniform, rounds, solver, tables);
      run.add("adaptive", needed_columns(), tables.needed);
      run.add("adaptive_effectivity", effectivity_columns(), tables.effectivity);
      run.add("adaptive_steps", step_columns(), tables.steps);
    });
  }
  run.summary().show("intervals for 1e-8", run.table("adaptive"),
                     {"problem", "method", "stages", "grid", "status", "intervals", "true_error", "estimated_error"},
                     "adaptive.csv");
  return run.write();
}

int run(int argc, char** argv) {
  return run_program(
      "adaptive",
      "Adapts grids to an accuracy with an error estimate. adaptive_effectivity.csv compares the estimate with the "
      "true error relative to the indirect solution. adaptive.csv has the number of intervals that adapted and uniform "
      "grids need for an error of 1e-8, and the time of the whole refinement. adaptive_steps.csv has the step sizes.",
      argc, argv, measure_all);
}

}  // namespace dmocbench::adaptive_program
