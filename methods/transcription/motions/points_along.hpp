#pragma once

#include <Eigen/Core>

#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// ∫₀^τ of the Lagrange polynomials of the nodes c, by Gauss quadrature that is exact for their degree; as many entries
/// as c.
[[nodiscard]] Eigen::VectorXd lagrange_integral(const Eigen::VectorXd& c, double tau);

/// Σ_i w_i times row k s + i of a stage table for the intervals k from `first` on, a row for each of `count`; s
/// weights.
[[nodiscard]] Eigen::MatrixXd weighted_stages(const Eigen::MatrixXd& stages, const Eigen::VectorXd& weights,
                                              Eigen::Index first, Eigen::Index count);

/// The elements' polynomials of `count` intervals from `first` on at the share `tau` of each: (q, q̇, u, y, t), a row
/// per interval, as `TracedProblem::table` takes them.
[[nodiscard]] Eigen::MatrixXd points_along(const Trajectory& trajectory, Eigen::Index first, Eigen::Index count,
                                           double tau);

}  // namespace dmocbench
