#pragma once

#include <functional>
#include <string_view>

namespace dmocbench {

/// One iteration of a solver.
struct Iteration {
  std::string_view solver;    ///< as `make_solver` takes it
  int number = 0;             ///< from 1 on; SLSQP counts the points of which it needs derivatives
  double objective = 0.0;     ///< φ, as the solver sees it (scaled)
  double violation = 0.0;     ///< largest violation of a constraint, as the solver measures it
  double stationarity = 0.0;  ///< largest entry of the gradient of the Lagrangian, as the solver measures it
};

/// As long as it exists, solvers that run in this thread report each iteration to `watch`. A watch that wants a solve
/// to end makes `SolverOptions::stop_requested` true.
class IterationScope {
 public:
  /// Takes the place of the scope around, until it is destroyed. An empty `watch` gets no reports.
  explicit IterationScope(std::function<void(const Iteration&)> watch);
  /// Passes reports on to the scope around, with the objective divided by the factor that the solver sees in addition.
  explicit IterationScope(double factor_of_objective);
  ~IterationScope();
  IterationScope(const IterationScope&) = delete;
  IterationScope& operator=(const IterationScope&) = delete;

 private:
  friend bool iterations_are_watched() noexcept;
  friend void report_iteration(const Iteration& iteration);
  std::function<void(const Iteration&)> watch_;
  const IterationScope* outer_;
};

/// Whether iterations of this thread are reported; without, what is computed for reports alone may be left out.
[[nodiscard]] bool iterations_are_watched() noexcept;
/// Reports to the innermost scope of this thread, if there is one.
void report_iteration(const Iteration& iteration);

}  // namespace dmocbench
