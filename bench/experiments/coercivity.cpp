// Coercivity of the discrete optimum over the number of intervals: the assumption of (main_theorem), section 3.5.
#include <memory>

#include "bench/experiments/smallest_curvature.hpp"
#include "bench/run/column.hpp"
#include "bench/run/options.hpp"
#include "bench/run/start_provider.hpp"
#include "bench/run/table_run.hpp"
#include "methods/transcription/elements/families.hpp"

namespace dmocbench::coercivity_program {

struct Curvature {
  Scheme scheme;
  std::string status;
  long long intervals = 0;
  std::optional<double> smallest = std::nullopt;
};

const Columns<Curvature> columns =
    scheme_columns<Curvature>() +
    Columns<Curvature>{
        {"status", "", "of the solve", &Curvature::status},
        {"intervals", "", "number of intervals N", &Curvature::intervals, in_key},
        {"smallest_curvature", "cost per control^2 and time",
         "largest alpha with d^2 L >= alpha h sum b_i |dU_i|^2; 0 below 1e-9, empty where the form is indefinite",
         &Curvature::smallest}};

int measure_all(CommandLine& line) {
  ProblemOptions asked{
      .problems = {"orbital_transfer", "two_link_manipulator", "double_integrator", "brachistochrone"}};
  asked.add_to(line);
  TableRun run("coercivity", line);
  const SolverOptions options = TableRun::solver_options();
  StartProvider starts({}, options);
  const std::unique_ptr<Solver> solver = make_solver("ipopt", options);
  std::vector<Curvature> rows;
  for (const std::shared_ptr<const Problem>& problem : run.selected(asked)) {
    for (const std::string& method : paper_families()) {
      for (const long long intervals : {16, 32, 64, 128, 256, 512}) {
        const Case the_case{.problem = problem,
                            .method = method,
                            .tableau = "gauss",
                            .solver = "ipopt",
                            .grid = Grid::uniform(intervals)};
        run.show(the_case.label());
        const SolvedCase solved = solve_case(the_case, starts.start_for(the_case), *solver, options.tolerance, 1, true);
        Curvature row{.scheme = {problem->name(), method, "gauss", 1},
                      .status = std::string(name_of(solved.solution.status)),
                      .intervals = intervals};
        if (is_discrete_optimum(solved)) row.smallest = smallest_curvature(*solved.program, solved.solution);
        rows.push_back(row);
      }
    }
  }
  run.add("coercivity", columns, rows);
  return run.write();
}

int run(int argc, char** argv) {
  return run_program(
      "coercivity",
      "The smallest curvature of the Lagrangian along motions that keep the linearised equations, against the square "
      "of the control, over the number of intervals: coercivity.csv. It is bounded below where the optimum is "
      "coercive.",
      argc, argv, measure_all);
}

}  // namespace dmocbench::coercivity_program
