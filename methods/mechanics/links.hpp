#pragma once

#include <functional>

#include "methods/expression/jacobian_at.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// The state at an end of a phase, in the phase's own velocities; t is the time of the whole motion.
struct PhaseEnd : State {
  NamedVector<'p'> p;  ///< momentum L_v of the phase, n entries
};

// Conditions of a switch: entries that vanish. Each function throws `Error` if the two sides differ in size.

/// q, v and y are continuous: a change of force, of potential or of inertia. Where the inertia changes, p jumps.
[[nodiscard]] ExpressionVector continuous(const PhaseEnd& before, const PhaseEnd& after);

/// q, p and y are continuous: a capture, a docking. Where the inertia changes, v jumps.
[[nodiscard]] ExpressionVector momentum_kept(const PhaseEnd& before, const PhaseEnd& after);

/// q and v are continuous, and y falls by `amount`, l entries: a stage that is left behind takes its momentum with it.
[[nodiscard]] ExpressionVector dropped(const PhaseEnd& before, const PhaseEnd& after, const ExpressionVector& amount);

/// An impact on g(q) = 0, c entries: q and y are continuous, p⁺ - p⁻ = Gᵀμ with G = ∂g/∂q, and G(v⁺ + e v⁻) = 0 with
/// the coefficient of restitution e, 1 for an elastic impact and 0 for one that sticks. The impulse μ, c entries, is a
/// formula of unknown parameters. g(q) = 0 is among the conditions. (The balance of energy would have the second
/// solution μ = 0.) Throws `Error` if μ has not c entries.
[[nodiscard]] ExpressionVector impact(const VectorFormula& guard, const Expression& restitution,
                                      const ExpressionVector& impulse, const PhaseEnd& before, const PhaseEnd& after);

/// A body that stands on one foot, in coordinates in which no foot is held.
struct FreeBody {
  /// Its Lagrangian.
  std::function<Expression(const State&)> lagrangian;
  /// Its coordinates while the old foot is held, of the coordinates of the phase before.
  VectorFormula on_old_foot;
  /// The same while the new foot is held, of the coordinates of the phase after.
  VectorFormula on_new_foot;
};

/// The new foot lands and stays while the old one leaves: the coordinates of the free body are continuous, which places
/// the foot too, and p⁺ is its momentum before, along the motions that hold the new foot; y is continuous.
[[nodiscard]] ExpressionVector new_foothold(const FreeBody& body, const PhaseEnd& before, const PhaseEnd& after);

}  // namespace dmocbench
