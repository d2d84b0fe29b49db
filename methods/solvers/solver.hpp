#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/solvers/minor_iteration.hpp"

namespace dmocbench {

class CountedProgram;

/// What every solver understands. What only one of our own solvers understands is typed: `SequentialOptions`,
/// `InteriorPointOptions`.
struct SolverOptions {
  /// For the KKT residual of the program as the solver sees it (scaled cost).
  double tolerance = 1e-10;
  int most_iterations = 500;  ///< after which a solve has failed
  /// Wall clock; 0 for no limit. The time of the innermost `StopScope` is a limit too.
  double most_seconds = 0.0;
  /// The solver's own output goes to standard output.
  bool verbose = false;
  /// λ of a program that is nearly the same, one per constraint: a warm start, for solvers that can use it
  /// (`interior_point`). Empty for none.
  Eigen::VectorXd start_multipliers;
  /// μ > 0 to begin with, for solvers that can use it (`interior_point`). None for the solver's own choice. Without
  /// meaning where a program has neither bounds nor inequalities: it has no barrier.
  std::optional<double> start_barrier_parameter;
  /// Options by name, as a command line gives them; they win over what is set otherwise. Ipopt and NLopt get them as
  /// they stand, our own solvers read them into their typed options.
  std::map<std::string, std::string> passed_on;
  /// Asked once per iteration; true ends the solve with status "interrupted".
  std::function<bool()> stop_requested;
  /// Told of every minor iteration by solvers that have them (`sqp`).
  std::function<void(const MinorIteration&)> on_minor_iteration;

  /// Throws `Error` that names the option if one is out of range.
  void validate() const;
};

/// A method at work on one program, with the memory that it uses again from solve to solve (`PreparedSolve`).
class PreparedRun {
 public:
  virtual ~PreparedRun() = default;
  PreparedRun(const PreparedRun&) = delete;
  PreparedRun& operator=(const PreparedRun&) = delete;
  PreparedRun(PreparedRun&&) = delete;
  PreparedRun& operator=(PreparedRun&&) = delete;

  /// As `Solver::run`, from a start and, unless they are empty, multipliers (constraint_count() entries) and a barrier
  /// parameter. Writes all that the method itself knows of a solution; the memory of its vectors is used again.
  virtual void run(const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers,
                   std::optional<double> barrier_parameter, Solution& solution) = 0;

 protected:
  PreparedRun() = default;
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
  ///
  /// The same for every solver: checks the size of the start, counts and times the evaluations, measures the time of
  /// `run`, judges its answer (`judge_infeasibility`, `confirm`) and says in a sentence what happened.
  [[nodiscard]] Solution solve(NonlinearProgram& program, const Eigen::VectorXd& start) const;

  /// As they were given.
  [[nodiscard]] const SolverOptions& options() const noexcept { return options_; }

  /// The method with memory of its own for solving one program again and again; null where a solve leaves nothing that
  /// the next one could use. The solver and the program must outlive it.
  [[nodiscard]] virtual std::unique_ptr<PreparedRun> prepare(CountedProgram& program) const;

 protected:
  /// Throws `Error` if an option is out of range.
  explicit Solver(SolverOptions options);

  /// The method itself. Returns the status by its own judgement, the last point (none if it refuses the program), the
  /// multipliers if it has them, and its counts of iterations; a message only where it can say more than the status.
  [[nodiscard]] virtual Solution run(CountedProgram& program, const Eigen::VectorXd& start) const = 0;

  /// What `run` of another solver returns, for a solver that is made of others.
  [[nodiscard]] static Solution run_of(const Solver& other, CountedProgram& program, const Eigen::VectorXd& start);

 private:
  friend class PreparedSolve;
  /// The limit of time of a solve that begins now: that of the options and of the innermost `StopScope`.
  [[nodiscard]] double seconds_allowed() const;
  /// Adds what was measured, and judges a failure.
  void complete(CountedProgram& counted, Solution& solution) const;

  SolverOptions options_;
};

/// Names of all solvers, the default first.
[[nodiscard]] std::vector<std::string> solver_names();

/// The solver of that name. Throws `Error` that lists the names if there is none, or if an option is out of range.
[[nodiscard]] std::unique_ptr<Solver> make_solver(std::string_view name, const SolverOptions& options = {});

}  // namespace dmocbench
