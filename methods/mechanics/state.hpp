#pragma once

#include <utility>

#include <Eigen/Core>

#include "methods/expression/smooth.hpp"
#include "methods/expression/spline.hpp"
#include "methods/expression/vectors.hpp"

namespace dmocbench {

/// A point of the tangent space at a time, as traced numbers: the argument of a Lagrangian.
struct State {
  NamedVector<'q'> q;       ///< configuration, n entries
  NamedVector<'v'> v;       ///< velocity q̇, n entries
  Expression t;             ///< time
  NamedVector<'y'> y = {};  ///< first-order states, l entries
};

/// A state and the control that acts there: the argument of forces and running costs.
struct ControlledState {
  NamedVector<'q'> q;       ///< configuration, n entries
  NamedVector<'v'> v;       ///< velocity q̇, n entries
  NamedVector<'u'> u;       ///< control, m entries
  Expression t;             ///< time
  NamedVector<'y'> y = {};  ///< first-order states, l entries

  /// The same point without its control.
  [[nodiscard]] State state() const { return {q, v, t, y}; }
};

/// Configuration and velocity at an end of the horizon, as numbers.
struct BoundaryState {
  Eigen::VectorXd q;       ///< n entries
  Eigen::VectorXd v;       ///< n entries
  Eigen::VectorXd y = {};  ///< first-order states, l entries

  /// (q, 0).
  [[nodiscard]] static BoundaryState at_rest(Eigen::VectorXd q) {
    const Eigen::Index n = q.size();
    return {.q = std::move(q), .v = Eigen::VectorXd::Zero(n)};
  }
};

/// A point of a motion, as numbers.
struct MotionPoint {
  Eigen::VectorXd q;       ///< configuration, n entries
  Eigen::VectorXd v;       ///< velocity, n entries
  Eigen::VectorXd u;       ///< control, m entries
  Eigen::VectorXd y = {};  ///< first-order states, l entries
};

/// A point of an optimal motion with its costate ψ = ∂V/∂(q, p), the gradient of the optimal cost-to-go.
struct OptimalPoint {
  MotionPoint motion;     ///< q*, q̇*, u*
  Eigen::VectorXd psi_q;  ///< n entries
  Eigen::VectorXd psi_p;  ///< n entries

  /// A point of a problem with one coordinate and one control.
  [[nodiscard]] static OptimalPoint of_numbers(double q, double v, double u, double psi_q, double psi_p) {
    const auto one = [](double entry) { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, entry)); };
    return {.motion = {.q = one(q), .v = one(v), .u = one(u)}, .psi_q = one(psi_q), .psi_p = one(psi_p)};
  }
};

}  // namespace dmocbench
