#include "methods/solvers/auto/auto_solver.hpp"

#include <array>
#include <optional>
#include <utility>

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

/// Both methods; the program of each is the same.
class AutoRun final : public PreparedRun {
 public:
  AutoRun(const Solver& first, const Solver& second, CountedProgram& program)
      : names_{first.name(), second.name()}, first_(first.prepare(program)), second_(second.prepare(program)) {}

  void run(const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers, std::optional<double> barrier_parameter,
           Solution& solution) override {
    solution = {};
    first_->run(start, multipliers, barrier_parameter, solution);
    solution.solver = names_[0];
    if (!leaves_hope(solution.status)) return;
    const bool has_point = solution.primal.size() == start.size() && solution.primal.allFinite();
    const Solution first = std::exchange(solution, {});
    second_->run(has_point ? first.primal : start, {}, std::nullopt, solution);
    solution.solver = names_[1];
    solution.major_iterations = first.major_iterations.value_or(0) + solution.major_iterations.value_or(0);
  }

 private:
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
    : Solver(options), first_(options, std::move(choices.interior_point)), second_(options, std::move(choices.ipopt)) {}

std::string AutoSolver::description() const { return "interior_point and, where that fails, ipopt from its point"; }

std::unique_ptr<PreparedRun> AutoSolver::prepare(CountedProgram& program) const {
  return std::make_unique<AutoRun>(first_, second_, program);
}

}  // namespace dmocbench
