#pragma once

#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// Ipopt, an interior-point method with a filter line search, on our exact sparse derivatives.
///
/// Our settings: the tolerance as given, nlp_scaling_method none, bound_relax_factor 0, sb yes (no banner). Anything
/// else is Ipopt's default or one of its own options, by name.
///
/// Ipopt and MUMPS have global state: solves of several threads wait for each other (`Solver`).
class IpoptSolver final : public SolverWithoutMemory {
 public:
  /// Throws `Error` if Ipopt does not take one of the named options.
  explicit IpoptSolver(SolverOptions options, NamedOptions named = {});

 private:
  [[nodiscard]] Solution run(CountedProgram& program, const Eigen::VectorXd& start) const override;

  [[nodiscard]] Solution run_ipopt(CountedProgram& program, const Eigen::VectorXd& start) const;

  NamedOptions named_;
};

}  // namespace dmocbench
