#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/adaptive/certified_problem.hpp"
#include "bench/run/column.hpp"

namespace dmocbench {

/// An estimated error and the true error.
struct MeasuredEffectivity {
  Scheme scheme;
  std::string grid = {};  ///< "uniform" or "adapted"
  Eigen::Index intervals = 0;
  std::string quantity = {};  ///< state, momentum, costate or objective
  std::string status = {};
  std::optional<double> estimated = std::nullopt;
  std::optional<double> true_error = std::nullopt;
  /// The largest relative error of the answer (`relative_size`).
  std::optional<double> relative = std::nullopt;
  std::string verdict = {};  ///< "measured"; "floor" where the true error is not far above rounding

  /// Estimated error / true error; empty if either is missing or the true error is 0.
  [[nodiscard]] std::optional<double> effectivity() const {
    return estimated && true_error && *true_error > 0.0 ? std::optional(*estimated / *true_error) : std::nullopt;
  }
};

/// All quantities by a method with some stages, on uniform grids and on one adapted to an accuracy of 1e-4 (one
/// stage) or 1e-6. An answer whose intervals do not join (`accuracy`) has the status "too coarse" and no numbers.
[[nodiscard]] std::vector<MeasuredEffectivity> measure_effectivity(const CertifiedProblem& certified,
                                                                   const std::string& method, int stages,
                                                                   const std::string& solver_name,
                                                                   const SolverOptions& options);

/// The columns of the table.
[[nodiscard]] Columns<MeasuredEffectivity> effectivity_columns();

}  // namespace dmocbench
