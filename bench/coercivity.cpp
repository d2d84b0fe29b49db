// Coercivity of the discrete optimum over the number of intervals: the assumption behind (main_theorem), section 3.5.
#include <memory>

#include <fmt/format.h>

#include "bench/coercivity/smallest_curvature.hpp"
#include "bench/experiment/column.hpp"
#include "bench/experiment/experiment.hpp"
#include "bench/experiment/metadata.hpp"
#include "bench/experiment/process_pool.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/experiment/start_provider.hpp"
#include "methods/transcription/element.hpp"
#include "problems/registry.hpp"

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
        {"intervals", "", "number of intervals N", &Curvature::intervals},
        {"smallest_curvature", "cost per control^2 and time",
         "largest alpha with d^2 L >= alpha h sum b_i |dU_i|^2; 0 below 1e-9, empty where the form is indefinite",
         &Curvature::smallest}};

int measure_all(CommandLine& line) {
  std::filesystem::path out = "results";
  line.option("--out", out, "folder for the results");
  const std::vector<std::string> command_line = line.parse();
  listen_for_interrupt();
  const OutputFolder folder(out);
  const ResultLock lock(out / "coercivity");
  SolverOptions options;
  options.stop_requested = interrupt_requested;
  StartProvider starts({}, options);
  const std::unique_ptr<Solver> solver = make_solver("ipopt", options);
  std::vector<Curvature> rows;
  for (const char* name : {"orbital_transfer", "two_link_manipulator", "double_integrator", "brachistochrone"}) {
    const std::shared_ptr<const Problem> problem = make_problem(name);
    for (const std::string& method : element_names()) {
      for (const long long intervals : {16, 32, 64, 128, 256, 512}) {
        throw_if_interrupted();
        const Case the_case{.problem = problem,
                            .method = method,
                            .tableau = "gauss",
                            .solver = "ipopt",
                            .grid = Grid::uniform(intervals)};
        const SolvedCase solved = solve_case(the_case, starts.start_for(the_case), *solver, options.tolerance, 1, true);
        Curvature row{.scheme = {name, method, "gauss", 1},
                      .status = std::string(name_of(solved.solution.status)),
                      .intervals = intervals};
        if (is_discrete_optimum(solved)) row.smallest = smallest_curvature(*solved.program, solved.solution);
        rows.push_back(row);
      }
    }
  }
  const std::filesystem::path file = out / "coercivity.csv";
  write_file(file, table_of(columns, rows).csv());
  write_complete_run(out / "coercivity.json", command_line, {file});
  fmt::print("coercivity: {} rows: {}\n", rows.size(), file.string());
  return 0;
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
