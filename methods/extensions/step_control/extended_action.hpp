#pragma once

#include <functional>

#include <Eigen/Core>

#include "methods/expression/vectors.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

/// σ > 0 at a point (q, v, u, t): steps are Δτ σ.
using StepFunction = std::function<Expression(const ControlledState& point)>;

/// The discrete Lagrange-d'Alembert principle of one interval whose step and time are varied together with its
/// configurations (KMLTMD; section 5 of the paper): the formulas of DMOC with step sizes that are tied to the motion.
///
///   δ Σ_k [A(q_k, q_{k+1}, h_k) + λ_k c_k] + virtual work = 0,   c_k = h_k - Δτ σ_k,   h_k = t_{k+1} - t_k,
/// with the action A = h Σ b_i L(Q_i, Q̇_i) of `DmocElement` and 1/σ_k = Σ b_i / σ(Q_i, Q̇_i, U_i), so that Δτ = ∫ dt/σ
/// to the order of the tableau. The work of f_i on the variations is f_i·(δQ_i - Q̇_i δT_i): forces change the momentum
/// of time, which is minus the energy.
class ExtendedAction {
 public:
  /// `unknowns` as `DmocElement` takes them; its step and times may be formulas of inputs.
  ExtendedAction(const Problem& problem, const TracedProblem& traced, const Tableau& tableau,
                 const IntervalUnknowns& unknowns);

  /// The element's own formulas, for a fixed step.
  [[nodiscard]] const IntervalTrace& element() const noexcept { return element_; }
  /// σ_k.
  [[nodiscard]] Expression mean_of(const StepFunction& sigma) const;
  /// ∂(A + λ c)/∂x + W[x] for unknowns x, which must be inputs; `constraint` is c and `multiplier` λ.
  [[nodiscard]] ExpressionVector variation_by(const ExpressionVector& x, const Expression& constraint,
                                              const Expression& multiplier) const;
  /// h Σ b_i f(Q_i, Q̇_i, U_i), n entries.
  [[nodiscard]] ExpressionVector impulse() const;
  /// h Σ b_i f·ξ(Q_i) along the problem's symmetry; 0 without one.
  [[nodiscard]] Expression torque() const;

 private:
  Eigen::VectorXd b_;
  Expression h_;
  IntervalTrace element_;
  std::vector<ExpressionVector> forces_;      // f_i
  std::vector<ExpressionVector> symmetries_;  // ξ(Q_i), empty without symmetry
  Expression action_;
};

/// Node times of steps that are proportional to σ along a motion.
struct StepTimes {
  double pace = 0.0;      ///< Δτ = ∫ dt/σ / N
  Eigen::VectorXd times;  ///< t_0 = 0 .. t_N = T with ∫ dt/σ = Δτ from each to the next
};

/// Throws `Error` unless σ, met at time t, is positive and finite.
void require_positive_step(double sigma, double t);

/// Divides a motion into a given number of steps. The integral uses the trapezoidal rule with some thousand points:
/// exact to rounding over the period of a smooth motion. Throws `Error` if σ is not positive and finite along the
/// motion.
[[nodiscard]] StepTimes step_times(const StepFunction& sigma, const Motion& motion, Eigen::Index intervals);

}  // namespace dmocbench
