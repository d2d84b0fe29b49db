#include "methods/solvers/auto/auto_solver.hpp"

#include <array>
#include <optional>
#include <utility>

#include "methods/judgement/flat_rows.hpp"
#include "methods/judgement/least_violation.hpp"
#include "methods/program/counted_program.hpp"

namespace dmocbench {

namespace {

/// True if another method may do better.
bool leaves_hope(Status status) {
  switch (status) {
    case Status::solved:
    case Status::time_limit:
    case Status::interrupted:
    case Status::out_of_memory:
      return false;
    default:
      return true;
  }
}

/// Both solvers; the program of each is the same.
class AutoRun final : public PreparedRun {
 public:
  AutoRun(const Solver& first, const Solver& second, CountedProgram& program)
      : program_(program),
        options_(first.options()),
        names_{first.name(), second.name()},
        first_(first.prepare(program)),
        second_(second.prepare(program)) {}

  void run(const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers, std::optional<double> barrier_parameter,
           Solution& solution) override {
    solution = {};
    first_->run(start, multipliers, barrier_parameter, solution);
    solution.solver = names_[0];
    if (!leaves_hope(solution.status)) return;
    const bool has_point = solution.primal.size() == start.size() && solution.primal.allFinite();
    continue_with(1, has_point ? Eigen::VectorXd(solution.primal) : start, solution);
    solution.failed_before = "interior_point failed; ipopt continued from the last point.";
    if (!has_point || !leaves_hope(solution.status)) return;
    const Eigen::VectorXd moved = moved_off_flat_rows(program_.uncounted(), start);
    if (moved.size() > 0) {
      continue_with(0, moved, solution);
      solution.failed_before =
          "interior_point and ipopt failed; interior_point restarted near the guess, where derivatives of a violated "
          "path constraint vanish.";
      if (!leaves_hope(solution.status)) return;
    }
    const Eigen::VectorXd feasible = feasible_point(program_, options_, start);
    if (feasible.size() == 0) return;
    continue_with(0, feasible, solution);
    solution.failed_before =
        "interior_point and ipopt failed; interior_point restarted at a trajectory that satisfies the constraints.";
  }

 private:
  /// Replaces the solution by the one of a method from another point; iterations add up.
  void continue_with(std::size_t method, const Eigen::VectorXd& start, Solution& solution) {
    const int before = solution.major_iterations.value_or(0);
    solution = {};
    (method == 0 ? first_ : second_)->run(start, {}, std::nullopt, solution);
    solution.solver = names_[method];
    solution.major_iterations = before + solution.major_iterations.value_or(0);
  }

  const CountedProgram& program_;
  const SolverOptions& options_;
  std::array<std::string, 2> names_;
  std::unique_ptr<PreparedRun> first_;
  std::unique_ptr<PreparedRun> second_;
};

}  // namespace

AutoOptions auto_options(const NamedOptions& named) {
  auto [of_interior_point, others] = interior_point_options_among(named);
  return {.interior_point = std::move(of_interior_point), .ipopt = std::move(others)};
}

AutoSolver::AutoSolver(const SolverOptions& options, AutoOptions choices)
    : Solver("auto", "interior_point, then ipopt from the last point, then interior_point from a feasible trajectory",
             options),
      first_(options, std::move(choices.interior_point)),
      second_(options, std::move(choices.ipopt)) {}

std::unique_ptr<PreparedRun> AutoSolver::prepare(CountedProgram& program) const {
  return std::make_unique<AutoRun>(first_, second_, program);
}

}  // namespace dmocbench
