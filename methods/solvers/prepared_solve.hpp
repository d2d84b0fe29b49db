#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include <Eigen/Core>

#include "methods/judgement/confirm.hpp"
#include "methods/program/counted_program.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// Solves one program again and again: for other values of its parameters, ends, bounds and horizon (which are set on
/// the program between two solves, see `Transcription`), from other starts and multipliers.
///
/// Everything that depends on the structure alone, and all memory, is made once. With `interior_point` nothing is
/// allocated after the first solve, unless a solve needs more than all before it did (a filter with more entries, the
/// sparse factorisation, the descent on the violation, a longer message). A solve does not depend on the ones before
/// it, except for the order of elimination, which is kept as long as its pivots hold. Other solvers keep nothing.
///
/// Every object has memory of its own: several of them, each with a program of its own, may solve in several threads at
/// the same time. (Programs may share a problem, which they only read.) One object must not solve in two threads at
/// once.
class PreparedSolve {
 public:
  /// The judgement of answers.
  enum class Judgement : std::uint8_t {
    confirmed,       ///< as by `Solver::solve`: our residual, and a Newton step from the answer (`Confirmation`)
    residuals_only,  ///< without the Newton step, about one iteration: for warm starts next to an answer that was
                     ///< settled
  };

  /// The program must outlive it. Throws `Error` as `make_solver` does.
  explicit PreparedSolve(NonlinearProgram& program, std::string_view solver = "interior_point",
                         const SolverOptions& options = {}, Judgement judgement = Judgement::confirmed);
  /// The same by an existing solver.
  PreparedSolve(NonlinearProgram& program, std::unique_ptr<Solver> solver, Judgement judgement = Judgement::confirmed);

  /// Solves as `Solver::solve`, from a start (variable_count() entries) and, unless they are empty, multipliers
  /// (constraint_count() entries) and a barrier parameter (`Solution::barrier_parameter` of a neighbour). The solution
  /// is valid until the next call. Throws `Error` if a size is wrong or the parameter is not positive.
  const Solution& solve(const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers = Eigen::VectorXd(),
                        std::optional<double> barrier_parameter = std::nullopt);

  /// The last solution; "not run" before the first.
  [[nodiscard]] const Solution& solution() const noexcept { return solution_; }
  /// The solver of the method.
  [[nodiscard]] const Solver& solver() const noexcept { return *solver_; }
  /// The program that it solves.
  [[nodiscard]] NonlinearProgram& program() const noexcept { return program_; }

 private:
  NonlinearProgram& program_;
  std::unique_ptr<Solver> solver_;
  Judgement judgement_;
  CountedProgram counted_;
  std::unique_ptr<PreparedRun> run_;
  Confirmation confirmation_;
  Solution solution_;
};

}  // namespace dmocbench
