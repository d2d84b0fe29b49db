#pragma once

#include <string>

#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "methods/solvers/ipopt_solver.hpp"
#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// `interior_point` first and, where that fails, Ipopt from the point where it ended (from the start where it has
/// none, as where it refuses the program). `Solution::solver` names the one whose answer it is.
///
/// Counts and times are those of both together: evaluations, seconds, major iterations. The limit of time holds for
/// both together, that of iterations for each. Linear systems are told where `interior_point` gives the answer.
///
/// Options passed on: "factorisation" goes to `interior_point`, all others to Ipopt.
class AutoSolver final : public Solver {
 public:
  /// Throws `Error` on an option passed on that neither takes.
  explicit AutoSolver(const SolverOptions& options);
  [[nodiscard]] std::string name() const override { return "auto"; }
  [[nodiscard]] std::string description() const override;

 private:
  [[nodiscard]] Solution run(CountedProgram& program, const Eigen::VectorXd& start) const override;

  InteriorPointSolver first_;
  IpoptSolver second_;
};

}  // namespace dmocbench
