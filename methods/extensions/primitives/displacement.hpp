#pragma once

#include <Eigen/Core>

#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// An element g of a symmetry group that acts affinely: q ↦ A q + b, v ↦ A v. Translations, rotations of the plane and
/// shifts of angles are such elements, full turns of an angle among them.
struct Displacement {
  Eigen::MatrixXd linear;  ///< A, n × n, invertible
  Eigen::VectorXd shift;   ///< b, n entries

  /// q ↦ q.
  [[nodiscard]] static Displacement identity(Eigen::Index n);
  /// q ↦ q + b.
  [[nodiscard]] static Displacement translation(Eigen::VectorXd b);

  /// g·q.
  [[nodiscard]] Eigen::VectorXd configuration(const Eigen::VectorXd& q) const { return linear * q + shift; }
  /// g·(q, v).
  [[nodiscard]] BoundaryState state(const BoundaryState& x) const { return {configuration(x.q), linear * x.v}; }
  /// q ↦ this(other(q)).
  [[nodiscard]] Displacement after(const Displacement& other) const;
  /// The largest difference of an entry of A or b.
  [[nodiscard]] double distance(const Displacement& other) const;
};

}  // namespace dmocbench
