// Coercivity of the discrete optimum over the number of intervals: the assumption of (main_theorem), section 3.5.
#include <memory>

#include "bench/experiments/kkt_eigenvalues.hpp"
#include "bench/run/column.hpp"
#include "bench/run/options.hpp"
#include "bench/run/start_provider.hpp"
#include "bench/run/table_run.hpp"
#include "methods/transcription/elements/families.hpp"

namespace dmocbench::coercivity_program {

struct Curvature {
  Scheme scheme;
  const char* end = "";
  std::string status;
  long long intervals = 0;
  std::optional<double> smallest = std::nullopt;
};

const Columns<Curvature> columns =
    scheme_columns<Curvature>() +
    Columns<Curvature>{
        {"end", "", "variations of the final state: none (fixed, as stated) or free (the paper's space M)",
         &Curvature::end, in_key},
        {"status", "", "status of the solve", &Curvature::status},
        {"intervals", "", "number of intervals N", &Curvature::intervals, in_key},
        {"smallest_curvature", "cost divided by control^2 and time",
         "largest alpha with d^2 L >= alpha h sum b_i |dU_i|^2; negative if the form is indefinite; 0 within 1e-9",
         &Curvature::smallest}};

class Coercivity {
 public:
  explicit Coercivity(const TableRun& run) : run_(run) {}

  /// All methods and grids, at the optimum of the problem as it is stated.
  void measure(const std::shared_ptr<const Problem>& problem) {
    const ProblemBounds bounds = problem->bounds();
    const bool has_fixed_end = bounds.last.all_fixed() && !bounds.horizon.is_free();
    for (const std::string& method : paper_families()) {
      for (const long long intervals : {12, 16, 20, 24, 32, 48, 64, 96, 128, 192, 256, 512}) {
        const Case the_case{.problem = problem, .method = method, .solver = "ipopt", .grid = Grid::uniform(intervals)};
        const Start start = starts_.start_for(the_case);
        run_.show(the_case.label());
        const SolvedCase solved = solve_case(the_case, start, *solver_, options_.tolerance, 1, true);
        append(solved, "stated", EndVariation::stated);
        // The paper's states are (q, p): with v free at T the conditions at the end would not be linear.
        if (has_fixed_end && method != "tangent") append(solved, "free", EndVariation::free);
      }
    }
  }
  [[nodiscard]] const std::vector<Curvature>& rows() const noexcept { return rows_; }

 private:
  void append(const SolvedCase& solved, const char* name_of_end, EndVariation end) {
    Curvature row{.scheme = {solved.the_case.problem->name(), solved.the_case.method, "gauss", 1},
                  .end = name_of_end,
                  .status = std::string(name_of(solved.solution.status)),
                  .intervals = static_cast<long long>(solved.the_case.intervals())};
    if (is_discrete_optimum(solved)) row.smallest = smallest_curvature(*solved.program, solved.solution, end);
    rows_.push_back(row);
  }

  const TableRun& run_;
  SolverOptions options_ = TableRun::solver_options();
  StartProvider starts_{{}, options_};
  std::unique_ptr<Solver> solver_ = make_solver("ipopt", options_);
  std::vector<Curvature> rows_;
};

int measure_all(CommandLine& line) {
  ProblemOptions asked{
      .problems = {"orbital_transfer", "two_link_manipulator", "double_integrator", "brachistochrone"}};
  asked.add_to(line);
  TableRun run("coercivity", line);
  Coercivity coercivity(run);
  for (const std::shared_ptr<const Problem>& problem : run.selected(asked)) coercivity.measure(problem);
  run.add("coercivity", columns, coercivity.rows());
  return run.write();
}

int run(int argc, char** argv) {
  return run_program("coercivity",
                     "Computes the smallest curvature of the Lagrangian along trajectories of the linearised "
                     "equations, relative to the square of the control, for each number of intervals (coercivity.csv). "
                     "This curvature is bounded below by a positive number where the optimum is coercive. If the whole "
                     "final state is fixed, variations that move it (the paper's space M) are measured too.",
                     argc, argv, measure_all);
}

}  // namespace dmocbench::coercivity_program
