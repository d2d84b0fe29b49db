#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "methods/program/status.hpp"
#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// The contents of the file STUB.sol that a solver writes.
struct AmplSolution {
  std::string message;     ///< the solver's message, as one line
  Eigen::VectorXd primal;  ///< empty if the solver has no point
  /// Multipliers λ of φ + λᵀa. AMPL's dual of a row is the derivative of the optimum by its bound, hence -λ. Empty if
  /// the solver wrote none.
  Eigen::VectorXd multipliers;
  Eigen::Index variable_count = 0;  ///< of the program that was solved
  /// Rows of the program that was solved, according to the file.
  Eigen::Index constraint_count = 0;
  int code = 0;  ///< AMPL's solve_result_num
  /// The solver's status by that code: 0 solved, 100 acceptable, 200 infeasible, 300 diverged, 400 iteration limit,
  /// 500 solver error, each with the 99 above it.
  [[nodiscard]] Status status() const noexcept;
};

/// Reads the text of a .sol file. Throws `Error` with the reason if it is not one: binary, cut off, a number that
/// is not a number, sizes that contradict each other. Lines after `objno` (suffixes) are not read.
[[nodiscard]] AmplSolution read_ampl_solution(std::string_view text);

/// The answer of a solver that read a .nl file, in place of a solve of our own: it is judged as every answer is
/// (`Solver::solve`).
///
/// The other solver's status is kept unless our residual contradicts it. Multipliers that it did not write are
/// estimated. Some solvers write multipliers with the opposite of the sign that AMPL prescribes; the sign with the
/// smaller residual is taken.
class AmplAnswer final : public SolverWithoutMemory {
 public:
  /// Returns this answer for every program.
  explicit AmplAnswer(AmplSolution answer, SolverOptions options = {});

  /// Throws `Error` if the answer is not one of a program of that size.
  void require_fit(const NonlinearProgram& program) const;

 protected:
  [[nodiscard]] Solution run(CountedProgram& program, const Eigen::VectorXd& start) const override;

 private:
  AmplSolution answer_;
};

}  // namespace dmocbench
