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

/// result += J x; `values` one per entry of the pattern that the runs were made from.
void add_product(const std::vector<PatternRun>& runs, const Eigen::VectorXd& values, const Eigen::VectorXd& x,
                 Eigen::VectorXd& result);

/// result += Jᵀ multipliers; `values` one per entry of the pattern that the runs were made from.
void add_transposed_product(const std::vector<PatternRun>& runs, const Eigen::VectorXd& values,
                            const Eigen::VectorXd& multipliers, Eigen::VectorXd& result);

/// The runs of a lower triangle, cut so that only those on the diagonal touch it.
[[nodiscard]] std::vector<PatternRun> cut_at_diagonal(const std::vector<PatternRun>& runs);

/// result += H x for a symmetric matrix of which the lower triangle is there, in runs of `cut_at_diagonal`.
void add_symmetric_product(const std::vector<PatternRun>& runs, const Eigen::VectorXd& values, const Eigen::VectorXd& x,
                           Eigen::VectorXd& result);

}  // namespace dmocbench::interior_point
