#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/adaptive/certified_problem.hpp"
#include "bench/run/column.hpp"

namespace dmocbench {

/// The grid on which a method reaches an accuracy.
struct NeededGrid {
  Scheme scheme;
  std::string grid = {};  ///< "uniform" or "adapted"
  double accuracy = 0.0;
  std::string status = {};  ///< of the last solve, or why there is no such grid
  std::optional<Eigen::Index> intervals = std::nullopt;
  std::optional<std::size_t> variables = std::nullopt;
  std::optional<double> true_error = std::nullopt;       ///< relative, against the certified optimum
  std::optional<double> estimated_error = std::nullopt;  ///< relative
  std::optional<double> largest_step = std::nullopt;
  std::optional<double> smallest_step = std::nullopt;
  std::optional<std::size_t> grids = std::nullopt;  ///< on the way, this one included
  std::vector<double> rounds = {};                  ///< [s] of the whole refinement, repeated
  int order = 0;                                    ///< of the method
  /// Variables at exactly this accuracy, by the order of the method from the true error.
  [[nodiscard]] std::optional<double> variables_at_accuracy() const;
};

/// A node of an adapted grid, for figures.
struct StepOfGrid {
  Scheme scheme;
  double t = 0.0;
  double step = 0.0;    ///< of the interval that begins there
  double motion = 0.0;  ///< the first component of q, over its largest value
};

/// Adapts from `start` to an accuracy, `rounds` times from the first grid on, by a solver (`make_solver`).
[[nodiscard]] NeededGrid needed_adapted(const CertifiedProblem& certified, const Scheme& scheme, double accuracy,
                                        const Motion& start, int rounds, const std::string& solver,
                                        const SolverOptions& options, std::vector<StepOfGrid>& steps);

/// The smallest uniform grid, to 2 %, whose true error is at most the accuracy: solves begin at the optimum, and
/// numbers of intervals follow from the order. Grids with more than 6000 intervals are not tried.
[[nodiscard]] NeededGrid needed_uniform(const CertifiedProblem& certified, const Scheme& scheme, double accuracy,
                                        const std::string& solver_name, const SolverOptions& options);

// The columns of their tables.
[[nodiscard]] Columns<NeededGrid> needed_columns();
[[nodiscard]] Columns<StepOfGrid> step_columns();

}  // namespace dmocbench
