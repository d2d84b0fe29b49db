#pragma once

#include <Eigen/Core>

#include "methods/expression/tape.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The map of DMOC by the midpoint rule of many states at once: (q_k, v_k) and the control U of the interval give
/// (q_{k+1}, v_{k+1}), with p = L_v(q, v) at the nodes, p_k = -D₁L_d - f_d⁻ and p_{k+1} = D₂L_d + f_d⁺.
///
/// In tables of states row i is (q, v) of state i, 2n columns. The equation of the interval is solved by a fixed number
/// of simplified Newton steps in formulas, to some eight digits where a step of the horizon is short: enough to find
/// motions that DMOC then solves to rounding (`solve_primitives`). States that leave the domain of the formulas become
/// NaN.
class DiscreteFlow {
 public:
  /// `h`: the step; backwards in time where it is negative, which undoes a step forwards.
  DiscreteFlow(const Problem& problem, double h);

  /// h.
  [[nodiscard]] double step() const noexcept { return h_; }
  /// n.
  [[nodiscard]] Eigen::Index configuration_size() const noexcept { return n_; }
  /// m.
  [[nodiscard]] Eigen::Index control_size() const noexcept { return m_; }

  /// One step of all states under the controls in the rows of `controls` (m columns). Adds h C to the entries of
  /// `costs`.
  void advance(Eigen::MatrixXd& states, const Eigen::MatrixXd& controls, Eigen::VectorXd& costs) const;
  /// ∂(q, v)_{k+1}/∂((q, v)_k, U), to some three digits: 2n (2n + m) columns, the matrix column by column.
  [[nodiscard]] Eigen::MatrixXd derivatives(const Eigen::MatrixXd& states, const Eigen::MatrixXd& controls) const;

 private:
  [[nodiscard]] Eigen::MatrixXd evaluated(const Tape& tape, const Eigen::MatrixXd& states,
                                          const Eigen::MatrixXd& controls) const;

  double h_;
  Eigen::Index n_;
  Eigen::Index m_;
  Tape map_;  // (q, v)_{k+1}, h C
  Tape derivatives_;
};

}  // namespace dmocbench
