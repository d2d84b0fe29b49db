#pragma once

#include <memory>
#include <optional>

#include <Eigen/Core>

#include "methods/indirect/collocated_extremal.hpp"
#include "methods/indirect/pontryagin_function.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The optimal motion, its costate and its control at one time; units of the problem as solved, true cost.
struct IndirectPoint {
  Eigen::VectorXd q;      ///< n entries
  Eigen::VectorXd p;      ///< n entries
  Eigen::VectorXd v;      ///< n entries, p = L_v(q, v)
  Eigen::VectorXd psi_q;  ///< n entries, gradient of the optimal cost-to-go as in `Costates`
  Eigen::VectorXd psi_p;  ///< n entries
  Eigen::VectorXd u;      ///< m entries, from H_u = 0
};

/// Largest differences of two solutions, each relative to the largest value of its kind along the motion. A kind that
/// vanishes, such as the costates of a free motion, is compared absolutely, times the problem's cost scale.
struct IndirectAgreement {
  double state = 0.0;    ///< q, v and p
  double costate = 0.0;  ///< ψ_q and ψ_p
  double control = 0.0;  ///< u
  double cost = 0.0;     ///< J

  /// The largest of them.
  [[nodiscard]] double worst() const;
  /// -log10 of the largest, at most 16.
  [[nodiscard]] double digits() const;
};

/// A solution of Pontryagin's boundary value problem, given at every time.
class IndirectSolution {
 public:
  /// A solution from numbers that `extremal` returned earlier. The problem is traced and need not outlive the solution.
  /// Throws `Error` if the numbers do not fit the problem.
  IndirectSolution(const Problem& problem, CollocatedExtremal extremal, const IndirectAgreement& agreement);

  /// The motion at time t in [0, T] (times outside are moved to the ends): the collocation polynomial of (q, p, ψ), v
  /// and u from them by Newton's method.
  [[nodiscard]] IndirectPoint at(double t) const;

  /// t_0 to t_N of the solution's grid.
  [[nodiscard]] Eigen::VectorXd node_times() const;
  /// J, the true cost.
  [[nodiscard]] double cost() const;
  /// The agreement of two runs of different order and grid, at and between their nodes.
  [[nodiscard]] const IndirectAgreement& agreement() const noexcept { return agreement_; }
  /// Digits that the two runs share in state, costate, control and cost.
  [[nodiscard]] double certified_digits() const { return agreement_.digits(); }
  /// max - min of the optimal Hamiltonian over the nodes, relative to the largest |C| + Σ|ψ_q v| + Σ|ψ_p ṗ|; none if
  /// the problem depends on time.
  [[nodiscard]] std::optional<double> hamiltonian_drift() const;

  /// This solution at the nodes and stages of a trajectory, as a reference for `trajectory_error`: without
  /// interpolation between grids, and with the stage controls at the stage times.
  [[nodiscard]] Trajectory sampled_like(const Trajectory& trajectory) const;

  /// This solution on its own grid and tableau.
  [[nodiscard]] Trajectory trajectory() const;

  /// All numbers of the solution, for files.
  [[nodiscard]] const CollocatedExtremal& extremal() const noexcept { return extremal_; }

 private:
  std::shared_ptr<const PontryaginFunction> function_;
  CollocatedExtremal extremal_;
  Tableau tableau_;
  IndirectAgreement agreement_;
};

/// Compares two solutions at the nodes of both and between the nodes of the first.
[[nodiscard]] IndirectAgreement compare(const IndirectSolution& one, const IndirectSolution& other, double cost_scale);

}  // namespace dmocbench
