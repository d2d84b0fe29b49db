#pragma once

#include <memory>

#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "methods/solvers/ipopt_solver.hpp"
#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// The choices of a user of `AutoSolver`.
struct AutoOptions {
  InteriorPointOptions interior_point;  ///< of the first method
  NamedOptions ipopt;                   ///< of the second
};

/// The options from their names: options of `interior_point` (`interior_point_options`) go there, all others to Ipopt.
/// Throws `Error` as that does.
[[nodiscard]] AutoOptions auto_options(const NamedOptions& named);

/// `interior_point` first and, where that fails, Ipopt from the point where it ended (from the start where it has
/// none, as where it rejects the program). Where both fail, `interior_point` again: next to the start, if derivatives
/// of constraints vanish there (`moved_off_flat_rows`), then from a motion that meets the constraints, if descent on
/// their violation alone finds one (`feasible_point`). `Solution::solver` names the solver whose answer it is, and
/// `Solution::failed_before` the attempts before it.
///
/// Counts and times include all attempts: evaluations, seconds, major iterations. The limit of time holds for all of
/// them together, the limit of iterations for each. Linear systems are counted where `interior_point` gives the answer.
class AutoSolver final : public Solver {
 public:
  /// Throws `Error` if Ipopt does not take one of the named options.
  explicit AutoSolver(const SolverOptions& options, AutoOptions choices = {});
  [[nodiscard]] std::unique_ptr<PreparedRun> prepare(CountedProgram& program) const override;

 private:
  InteriorPointSolver first_;
  IpoptSolver second_;
};

}  // namespace dmocbench
