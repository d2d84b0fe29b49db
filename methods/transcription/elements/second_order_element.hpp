#pragma once

#include "methods/transcription/elements/element.hpp"

namespace dmocbench {

/// Collocation of the Euler-Lagrange equations as equations of second order, a Nyström method. With Lobatto, s = 2 and
/// 3 are the trapezoidal and the Hermite-Simpson method for systems of second order by Moreno-Martín, Ros and Celaya
/// (arXiv 2302.09056).
///
/// Node: q_k alone, as in DMOC. On an interval q is a polynomial of degree s + 1, whose rate is the velocity and whose
/// second rate is the acceleration; in `TangentElement` q has degree s, and its second rate is not V̇_i. The interior
/// unknowns are the rates of q at s + 1 Gauss points, of which the last is eliminated. Equations:
///   node k:  L_v from the interval to its left less L_v from the interval to its right, as velocities are continuous
///            (unit: momentum),
///   stages:  h (d/dt L_v - L_q - f) = h (L_vq V_i + L_vv A_i + L_vt - L_q - f) = 0 at (Q_i, V_i, U_i) (n each, unit:
///            momentum, with the round-off of the equations of nodes).
/// Momenta: p = L_v(q, v) at the nodes.
///
/// Velocities can be eliminated because an interval determines them at its ends. Each interval keeps one
/// unknown rate more than in DMOC, because Q_i depends on the acceleration and the equations of the stages cannot be
/// solved for it in formulas: (s + 1)n + sm unknowns, DMOC has sn + sm and tangent-space collocation 2sn + sm.
class SecondOrderElement final : public Element {
 public:
  SecondOrderElement()
      : Element("second_order", "collocation of the Euler-Lagrange equations as second-order equations in q",
                NodeState::configuration) {}
  /// Gauss with s + 1 points.
  [[nodiscard]] Tableau rates(const Tableau& tableau) const override;
  [[nodiscard]] IntervalTrace trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const override;
};

}  // namespace dmocbench
