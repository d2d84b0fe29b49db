#pragma once

#include <Eigen/Core>

#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/trajectory.hpp"

namespace dmocbench {

/// The energy E = L_v·v - L of a problem and the power f·v of its forces, on numbers.
class Energy {
 public:
  explicit Energy(const Problem& problem);

  /// E(q, v, t).
  [[nodiscard]] double energy(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t);
  /// f(q, v, u, t)·v.
  [[nodiscard]] double power(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& u, double t);

 private:
  PointFunction function_;  // outputs: E, f·v
  Eigen::VectorXd values_;
};

/// The change of energy along a discrete motion, compared with the work of the forces. Where L does not depend on t,
/// both are equal along exact motions (dE/dt = f·q̇). None of the discretisations conserves this balance exactly.
struct EnergyBalance {
  double change = 0.0;        ///< E(T) - E(0), from node configurations and velocities
  double work = 0.0;          ///< Σ_k h_k Σ b_i f·Q̇_i by the method's own quadrature
  double largest_gap = 0.0;   ///< max over the nodes of |E(t_k) - E(0) - work up to t_k|
  double largest_work = 0.0;  ///< max over the nodes of |work up to t_k|, to compare with
};

[[nodiscard]] EnergyBalance energy_balance(const Problem& problem, const Trajectory& trajectory);

}  // namespace dmocbench
