#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/expression/tape.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// States and costates in the coordinates in which the equations of an optimal motion are explicit, a row per point:
/// (q, v) and the costates (α, β) that belong to them, α = ψ^q + L_vqᵀψ^p, β = L_vv ψ^p.
struct ExtremalStates {
  Eigen::MatrixXd q;      ///< rows × n
  Eigen::MatrixXd v;      ///< rows × n
  Eigen::MatrixXd alpha;  ///< rows × n
  Eigen::MatrixXd beta;   ///< rows × n
};

/// The flow of Pontryagin's equations without bounds, of all intervals of a motion at once:
///
///   H = C + α·v + β·a(q, v, u, t),  a = L_vv⁻¹(L_q + f - L_vq v - L_vt),  H_u = 0,
///   q̇ = v,  v̇ = a,  α̇ = -H_q,  β̇ = -H_v.
///
/// Costates belong to the cost times `cost_scale`, so that all of them are of order 1.
class ExtremalFlow {
 public:
  /// Traces and differentiates a and H. Throws `Error` if H_uu has a structural zero as a pivot: the cost is not
  /// strictly convex in the control.
  ExtremalFlow(const TracedProblem& problem, double cost_scale);

  /// The end points of the flow in the intervals.
  struct CarriedNodes {
    ExtremalStates states;  ///< row k at t_{k+1}, begun at node k
    Eigen::VectorXd cost;   ///< ∫ C dt over interval k, times `cost_scale`
  };
  /// Carries rows 0 to N - 1 of `nodes` (N + 1 rows) through the intervals of a motion, by an adaptive method of order
  /// 7(8) that takes the same relative steps in all of them; the controls of the motion begin Newton's method for H_u =
  /// 0. If an interval cannot be carried, all of its row is NaN.
  [[nodiscard]] CarriedNodes carry(const ExtremalStates& nodes, const Trajectory& motion, double tolerance);

 private:
  /// The control from H_u = 0 at `state` (N rows of 4 n + 1 entries, column by column), into `controls_`.
  void find_controls(const std::vector<double>& state, const Trajectory& motion, double tau);
  void bind(const std::vector<double>& state, Eigen::Index rows);

  struct Tapes {
    Tape control_step;  // the next control of Newton's method
    Tape rates;         // of (q, v, α, β) and the cost
    int newton_steps = 1;
  };
  [[nodiscard]] static Tapes trace(const TracedProblem& problem, double cost_scale);

  Eigen::Index n_;
  Eigen::Index m_;
  Tapes tapes_;
  Tape::Workspace control_memory_;
  Tape::Workspace rate_memory_;
  std::vector<Tape::Input> inputs_;
  Eigen::MatrixXd controls_;
  Eigen::MatrixXd next_controls_;
  Eigen::VectorXd times_;
};

/// Takes states and costates from (q, v, p, ψ^q, ψ^p) to `ExtremalStates` and back.
class ExtremalCoordinates {
 public:
  /// Scaled by the sizes of a problem whose cost solvers see times `cost_scale`.
  ExtremalCoordinates(const TracedProblem& problem, double cost_scale);

  /// The nodes of a motion with costates; `ExtremalStates` holds these times the cost scale.
  [[nodiscard]] ExtremalStates of_nodes(const Trajectory& motion);

  /// (q, p, ψ^q, ψ^p), a row per point; costates times the cost scale.
  struct Canonical {
    Eigen::MatrixXd q;      ///< n columns
    Eigen::MatrixXd p;      ///< n columns
    Eigen::MatrixXd psi_q;  ///< ψ^q, n columns
    Eigen::MatrixXd psi_p;  ///< ψ^p, n columns
  };
  /// Row k at times[k]. NaN where L_vv is singular.
  [[nodiscard]] Canonical canonical(const ExtremalStates& states, const Eigen::VectorXd& times);

 private:
  /// L_v, L_vv and L_vq at all points: `values_` has n + 2 n² columns.
  void evaluate(const Eigen::MatrixXd& q, const Eigen::MatrixXd& v, const Eigen::VectorXd& times);
  [[nodiscard]] Eigen::MatrixXd matrix(Eigen::Index row, Eigen::Index which) const;

  Eigen::Index n_;
  double cost_scale_;
  Tape transform_;
  Eigen::MatrixXd values_;
};

}  // namespace dmocbench
