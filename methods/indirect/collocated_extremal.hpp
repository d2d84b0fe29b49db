#pragma once

#include <functional>

#include <Eigen/Core>

#include "methods/indirect/pontryagin_function.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

/// A point of an extremal: y = (q, p, ψ_q, ψ_p) and z = (v, u, w) of `PontryaginFunction`, scaled as there.
struct ExtremalPoint {
  Eigen::VectorXd y;  ///< 4n entries
  Eigen::VectorXd z;  ///< 2n + m entries
};

/// An extremal by Gauss collocation on a uniform grid: plain numbers that determine its polynomials.
struct CollocatedExtremal {
  int stages = 0;             ///< s
  double horizon = 0.0;       ///< T
  Eigen::MatrixXd nodes;      ///< y at t_0 to t_N, 4n × (N + 1)
  Eigen::MatrixXd rates;      ///< ẏ at the stages, 4n × N s
  Eigen::MatrixXd algebraic;  ///< z at the stages, (2n + m) × N s
  double cost = 0.0;          ///< ∫ C dt by the method's quadrature, scaled

  /// N.
  [[nodiscard]] Eigen::Index intervals() const noexcept { return nodes.cols() - 1; }
};

/// Gauss-Legendre with any number of stages (order 2s): nodes are zeros of Legendre polynomials.
[[nodiscard]] Tableau high_order_gauss_tableau(int stages);

/// The collocation polynomial at time t: y of uniform order s + 1 (at nodes y_k itself, order 2s), z between stages
/// of order s, good enough to start Newton's method from.
[[nodiscard]] ExtremalPoint point_on(const CollocatedExtremal& extremal, const Tableau& tableau, double t);

/// The largest entry of `difference` relative to the largest of `values` (both with 4n rows), but not to less than
/// 1e-6, because costates of a free motion are 0: the maximum over the upper half of the rows (state) and the lower
/// (costate).
[[nodiscard]] double relative_difference(const Eigen::MatrixXd& difference, const Eigen::MatrixXd& values);

/// Pontryagin's boundary value problem by Gauss collocation with `stages` stages on `intervals` equal intervals:
/// (q, p) fixed at both ends (`first`, `last`, 2n entries each), ψ free. Newton's method on all nodes and rates at
/// once from `start` (called with times in [0, horizon]); the rates of an interval are eliminated first, which leaves a
/// multiple shooting system in the y_k. Throws `Error` if Newton's method does not converge.
[[nodiscard]] CollocatedExtremal collocate_extremal(const PontryaginFunction& function, const Eigen::VectorXd& first,
                                                    const Eigen::VectorXd& last, double horizon, int stages,
                                                    Eigen::Index intervals,
                                                    const std::function<ExtremalPoint(double t)>& start);

}  // namespace dmocbench
