#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "methods/kkt/symmetric_factorisation.hpp"

namespace dmocbench::sqp {

/// Finds the shift δ >= 0 that makes H + δI positive definite on the null space of the equalities, by the inertia of
/// the matrix (H + δI, Eᵀ; E, 0): as many negative eigenvalues as rows E, and no eigenvalue 0.
class Convexification {
 public:
  static constexpr double first_least_shift = 1e-4;

  /// 0 if H is positive definite there already; otherwise at most a tenth more than is needed, and at least
  /// `least_shift`: without any curvature, a smaller shift would allow longer steps than the line search may judge.
  /// `free` marks the variables that may move, `equalities` the rows that count. Where no shift is enough, the largest
  /// one tried. None where an entry is not finite or above `SymmetricFactorisation::largest_entry`, or when
  /// `is_stopped`, called after each trial, returns true.
  [[nodiscard]] std::optional<double> shift_for(const Eigen::SparseMatrix<double>& hessian,
                                                const Eigen::SparseMatrix<double>& jacobian,
                                                const std::vector<bool>& free, const std::vector<bool>& equalities,
                                                const std::function<bool()>& is_stopped = {});

  /// What a matrix without curvature gets. A caller lowers it while whole steps are taken: where the cost is linear and
  /// its minimum a vertex, the number of iterations is proportional to the shift.
  double least_shift = first_least_shift;

 private:
  SymmetricFactorisation factorisation_;
};

/// A quasi-Newton approximation like SNOPT's: a diagonal and at most ten damped BFGS updates, after which the diagonal
/// of their sum becomes the new start. Always positive definite.
class LimitedMemoryHessian {
 public:
  /// Begins as the identity.
  explicit LimitedMemoryHessian(Eigen::Index variables) : diagonal_(Eigen::VectorXd::Ones(variables)) {}
  /// Begins as a diagonal matrix with positive entries.
  explicit LimitedMemoryHessian(Eigen::VectorXd diagonal) : diagonal_(std::move(diagonal)) {}
  [[nodiscard]] Eigen::MatrixXd times(const Eigen::Ref<const Eigen::MatrixXd>& vectors) const;

  /// Learns from a step s and the change y of the gradient of the Lagrangian along it (Powell's damping where yᵀs is
  /// small or negative).
  void update(const Eigen::VectorXd& step, const Eigen::VectorXd& change);

 private:
  static constexpr std::size_t most_updates = 10;
  /// + (added addedᵀ) - (removed removedᵀ)
  struct Update {
    Eigen::VectorXd added;
    Eigen::VectorXd removed;
  };
  Eigen::VectorXd diagonal_;
  std::vector<Update> updates_;
};

}  // namespace dmocbench::sqp
