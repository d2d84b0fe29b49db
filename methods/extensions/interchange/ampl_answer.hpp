#pragma once

#include "methods/extensions/interchange/ampl_solution.hpp"
#include "methods/solvers/solver.hpp"

namespace dmocbench {

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

  [[nodiscard]] std::string name() const override { return "ampl"; }
  [[nodiscard]] std::string description() const override { return "the answer of another solver, from its .sol file"; }

  /// Throws `Error` if the answer is not one of a program of that size.
  void require_fit(const NonlinearProgram& program) const;

 protected:
  [[nodiscard]] Solution run(CountedProgram& program, const Eigen::VectorXd& start) const override;

 private:
  AmplSolution answer_;
};

}  // namespace dmocbench
