#include "methods/transcription/motions/points_along.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

Eigen::VectorXd lagrange_integral(const Eigen::VectorXd& c, double tau) {
  static const std::array quadratures{gauss_tableau(1), gauss_tableau(2), gauss_tableau(3)};  // slow to make
  const Tableau& quadrature = quadratures[std::min<std::size_t>(static_cast<std::size_t>(c.size()) / 2, 2)];
  Eigen::VectorXd integral = Eigen::VectorXd::Zero(c.size());
  for (Eigen::Index i = 0; i < quadrature.stages(); ++i) {
    integral += tau * quadrature.b[i] * lagrange_basis(c, tau * quadrature.c[i]);
  }
  return integral;
}

Eigen::MatrixXd weighted_stages(const Eigen::MatrixXd& stages, const Eigen::VectorXd& weights, Eigen::Index first,
                                Eigen::Index count) {
  const Eigen::Index s = weights.size();
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(count, stages.cols());
  for (Eigen::Index i = 0; i < s; ++i) sums += weights[i] * stages(Eigen::seqN(first * s + i, count, s), Eigen::all);
  return sums;
}

Eigen::MatrixXd points_along(const Trajectory& trajectory, Eigen::Index first, Eigen::Index count, double tau) {
  const Eigen::Index n = trajectory.q.cols();
  const Eigen::Index m = trajectory.stage_u.cols();
  const Eigen::Index l = trajectory.y.cols();
  const Eigen::VectorXd basis = lagrange_basis(trajectory.tableau.c, tau);
  const Eigen::VectorXd integral = lagrange_integral(trajectory.tableau.c, tau);
  const Eigen::VectorXd left = trajectory.node_times.segment(first, count);
  const Eigen::VectorXd steps = trajectory.node_times.segment(first + 1, count) - left;
  const auto along = [&](const Eigen::MatrixXd& nodes, const Eigen::MatrixXd& rates) -> Eigen::MatrixXd {
    return nodes.middleRows(first, count) + steps.asDiagonal() * weighted_stages(rates, integral, first, count);
  };
  Eigen::MatrixXd rows(count, 2 * n + m + l + 1);
  rows.leftCols(n) = along(trajectory.q, trajectory.stage_v);
  rows.middleCols(n, n) = weighted_stages(trajectory.stage_v, basis, first, count);
  rows.middleCols(2 * n, m) = weighted_stages(trajectory.stage_u, basis, first, count);
  if (l > 0) rows.middleCols(2 * n + m, l) = along(trajectory.y, trajectory.stage_y_rates);
  rows.rightCols(1) = left + tau * steps;
  return rows;
}

}  // namespace dmocbench
