#pragma once

#include <string>

#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// Our interior-point method, whose linear systems are solved interval by interval; see interior_point/README.md.
///
/// Options of its own (`SolverOptions::passed_on`): "factorisation" = "intervals" (the default; a program whose
/// structure does not allow it is refused), "banded" (LAPACK's LU with exchanges of rows, for any program with an
/// interval structure) or "sparse" (MUMPS, for any program).
class InteriorPointSolver final : public Solver {
 public:
  explicit InteriorPointSolver(SolverOptions options = {});

  [[nodiscard]] std::string name() const override { return "interior_point"; }
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] Solution solve(NonlinearProgram& program, const Eigen::VectorXd& start) const override;

 private:
  SolverOptions options_;
};

}  // namespace dmocbench
