#include "methods/indirect/collocated_extremal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/SparseLU>

#include "methods/error.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

namespace {

/// Newton's method for one grid.
class NewtonOnGrid {
 public:
  NewtonOnGrid(const PontryaginFunction& function, CollocatedExtremal& extremal)
      : function_(function),
        extremal_(extremal),
        tableau_(high_order_gauss_tableau(extremal.stages)),
        size_(function.state_size()),
        step_(extremal.horizon / static_cast<double>(extremal.intervals())),
        responses_(static_cast<std::size_t>(extremal.intervals())) {}

  /// One step; returns the largest correction of a node, relative to the largest state and costate.
  double step() {
    const Eigen::Index intervals = extremal_.intervals();
    const Eigen::Index unknowns = size_ * (intervals + 1);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right_hand_side = Eigen::VectorXd::Zero(unknowns);
    const Eigen::Index half = size_ / 2;
    for (Eigen::Index i = 0; i < half; ++i) {
      entries.emplace_back(i, i, 1.0);
      entries.emplace_back(half + i, intervals * size_ + i, 1.0);
    }
    for (Eigen::Index k = 0; k < intervals; ++k) {
      const Eigen::MatrixXd& response = responses_[static_cast<std::size_t>(k)] = linearised(k);
      Eigen::MatrixXd transition = Eigen::MatrixXd::Identity(size_, size_ + 1);
      transition.col(size_) = extremal_.nodes.col(k) - extremal_.nodes.col(k + 1);
      for (Eigen::Index i = 0; i < tableau_.stages(); ++i) {
        const double weight = step_ * tableau_.b[i];
        transition += weight * response.middleRows(i * size_, size_);
        transition.col(size_) += weight * extremal_.rates.col(k * tableau_.stages() + i);
      }
      const Eigen::Index row = size_ * (k + 1);
      right_hand_side.segment(row, size_) = transition.col(size_);
      for (Eigen::Index i = 0; i < size_; ++i) {
        entries.emplace_back(row + i, row + i, 1.0);
        for (Eigen::Index j = 0; j < size_; ++j) {
          entries.emplace_back(row + i, size_ * k + j, -transition(i, j));
        }
      }
    }
    Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
    if (factors.info() != Eigen::Success) {
      throw Error("the boundary value problem is singular at the initial guess; start from a finer direct solution");
    }
    const Eigen::VectorXd solution = factors.solve(right_hand_side);
    return correct(solution.reshaped(size_, intervals + 1));
  }

  /// The cost by quadrature, and the check that H_u = 0 is a minimum (Legendre's condition).
  void finish() {
    extremal_.cost = 0.0;
    for (Eigen::Index k = 0; k < extremal_.intervals(); ++k) {
      for (Eigen::Index i = 0; i < tableau_.stages(); ++i) {
        const PontryaginFunction::Values values = stage_values(k, i);
        extremal_.cost += step_ * tableau_.b[i] * values.running_cost;
        if (function_.control_size() == 0) continue;
        if (!is_positive_definite(values.control_hessian)) {
          throw Error(
              "H_u = 0 does not minimise the Hamiltonian: H_uu is not positive definite along the solution; the "
              "indirect method needs a running cost that is strictly convex in the control");
        }
      }
    }
  }

 private:
  PontryaginFunction::Values stage_values(Eigen::Index k, Eigen::Index i) {
    const Eigen::Index s = tableau_.stages();
    const Eigen::VectorXd y =
        extremal_.nodes.col(k) + step_ * (extremal_.rates.middleCols(k * s, s) * tableau_.a.row(i).transpose());
    const double t = step_ * (static_cast<double>(k) + tableau_.c[i]);
    Eigen::VectorXd z = extremal_.algebraic.col(k * s + i);
    PontryaginFunction::Values values = function_.evaluate(y, t, z);
    extremal_.algebraic.col(k * s + i) = z;
    return values;
  }

  /// The change of the rates of interval k with its left node, 4n s × (4n + 1); the last column is their correction at
  /// a fixed node.
  Eigen::MatrixXd linearised(Eigen::Index k) {
    const Eigen::Index s = tableau_.stages();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(s * size_, s * size_);
    Eigen::MatrixXd right_hand_sides(s * size_, size_ + 1);
    for (Eigen::Index i = 0; i < s; ++i) {
      const PontryaginFunction::Values values = stage_values(k, i);
      for (Eigen::Index j = 0; j < s; ++j) {
        matrix.block(i * size_, j * size_, size_, size_) -= step_ * tableau_.a(i, j) * values.rate_jacobian;
      }
      right_hand_sides.block(i * size_, 0, size_, size_) = values.rate_jacobian;
      right_hand_sides.block(i * size_, size_, size_, 1) = values.rate - extremal_.rates.col(k * s + i);
    }
    return solve_square(matrix, right_hand_sides);
  }

