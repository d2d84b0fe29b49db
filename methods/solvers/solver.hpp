#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/program/solver_options.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

class Confirmation;
class CountedProgram;

/// Options of one solver by name, as a command line gives them. They win over what is set otherwise.
using NamedOptions = std::map<std::string, std::string>;

/// A method at work on one program, with what it uses again from solve to solve (`PreparedSolve`).
class PreparedRun {
 public:
  virtual ~PreparedRun() = default;
  PreparedRun(const PreparedRun&) = delete;
  PreparedRun& operator=(const PreparedRun&) = delete;
  PreparedRun(PreparedRun&&) = delete;
  PreparedRun& operator=(PreparedRun&&) = delete;

  /// The method itself, from what `Solver::solve` has checked. Writes its own word for the status, the last point (none
  /// if it refuses the program), the multipliers if it has them, and its counts of iterations; a message only where it
  /// can say more than the status. The memory of the solution's vectors is used again.
  virtual void run(const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers,
                   std::optional<double> barrier_parameter, Solution& solution) = 0;

 protected:
  PreparedRun() = default;
};

/// A method for nonlinear programs.
///
/// Threads may solve at the same time, each its own program. Solves by `ipopt` and `sqp` wait for each other, as MUMPS
/// has global state; so does `auto` where it goes to Ipopt. That wait counts for the limit of time and heeds stop
/// requests, and so do single factorisations by MUMPS, as where an answer is confirmed.
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
  /// size, a barrier parameter that is not positive.
  ///
  /// A warm start, for solvers that can use it (`interior_point`, `auto`): `multipliers`, the λ of a program that is
  /// nearly the same, one per constraint, or empty for none, and μ > 0 to begin with, or none for the solver's own
  /// choice. The latter is without meaning where a program has neither bounds nor inequalities: it has no barrier.
  ///
  /// The same for every solver: checks what is given, counts and times the evaluations, measures the time of
  /// `PreparedRun::run`, judges its answer (`judge_infeasibility`, `Confirmation`) and says in a sentence what
  /// happened.
  ///
  /// Where the cost is so small that the tolerance says nothing of it (`Confirmation::factor_of_cost`), it is solved
  /// once more with the cost times that factor, and the message says so. Counts and times are those of the second
  /// solve, the limit of time holds for both.
  [[nodiscard]] Solution solve(NonlinearProgram& program, const Eigen::VectorXd& start,
                               const Eigen::VectorXd& multipliers = Eigen::VectorXd(),
                               std::optional<double> barrier_parameter = std::nullopt) const;

  /// As they were given.
  [[nodiscard]] const SolverOptions& options() const noexcept { return options_; }

  /// The method for solving one program again and again, with memory of its own. The solver and the program must
  /// outlive it.
  [[nodiscard]] virtual std::unique_ptr<PreparedRun> prepare(CountedProgram& program) const = 0;

 protected:
  /// Throws `Error` if an option is out of range.
  explicit Solver(SolverOptions options);

 private:
  friend class PreparedSolve;
  /// The limit of time of a solve that begins now: that of the options and of the innermost `StopScope`.
  [[nodiscard]] double seconds_allowed() const;
  /// Ends what a solve computes outside of its iterations with the limits of the solve.
  [[nodiscard]] StopScope scope(const CountedProgram& counted) const;
  /// Throws `Error` that names what does not fit the program.
  static void check(const NonlinearProgram& program, const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers,
                    std::optional<double> barrier_parameter);
  /// Adds what was measured, judges the answer (`Confirmation::judge`) and says what happened. Returns
  /// `Confirmation::factor_of_cost`; where that is not 1, the answer is not confirmed.
  double complete(CountedProgram& counted, const Eigen::VectorXd& start, Confirmation& confirmation, bool asks_newton,
                  Solution& solution) const;

  SolverOptions options_;
};

/// A solver of which nothing is left after a solve that the next one could use, and that takes no warm start.
class SolverWithoutMemory : public Solver {
 public:
  [[nodiscard]] std::unique_ptr<PreparedRun> prepare(CountedProgram& program) const final;

 protected:
  using Solver::Solver;

  /// What `PreparedRun::run` writes.
  [[nodiscard]] virtual Solution run(CountedProgram& program, const Eigen::VectorXd& start) const = 0;
};

/// Names of all solvers, the default first.
[[nodiscard]] std::vector<std::string> solver_names();

/// The solver of that name. Ipopt and NLopt get the named options as they stand; of those of our own solvers typed ones
/// are made. Throws `Error` that lists the names if there is none, or if an option is out of range or not the solver's.
[[nodiscard]] std::unique_ptr<Solver> make_solver(std::string_view name, const SolverOptions& options = {},
                                                  const NamedOptions& named = {});

}  // namespace dmocbench
