#pragma once

#include <functional>

namespace dmocbench {

/// Options of every solver. Further options of our own solvers are typed: `SequentialOptions`,
/// `InteriorPointOptions`. Ipopt and NLopt take `NamedOptions`.
struct SolverOptions {
  /// Tolerance on the KKT residual of the program as solved (scaled cost).
  double tolerance = 1e-10;
  int most_iterations = 500;  ///< after which a solve has failed
  /// Wall clock; 0 for no limit. The time of the innermost `StopScope` is a limit too.
  double most_seconds = 0.0;
  /// The solver's own output goes to standard output.
  bool verbose = false;
  /// Called once per iteration; true ends the solve with status "interrupted".
  std::function<bool()> stop_requested;

  /// Throws `Error` that names the option if one is out of range.
  void validate() const;
};

}  // namespace dmocbench
