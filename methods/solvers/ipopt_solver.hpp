#pragma once

#include <string>

#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// Ipopt, an interior-point method with a filter line search, on our exact sparse derivatives.
///
/// Our settings: the tolerance as given, nlp_scaling_method none, bound_relax_factor 0, sb yes (no banner). Anything
/// else is Ipopt's default or comes by `SolverOptions::passed_on`.
class IpoptSolver final : public Solver {
 public:
  /// Throws `Error` if Ipopt does not take one of the options passed on to it.
  explicit IpoptSolver(SolverOptions options);
  [[nodiscard]] std::string name() const override { return "ipopt"; }
  [[nodiscard]] std::string description() const override;

 private:
  [[nodiscard]] Solution run(CountedProgram& program, const Eigen::VectorXd& start) const override;
};

}  // namespace dmocbench
