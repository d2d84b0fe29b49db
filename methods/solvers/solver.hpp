#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/solvers/minor_iteration.hpp"

namespace dmocbench {

/// What every solver understands.
struct SolverOptions {
  /// For the KKT residual of the program as the solver sees it (scaled cost).
  double tolerance = 1e-10;
  int most_iterations = 500;
  /// Wall clock; 0 for no limit.
  double most_seconds = 0.0;
  /// The solver's own output goes to standard output.
  bool verbose = false;
  /// λ of a program that is nearly the same, one per row: a warm start, for solvers that can use it (`interior_point`).
  /// Empty for none.
  Eigen::VectorXd start_multipliers;
  /// Options passed to the solver as they stand, by their names there; they win over what we set.
  std::map<std::string, std::string> passed_on;
  /// Asked once per iteration; true ends the solve with status "interrupted".
  std::function<bool()> stop_requested;
  /// Told of every minor iteration by solvers that have them (`sqp`).
  std::function<void(const MinorIteration&)> on_minor_iteration;

  /// Throws `Error` that names the option if one is out of range.
  void validate() const;
};

/// A method for nonlinear programs.
class Solver {
 public:
  virtual ~Solver() = default;
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  Solver(Solver&&) = delete;
  Solver& operator=(Solver&&) = delete;

  /// snake_case, as on the command line.
  [[nodiscard]] virtual std::string name() const = 0;
  /// One line.
  [[nodiscard]] virtual std::string description() const = 0;

  /// Solves from `start` (variable_count() entries). Not converging is a status. Throws `Error` on misuse only: a wrong
  /// size, an option the solver does not know.
  [[nodiscard]] virtual Solution solve(NonlinearProgram& program, const Eigen::VectorXd& start) const = 0;

 protected:
  Solver() = default;
};

/// Throws `Error` unless `start` has variable_count() entries.
void require_start(const NonlinearProgram& program, const Eigen::VectorXd& start);

/// Names of all solvers, the default first.
[[nodiscard]] std::vector<std::string> solver_names();

/// The solver of that name. Throws `Error` that lists the names if there is none, or if an option is out of range.
[[nodiscard]] std::unique_ptr<Solver> make_solver(std::string_view name, const SolverOptions& options = {});

}  // namespace dmocbench