  double correct(const Eigen::MatrixXd& correction) {
    const Eigen::Index s = tableau_.stages();
    const double change = relative_difference(correction, extremal_.nodes);
    for (Eigen::Index k = 0; k < extremal_.intervals(); ++k) {
      const Eigen::MatrixXd& response = responses_[static_cast<std::size_t>(k)];
      const Eigen::VectorXd rates = response.leftCols(size_) * correction.col(k) + response.col(size_);
      extremal_.rates.middleCols(k * s, s) += rates.reshaped(size_, s);
    }
    extremal_.nodes += correction;
    return change;
  }

  const PontryaginFunction& function_;
  CollocatedExtremal& extremal_;
  Tableau tableau_;
  Eigen::Index size_;
  double step_;
  std::vector<Eigen::MatrixXd> responses_;
};

}  // namespace

double relative_difference(const Eigen::MatrixXd& difference, const Eigen::MatrixXd& values) {
  constexpr double vanishing = 1e-6;
  const Eigen::Index half = values.rows() / 2;
  const auto relative = [&](const auto& part, const auto& whole) {
    return part.template lpNorm<Eigen::Infinity>() / std::max(vanishing, whole.template lpNorm<Eigen::Infinity>());
  };
  return std::max(relative(difference.topRows(half), values.topRows(half)),
                  relative(difference.bottomRows(half), values.bottomRows(half)));
}

Tableau high_order_gauss_tableau(int stages) { return collocation_tableau("gauss", gauss_nodes(stages), 2 * stages); }

ExtremalPoint point_on(const CollocatedExtremal& extremal, const Tableau& tableau, double t) {
  const Eigen::Index intervals = extremal.intervals();
  const Eigen::Index s = tableau.stages();
  const double relative = std::clamp(t / extremal.horizon, 0.0, 1.0) * static_cast<double>(intervals);
  const Eigen::Index k = std::min(static_cast<Eigen::Index>(relative), intervals - 1);
  const double tau = relative - static_cast<double>(k);
  const double step = extremal.horizon / static_cast<double>(intervals);
  // s Gauss points integrate the Lagrange polynomials, of degree s - 1, exactly.
  Eigen::VectorXd integrals = Eigen::VectorXd::Zero(s);
  for (Eigen::Index i = 0; i < s; ++i) integrals += tau * tableau.b[i] * lagrange_basis(tableau.c, tau * tableau.c[i]);
  ExtremalPoint point;
  point.y = extremal.nodes.col(k) + step * (extremal.rates.middleCols(k * s, s) * integrals);
  if (tau == 1.0) point.y = extremal.nodes.col(k + 1);
  point.z = extremal.algebraic.middleCols(k * s, s) * lagrange_basis(tableau.c, tau);
  return point;
}

CollocatedExtremal collocate_extremal(const PontryaginFunction& function, const Eigen::VectorXd& first,
                                      const Eigen::VectorXd& last, double horizon, int stages, Eigen::Index intervals,
                                      const std::function<ExtremalPoint(double t)>& start) {
  constexpr int most_steps = 30;
  constexpr double rounding = 1e-14;
  constexpr double nearly = 1e-8;
  const Tableau tableau = high_order_gauss_tableau(stages);
  const double step = horizon / static_cast<double>(intervals);
  CollocatedExtremal extremal;
  extremal.stages = stages;
  extremal.horizon = horizon;
  extremal.nodes.resize(function.state_size(), intervals + 1);
  extremal.rates.resize(function.state_size(), intervals * stages);
  extremal.algebraic.resize(function.algebraic_size(), intervals * stages);
  for (Eigen::Index k = 0; k <= intervals; ++k) extremal.nodes.col(k) = start(step * static_cast<double>(k)).y;
  extremal.nodes.col(0).head(first.size()) = first;
  extremal.nodes.col(intervals).head(last.size()) = last;
  for (Eigen::Index k = 0; k < intervals; ++k) {
    for (Eigen::Index i = 0; i < stages; ++i) {
      const double t = step * (static_cast<double>(k) + tableau.c[i]);
      ExtremalPoint point = start(t);
      extremal.rates.col(k * stages + i) = function.evaluate(point.y, t, point.z).rate;
      extremal.algebraic.col(k * stages + i) = point.z;
    }
  }
  NewtonOnGrid newton(function, extremal);
  double before = std::numeric_limits<double>::infinity();
  for (int count = 0; count < most_steps; ++count) {
    const double change = newton.step();
    if (!std::isfinite(change)) break;
    if (change <= rounding || (change <= nearly && change >= 0.5 * before)) {
      newton.finish();
      return extremal;
    }
    before = change;
  }
  throw Error(
      "Newton's method for Pontryagin's boundary value problem did not converge; start from a finer direct "
      "solution");
}

}  // namespace dmocbench
