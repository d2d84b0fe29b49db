#pragma once

#include <memory>
#include <optional>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// Largest errors against the optimum, Euclidean norm: the quantities of (main_theorem) and the stage controls.
struct OptimumError {
  double state = 0.0;         ///< of (q, p) over the nodes
  double costate_q = 0.0;     ///< of ψ^q over the nodes
  double costate_p = 0.0;     ///< of ψ^p over the nodes
  double node_control = 0.0;  ///< of u(x_k, ψ_k), the minimiser of the Hamiltonian within the bounds
  double control = 0.0;       ///< of u over the stages
  double objective = 0.0;     ///< |J - J*|
};

/// The optimum that errors are measured against: a closed form, or a solution on a much finer grid.
class KnownOptimum {
 public:
  /// The closed form of a problem that has one (`Problem::optimum`); otherwise the finer motion is needed. Throws
  /// `Error` if there is neither.
  KnownOptimum(const Problem& problem, std::optional<Trajectory> finer);

  [[nodiscard]] bool is_exact() const noexcept { return finer_ == nullptr; }
  /// The errors of a motion with costates whose nodes are nodes of the finer one.
  [[nodiscard]] OptimumError error_of(const Trajectory& motion) const;

 private:
  /// The optimum at the nodes and stages of a motion.
  struct Sampled {
    Eigen::MatrixXd q, p, psi_q, psi_p, node_u, stage_u;
    double cost = 0.0;
  };
  [[nodiscard]] Sampled closed_form_at(const Trajectory& motion) const;
  [[nodiscard]] Sampled finer_at(const Trajectory& motion) const;
  /// u(x_k, ψ_k) at all nodes. Where H_uu is diagonal the minimiser within bounds is the free one, moved to the bound.
  [[nodiscard]] Eigen::MatrixXd minimisers(const Trajectory& motion) const;

  const Problem& problem_;
  std::unique_ptr<const Trajectory> finer_;  // null for a closed form
  Eigen::MatrixXd finer_controls_;
};

}  // namespace dmocbench
