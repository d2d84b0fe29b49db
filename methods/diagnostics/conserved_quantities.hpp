#pragma once

#include <Eigen/Core>

#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

// Momentum, energy and control Hamiltonian along a discrete motion. Exact motions conserve them, or change them by the
// work of forces.

/// The balance between forces and momentum along a discrete motion (eq:noether_force_d).
struct MomentumConsistency {
  /// Per interval: p_{k+1}·ξ(q_{k+1}) - p_k·ξ(q_k) minus the work of all forces along ξ by the method's own quadrature,
  /// h Σ b_i [L_q·ξ(Q_i) + L_v·Dξ(Q_i)Q̇_i + f·ξ(Q_i)]. N entries, of
  /// phases N of each that has the symmetry.
  Eigen::VectorXd defects;
  double largest = 0.0;  ///< largest magnitude of an interval's defect
  double mean = 0.0;     ///< mean magnitude
  /// Magnitude of their sum: the balance over the whole horizon. Of phases with the changes at switches, which vanish
  /// where the switch has the symmetry.
  double total = 0.0;
  double largest_force = 0.0;  ///< largest magnitude of the force along ξ at a stage, to compare with
};

/// The momenta are the trajectory's at the nodes, one number per node, shared by the two intervals next to it: with
/// both momenta taken from the same interval, the defect would vanish identically. (The last node belongs to one
/// interval only, so for DMOC the defect of the last interval does; the other N - 1 are checks.) Throws `Error` if the
/// problem has no symmetry.
[[nodiscard]] MomentumConsistency momentum_consistency(const Problem& problem, const Trajectory& trajectory);

/// The momentum of the costates, ψ_q·ξ(q) - ψ_p·Dξ(q)ᵀp at the nodes: the action of the group on phase space, paired
/// with ψ. Noether's theorem of the optimal control problem: it is constant along an optimum where L, f and the cost
/// are all invariant (`Problem::symmetry` requires less).
struct CostateMomentum {
  Eigen::VectorXd values;  ///< N + 1 entries
  double spread = 0.0;     ///< max - min of them, relative to the largest sum of magnitudes of the terms at a node
};

/// Along a discrete optimum. Throws `Error` if the problem has no symmetry or the trajectory no costates.
[[nodiscard]] CostateMomentum costate_momentum(const Problem& problem, const Trajectory& trajectory);

/// The energy E = L_v·v - L of a problem and the power f·v of its forces, on numbers.
class Energy {
 public:
  /// Traces E of the problem.
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

/// Energy and work along a motion, interval by interval, by the quadrature of its tableau.
[[nodiscard]] EnergyBalance energy_balance(const Problem& problem, const Trajectory& trajectory);

/// The optimal control Hamiltonian H = C + ψ_q·q̇ + ψ_p·(L_q + f) of the maximum principle along a discrete motion,
/// evaluated at the nodes, N + 1 entries. The control at a node is the stage polynomial of the interval to its right,
/// at the last node of that to its left.
///
/// Where nothing depends on time, H is constant along exact solutions. Where the horizon is free,
/// H(T) - ψ_p·L_vt(T) + ∂Φ/∂T = 0; the middle term appears because ends and Φ are stated in velocities, while ψ
/// belongs to momenta. For discrete solutions both hold up to their order, since H_u = 0 removes the first-order effect
/// of the control's error. Active path constraints do not enter H. Throws `Error` if the trajectory has no costates.
[[nodiscard]] Eigen::VectorXd control_hamiltonian(const Problem& problem, const Trajectory& trajectory);

/// H(T) - ψ_p·L_vt(T) + ∂Φ/∂T, the residual of the condition of a free horizon. Where a bound on T is active, it is the
/// multiplier of that bound. Boundary conditions that depend on T would add terms that a trajectory does not carry.
[[nodiscard]] double free_horizon_residual(const Problem& problem, const Trajectory& trajectory);

}  // namespace dmocbench
