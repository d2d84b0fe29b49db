// Coercivity of the discrete optimum over the number of intervals: the assumption of (main_theorem), section 3.5.
#include <memory>
#include <utility>

#include "bench/experiments/kkt_eigenvalues.hpp"
#include "bench/run/column.hpp"
#include "bench/run/options.hpp"
#include "bench/run/restated_problem.hpp"
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
        {"end", "", "final state: fixed as stated, or free with its distance in the cost, as in the paper",
         &Curvature::end, in_key},
        {"status", "", "status of the solve", &Curvature::status},
        {"intervals", "", "number of intervals N", &Curvature::intervals, in_key},
        {"smallest_curvature", "cost per control^2 and time",
         "largest alpha with d^2 L >= alpha h sum b_i |dU_i|^2; 0 below 1e-9, empty where the form is indefinite",
         &Curvature::smallest}};

class Coercivity {
 public:
  explicit Coercivity(const TableRun& run) : run_(run) {}

  /// All methods and grids; solves of a restated problem start where `base` does.
  void measure(const std::shared_ptr<const Problem>& base, const std::shared_ptr<const Problem>& problem,
               const char* end) {
    for (const std::string& method : paper_families()) {
      for (const long long intervals : {16, 32, 64, 128, 256, 512}) {
        Case the_case{
            .problem = base, .method = method, .tableau = "gauss", .solver = "ipopt", .grid = Grid::uniform(intervals)};
        Start start = starts_.start_for(the_case);
        if (problem != base) start = Start{std::move(start.motion)};
        the_case.problem = problem;
        run_.show(the_case.label());
        const SolvedCase solved = solve_case(the_case, start, *solver_, options_.tolerance, 1, true);
        Curvature row{.scheme = {problem->name(), method, "gauss", 1},
                      .end = end,
                      .status = std::string(name_of(solved.solution.status)),
                      .intervals = intervals};
        if (is_discrete_optimum(solved)) row.smallest = smallest_curvature(*solved.program, solved.solution);
        rows_.push_back(row);
      }
    }
  }
  [[nodiscard]] const std::vector<Curvature>& rows() const noexcept { return rows_; }

 private:
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
  for (const std::shared_ptr<const Problem>& problem : run.selected(asked)) {
    coercivity.measure(problem, problem, "stated");
    const ProblemBounds bounds = problem->bounds();
    if (!bounds.last.all_fixed() || bounds.horizon.is_free()) continue;
    // As in `smoothness`, in the units of the scaled cost.
    const RestatedProblem::Changes changes{.final_weight = 100.0 / problem->cost_scale()};
    coercivity.measure(problem, std::make_shared<RestatedProblem>(problem, changes), "free");
  }
  run.add("coercivity", columns, coercivity.rows());
  return run.write();
}

int run(int argc, char** argv) {
  return run_program("coercivity",
                     "Computes the smallest curvature of the Lagrangian along trajectories of the linearised "
                     "equations, relative to the square of the control, for each number of intervals (coercivity.csv). "
                     "It is bounded below where the optimum is coercive. If the whole final state is fixed, the "
                     "problem with a free final state and its distance in the cost is measured too.",
                     argc, argv, measure_all);
}

}  // namespace dmocbench::coercivity_program
