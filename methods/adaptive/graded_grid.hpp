#pragma once

#include <Eigen/Core>

#include "methods/transcription/motions/grid.hpp"

namespace dmocbench {

/// A grid whose relative widths follow `wished`, one per interval of `grid`.
///
/// No step is more than `largest_ratio` (> 1) times as wide as its neighbour: with the number ξ of a node as a
/// continuous variable, dτ/dξ = s(τ), and |ds/dτ| <= ln(largest_ratio) keeps s(τ(ξ + 1)) <= largest_ratio s(τ(ξ)). The
/// s used is the largest one below the wished widths that keeps this bound, made smaller by a common factor so that the
/// number of intervals is whole. Widths below twice `Grid::narrowest` are raised to that. Throws `Error` if more than
/// Grid::most_intervals are needed, or an entry of `wished` is not positive.
[[nodiscard]] Grid graded_grid(const Grid& grid, const Eigen::VectorXd& wished, double largest_ratio);

/// Widths that spread defects evenly.
struct EvenWidths {
  Eigen::VectorXd widths;  ///< relative, one per interval of the grid on which the defects were
  double asked = 0.0;      ///< how many intervals of equal defect that takes, before any limit
};

/// With defects d_k of order h^(r + 1): w_k (g/d_k)^(1/(r + 1)), where g is such that the sum of all defects falls to
/// `share` of its value, or, if that takes more than `most_intervals`, such that it takes so many. `defects` are >= 0;
/// defects far below the others count as 1e-12 of the largest. No width becomes more than four times as wide or eight
/// times as narrow. Where a defect is infinite all widths are halved.
[[nodiscard]] EvenWidths equidistributed_widths(const Grid& grid, const Eigen::VectorXd& defects, int order,
                                                double share, double most_intervals);

}  // namespace dmocbench
