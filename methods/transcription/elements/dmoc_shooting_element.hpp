#pragma once

#include <string>
#include <string_view>

#include "methods/transcription/elements/shooting_element.hpp"

namespace dmocbench {

/// Direct shooting by the map of DMOC itself: the forced discrete Euler-Lagrange equations (DEL) as a step.
///
/// Node: (q_k, p_k). The step solves the left one of the forced discrete Legendre transforms (eq:varmech_dlegf),
///   p_k = -D₁L_d(q_k, q_{k+1}) - f_d⁻(q_k, q_{k+1}, U),
/// for q_{k+1}, with L_d and f_d of any tableau (`DmocElement`); for s > 1 together with the equations of the interior
/// stage rates. The right one gives p_{k+1} = D₂L_d + f_d⁺. With Φ this map, the equations of an interval are
///   (x_{k+1} - Φ(x_k, U))/h = 0        (2n, units: velocity, force).
/// Eliminating the momenta leaves the equations of `DmocElement`, so that both programs have the same solutions: this
/// is DMOC in other unknowns, and single shooting is possible with it.
///
/// The equations are solved inside of the formulas, by `newton_steps` steps of Newton's method from q_k + h v, where v
/// is one step of the same method for p_k = L_v(q_k, v) from v = 0. Near the root every step doubles the digits of
/// q_{k+1} and of its derivatives; the last derivatives agree with the implicit function theorem to rounding.
/// Where the last step was not yet below 1e-12 of the configuration, Φ is not a number, by which solvers reject a trial
/// point: steps must not be too long. The derivative of the residual by q_{k+1} needs nonzero leading minors
/// (`solve_unsymmetric`); to leading order it is -L_vv/h.
class DmocShootingElement final : public Element {
 public:
  /// With this many steps per interval.
  explicit DmocShootingElement(Shooting shooting) : shooting_(shooting) {}

  /// Each doubles the digits of the root.
  static constexpr int newton_steps = 6;

  /// "multiple_shooting_dmoc_1" or "single_shooting_dmoc_1": one step per interval.
  [[nodiscard]] std::string name() const override {
    return shooting_name(shooting_family(shooting_), dmoc_integrator, 1);
  }
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] NodeState node_state() const override { return NodeState::momentum; }
  [[nodiscard]] bool has_stage_unknowns() const override { return false; }
  [[nodiscard]] IntervalTrace trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const override;

 private:
  Shooting shooting_;
};

}  // namespace dmocbench
