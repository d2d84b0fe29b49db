#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "methods/diagnostics/traced_newton.hpp"
#include "methods/extensions/step_control/extended_action.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

/// The rule by which σ determines the steps.
enum class StepRule : std::uint8_t {
  /// h = Δτ σ is a constraint of the principle: its variation appears in the equations of motion (KMLTMD; section 5).
  variational,
  /// The same equation for h, with the equations of motion of fixed steps.
  imposed,
  /// The step is known before it is taken: h = Δτ σ(q_k), with the equations of motion of fixed steps.
  from_left,
};

/// DMOC forward in time with step sizes that are tied to the motion.
///
/// In the variational rule the steps and times of the discrete path are varied together with its configurations
/// (`ExtendedAction`). Per interval, with ∂_x = ∂(A + λ c)/∂x + W[x],
///   0 = p_k + ∂_{q_k},   0 = ∂_{Q̇_j},   0 = c,   -E_k = ∂_h - ∂_{t_k},   p_{k+1} = ∂_{q_{k+1}},
///   -E_{k+1} = -E_k + ∂_{t_k} = ∂_h.
/// -E is the momentum of time: E begins as the energy and changes by the work. λ is the discrete energy less E, which
/// is 0 along exact motions. Without forces this is a variational integrator of the extended Hamiltonian σ (H - E), the
/// Poincaré transform, in the time τ with dt = σ dτ: (q, t, p, -E) ↦ (q, t, p, -E) is symplectic. Where σ is invariant
/// under a group, so is c, and the momentum changes by the work of the forces as with fixed steps.
///
/// In the other rules λ = 0, and E is only the energy that the work accounts for.
class StepControlMap {
 public:
  /// The beginning of a step.
  struct From {
    Eigen::VectorXd q;         ///< n entries
    Eigen::VectorXd p;         ///< n entries
    double t = 0.0;            ///< time
    double energy = 0.0;       ///< E
    Eigen::VectorXd velocity;  ///< an estimate of q̇, from which the iteration starts
  };
  /// A step.
  struct Step {
    From end;                    ///< where the next one begins; its velocity is (q_1 - q_0)/h
    double h = 0.0;              ///< the step
    double multiplier = 0.0;     ///< λ; 0 unless the rule is variational
    Eigen::VectorXd impulse;     ///< h Σ b_i f(Q_i, Q̇_i, U_i), n entries
    double torque = 0.0;         ///< h Σ b_i f·ξ(Q_i) along the problem's symmetry; 0 without one
    std::vector<double> inputs;  ///< the solved interval, for `jacobian`
  };

  /// Throws `Error` if the rule is `from_left` and σ depends on the velocity, which that rule does not use.
  StepControlMap(const Problem& problem, const Tableau& tableau, const StepFunction& sigma, StepRule rule);

  /// One step at the pace Δτ > 0. Row i of `controls` is U_i (s × m). Throws `Error` if σ is not positive there, or the
  /// iteration does not converge.
  [[nodiscard]] Step advance(const From& from, const Eigen::MatrixXd& controls, double pace) const;

  /// ∂(q_1, t_1, p_1, -E_1)/∂(q_0, t_0, p_0, -E_0) at a step, 2n + 2 square, by the implicit function theorem: exact to
  /// rounding.
  [[nodiscard]] Eigen::MatrixXd jacobian(const Step& step) const;

  /// The operations of one pass of Newton's method: equations and their derivatives.
  [[nodiscard]] std::size_t operations() const noexcept { return newton_.operations(); }

 private:
  Eigen::Index n_;
  Eigen::Index interior_;      // unknown stage rates
  Eigen::Index unknowns_ = 0;  // q_1, the interior rates, h
  Schedule sigma_;             // σ at the left node, from the same inputs
  TracedNewton<double> newton_;
  Schedule reading_;      // p_1, the impulse, the torque, -E_1, λ
  Schedule derivatives_;  // equations and (q_1, t_1, p_1, -E_1) by the unknowns and by (q_0, t_0, p_0, -E_0)
};

}  // namespace dmocbench
