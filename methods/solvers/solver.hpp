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
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

class Confirmation;
struct Scaling;
class CountedProgram;

/// Options of one solver by name, as a command line gives them. They take precedence over other settings.
using NamedOptions = std::map<std::string, std::string>;

/// A method at work on one program, with the data it reuses from solve to solve (`PreparedSolve`).
class PreparedRun {
 public:
  virtual ~PreparedRun() = default;
  PreparedRun(const PreparedRun&) = delete;
  PreparedRun& operator=(const PreparedRun&) = delete;

  /// The method itself, from checked arguments of `Solver::solve`. Sets its own status, the last iterate (none
  /// if it rejects the program), the multipliers if it has them, and its counts of iterations; a message only where it
  /// adds to the status. The memory of the solution's vectors is used again.
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

  /// snake_case, as on the command line.
  [[nodiscard]] std::string name() const { return name_; }
  /// One line.
  [[nodiscard]] std::string description() const { return description_; }

  /// Solves from `start` (variable_count() entries). Not converging is a status. Throws `Error` on misuse only: a wrong
  /// size, a barrier parameter that is not positive.
  ///
  /// A warm start, for solvers that can use it (`interior_point`, `auto`): `multipliers`, the λ of a program that is
  /// nearly the same, one per constraint, or empty for none, and μ > 0 to begin with, or none for the solver's own
  /// choice. The latter is without meaning where a program has neither bounds nor inequalities: it has no barrier.
  ///
  /// The same for every solver: checks the arguments, counts and times the evaluations, measures the time of
  /// `PreparedRun::run`, judges its answer (`judge_infeasibility`, `Confirmation`) and reports the outcome in a
  /// sentence.
  ///
  /// A stationary point that is not a minimum is left along a direction of negative curvature (`leave_saddle`).
  ///
  /// Where the tolerance does not constrain the cost or a constraint, since it is too small or too large
  /// (`Confirmation::scaling`), the program is solved again with both times powers of two, and the message reports it.
  /// Counts and times belong to the second solve, the limit of time holds for both.
  ///
  /// Where the multipliers are huge, or the solve failed, and conditions of the ends depend on each other there
  /// (`dependent_rows`), it is solved again without the redundant ones; a solution of that replaces the first one if it
  /// satisfies these, too.
  [[nodiscard]] Solution solve(NonlinearProgram& program, const Eigen::VectorXd& start,
                               const Eigen::VectorXd& multipliers = Eigen::VectorXd(),
                               std::optional<double> barrier_parameter = std::nullopt) const;

  /// The options as given.
  [[nodiscard]] const SolverOptions& options() const noexcept { return options_; }

  /// The method for solving one program again and again, with memory of its own. The solver and the program must
  /// outlive it.
  [[nodiscard]] virtual std::unique_ptr<PreparedRun> prepare(CountedProgram& program) const = 0;

 protected:
  /// Throws `Error` if an option is out of range.
  Solver(std::string name, std::string description, SolverOptions options);

 private:
  friend class PreparedSolve;
  /// Arguments of `solve`.
  struct WarmStart {
    const Eigen::VectorXd& primal;
    const Eigen::VectorXd& multipliers;
    std::optional<double> barrier_parameter;
  };
  /// The limit of time of a solve that begins now: the smaller of the options' and the innermost `StopScope`'s.
  [[nodiscard]] double seconds_allowed() const;
  /// Applies the limits of the solve to computations outside its iterations.
  [[nodiscard]] StopScope scope(const CountedProgram& counted) const;
  /// Throws `Error` that names the argument that does not fit the program.
  static void check(const NonlinearProgram& program, const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers,
                    std::optional<double> barrier_parameter);
  /// A run and its judgement (`complete`). Where the scope ends work outside of iterations, such as the descent on the
  /// violation, the answer is the last point, or the start, with the status "time limit" or "interrupted".
  Scaling run_within_limits(CountedProgram& counted, PreparedRun& run, const WarmStart& start,
                            Confirmation& confirmation, bool asks_newton, Solution& solution) const;
  /// Adds the measurements, judges the answer (`Confirmation::judge`) and sets the message. Returns
  /// `Confirmation::scaling`; where the cost needs a factor, the answer is not confirmed.
  Scaling complete(CountedProgram& counted, const Eigen::VectorXd& start, Confirmation& confirmation, bool asks_newton,
                   Solution& solution) const;
  /// `solve` with all constraints. `may_depend`: whether huge multipliers, or the failure, may be due to dependent
  /// ones.
  Solution solve_as_stated(NonlinearProgram& program, const WarmStart& start, double seconds, bool& may_depend) const;
  /// The same, continued from a saddle point (`leave_saddle`). Returns as `complete`.
  Scaling run_and_judge(CountedProgram& counted, PreparedRun& run, const WarmStart& start, Confirmation& confirmation,
                        bool asks_newton, Solution& solution) const;

  std::string name_;
  std::string description_;
  SolverOptions options_;
};

/// A solver that keeps no state between solves and does not support warm starts.
class SolverWithoutMemory : public Solver {
 public:
  [[nodiscard]] std::unique_ptr<PreparedRun> prepare(CountedProgram& program) const final;

 protected:
  using Solver::Solver;

  /// The result of `PreparedRun::run`.
  [[nodiscard]] virtual Solution run(CountedProgram& program, const Eigen::VectorXd& start) const = 0;
};

/// Names of all solvers, the default first.
[[nodiscard]] std::vector<std::string> solver_names();

/// The solver with that name. Ipopt and NLopt get the named options as they stand; our own solvers get typed options
/// made from them. Throws `Error` that lists the names if it is unknown, or if an option is out of range or not the
/// solver's.
[[nodiscard]] std::unique_ptr<Solver> make_solver(std::string_view name, const SolverOptions& options = {},
                                                  const NamedOptions& named = {});

}  // namespace dmocbench
