#pragma once

#include <Eigen/Core>

#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// One number per interval (row) and local unknown or local row of the intervals' formulas (column).
struct LocalValues {
  Eigen::MatrixXd unknowns;
  Eigen::MatrixXd rows;
};

/// The linearised conditions of optimality of each interval alone, the matrices (H_k, J_kᵀ; J_k, 0) of its share of the
/// Lagrangian, before they are added up at the nodes.
class IntervalConditions {
 public:
  IntervalConditions(Transcription& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers);

  /// Zeros of the right size.
  [[nodiscard]] LocalValues zero() const;
  /// The change of (gradient of ℓ_k, rows of interval k) where the local unknowns and the multipliers of the local rows
  /// change by `direction`.
  [[nodiscard]] LocalValues times(const LocalValues& direction) const;
  /// The local parts of a vector of all unknowns and one of all constraints.
  [[nodiscard]] LocalValues picked(const Eigen::VectorXd& unknowns, const Eigen::VectorXd& rows) const;
  /// Adds local values to such vectors.
  void add(const LocalValues& values, Eigen::VectorXd& unknowns, Eigen::VectorXd& rows) const;

 private:
  Transcription& program_;
  Eigen::MatrixXd hessians_;
  Eigen::MatrixXd jacobians_;
};

}  // namespace dmocbench
