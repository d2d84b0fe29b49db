// The programs of DMOC, multiple and single shooting at one optimum (section 3.3): their sizes, and the condition of
// the linear systems that a solver meets.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/kkt_eigenvalues.hpp"
#include "bench/run/column.hpp"
#include "bench/run/options.hpp"
#include "bench/run/table_run.hpp"
#include "methods/kkt/linearisation.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/single_shooting.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench::shooting_program {

struct Measured {
  Scheme scheme;
  std::string status = {};
  long long intervals = 0;
  std::size_t unknowns = 0;
  std::ptrdiff_t equations = 0;
  std::optional<double> objective = std::nullopt;
  std::optional<double> condition = std::nullopt;
};

const Columns<Measured> columns =
    scheme_columns<Measured>() +
    Columns<Measured>{
        {"status", "", "status of the solve", &Measured::status},
        {"intervals", "", "number of intervals N", &Measured::intervals, in_key},
        {"unknowns", "", "number of variables whose bounds differ", &Measured::unknowns},
        {"equations", "", "number of constraints whose bounds are equal", &Measured::equations},
        {"objective", "cost", "optimal cost of the program", &Measured::objective},
        {"condition", "", "condition number of the equilibrated KKT matrix at the optimum", &Measured::condition}};

class Programs {
 public:
  Programs(const TableRun& run, std::shared_ptr<const Problem> problem)
      : run_(run), problem_(std::move(problem)), motion_(guessed_motion(*problem_)) {}

  /// All three programs; the finest grid first, whose motion the coarser ones start from.
  void measure(long long intervals) {
    const std::unique_ptr<Transcription> dmoc = program_of("dmoc", intervals);
    const Eigen::VectorXd start = sample(*dmoc, motion_);
    const Solution optimum = solve("dmoc", intervals, *dmoc, start);
    if (is_first_ && is_solved(optimum.status)) {
      motion_ = smooth_motion(read_trajectory(*dmoc, optimum.primal, optimum.multipliers));
    }
    is_first_ = false;

    const std::unique_ptr<Transcription> multiple = program_of("multiple_shooting_rk4_1", intervals);
    const Solution nodes = solve("multiple_shooting_rk4_1", intervals, *multiple, sample(*multiple, motion_));
    SingleShooting single(*multiple);
    solve("single_shooting_rk4_1", intervals, single, single.reduced(nodes.primal));
  }
  [[nodiscard]] const std::vector<Measured>& rows() const noexcept { return rows_; }

 private:
  [[nodiscard]] std::unique_ptr<Transcription> program_of(const std::string& method, long long intervals) const {
    return std::make_unique<Transcription>(*problem_, *make_element(method), make_tableau("gauss", 1),
                                           Grid::uniform(intervals));
  }
  Solution solve(const std::string& method, long long intervals, NonlinearProgram& program,
                 const Eigen::VectorXd& start) {
    run_.show(problem_->name() + " " + method + " N = " + std::to_string(intervals));
    Solution solution = solver_->solve(program, start);
    Measured row{.scheme = {problem_->name(), method, "gauss", 1},
                 .status = std::string(name_of(solution.status)),
                 .intervals = intervals,
                 .unknowns = free_variable_count(program),
                 .equations = std::ranges::count(equalities_of(program), true)};
    if (is_solved(solution.status)) {
      row.objective = solution.objective / problem_->cost_scale();
      row.condition = kkt_condition(program, solution);
    }
    rows_.push_back(std::move(row));
    return solution;
  }

  const TableRun& run_;
  std::shared_ptr<const Problem> problem_;
  Motion motion_;
  bool is_first_ = true;
  std::unique_ptr<Solver> solver_ = make_solver("ipopt", TableRun::solver_options());
  std::vector<Measured> rows_;
};

int measure_all(CommandLine& line) {
  ProblemOptions asked{.problems = {"orbital_transfer", "two_link_manipulator", "cart_pole"}};
  asked.add_to(line);
  TableRun run("shooting", line);
  std::vector<Measured> rows;
  for (const std::shared_ptr<const Problem>& problem : run.selected(asked)) {
    Programs programs(run, problem);
    for (const long long intervals : {64, 32, 16}) programs.measure(intervals);
    rows.insert(rows.end(), programs.rows().begin(), programs.rows().end());
  }
  const auto not_measured = std::ranges::count_if(rows, [](const Measured& row) { return !row.condition; });
  run.add("shooting", columns, rows, not_measured);
  return run.write();
}

int run(int argc, char** argv) {
  return run_program("shooting",
                     "Compares the programs of DMOC, multiple shooting and single shooting (rk4, one step per "
                     "interval) at one optimum. shooting.csv has their sizes and the condition numbers of their KKT "
                     "matrices. To measure their reliability from cold starts and their accuracy, run cold_start and "
                     "convergence with --method multiple_shooting,single_shooting.",
                     argc, argv, measure_all);
}

}  // namespace dmocbench::shooting_program
