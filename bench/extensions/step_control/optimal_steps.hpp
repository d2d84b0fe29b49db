#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "bench/extensions/step_control/controlled_steps.hpp"
#include "bench/extensions/step_control/ellipse_transfer.hpp"
#include "methods/extensions/step_control/extended_action.hpp"
#include "methods/indirect/indirect_solution.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

/// Errors of a discrete optimum against the indirect solution.
struct StepsErrors {
  double cost = 0.0;      ///< |J - J*| / J*
  double state = 0.0;     ///< max over the nodes of |q - q*|, each at its own time
  double control = 0.0;   ///< max over the stages of |u - u*|
  double momentum = 0.0;  ///< largest defect of an interval between momentum and work
  double replay = 0.0;    ///< miss of the final state by the replayed control
};

/// One solve of the eccentric transfer by DMOC.
struct OptimalSteps {
  std::string status;
  std::size_t variables = 0;  ///< of the program
  std::optional<StepsErrors> errors = {};
};

/// The eccentric transfer and its certified optimum.
class SteppedTransfer {
 public:
  /// Throws `Error` if the optimum is not found.
  SteppedTransfer(double eccentricity, const SolverOptions& options);

  [[nodiscard]] double cost() const { return optimum_->cost(); }
  [[nodiscard]] double digits() const { return optimum_->certified_digits(); }

  /// DMOC by a Gauss tableau with given numbers of stages and intervals from the optimum: uniform steps, steps
  /// proportional to σ along the optimum (imposed), or as part of the principle (variational).
  [[nodiscard]] OptimalSteps solve(StepPolicy rule, const StepFunction& sigma, int stages, long long intervals) const;

 private:
  [[nodiscard]] OptimalSteps steps_of(const Solution& solution, std::size_t variables,
                                      const std::function<Trajectory()>& read) const;

  std::shared_ptr<const EllipseTransfer> problem_;
  std::unique_ptr<Solver> solver_;
  std::unique_ptr<const IndirectSolution> optimum_;
  Motion motion_;
};

}  // namespace dmocbench
