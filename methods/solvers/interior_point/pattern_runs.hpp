#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::interior_point {

/// Consecutive entries of a sparse pattern that are a stretch of a diagonal, a row or a column.
struct PatternRun {
  Eigen::Index entry;  ///< the first
  Eigen::Index row;
  Eigen::Index column;
  Eigen::Index row_step;  ///< 0 or 1
  Eigen::Index column_step;
  Eigen::Index length;
};

/// The pattern as runs, in its order; few where a program is stored column by column.
[[nodiscard]] std::vector<PatternRun> pattern_runs(const SparsityPattern& pattern);

/// The runs of a program's matrices; to find them takes a pass over both patterns.
struct ProgramRuns {
  explicit ProgramRuns(const NonlinearProgram& program)
      : jacobian(pattern_runs(program.jacobian_structure())), hessian(pattern_runs(program.hessian_structure())) {}

  std::vector<PatternRun> jacobian;
  std::vector<PatternRun> hessian;  ///< of the lower triangle
};

/// The runs of a lower triangle, cut so that only those on the diagonal touch it.
[[nodiscard]] std::vector<PatternRun> cut_at_diagonal(const std::vector<PatternRun>& runs);

}  // namespace dmocbench::interior_point
