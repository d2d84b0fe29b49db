#pragma once

#include <Eigen/Core>

#include "methods/kkt/kkt_system.hpp"
#include "methods/solvers/interior_point/barrier_program.hpp"

namespace dmocbench::interior_point {

/// The multiple δ_w of the unit matrix that makes the Hessian positive definite on the null space of the equalities:
/// raised until the inertia is right, starting from a third of the last shift (Algorithm IC of Wächter and
/// Biegler). Unlike there, the system without a shift is not tried first where a third was too little the last time,
/// nor after one without a shift was singular, as where a direction has no curvature: from then on a system begins with
/// a hundredth, because a tiny shift is enough, and a singular system costs a sparse factorisation.
class InertiaShift {
 public:
  /// Call before a new system with the program's Hessian.
  void begin() noexcept;
  /// Call before a system without a shift.
  void clear() noexcept { shift_ = 0.0; }
  [[nodiscard]] double value() const noexcept { return shift_; }
  /// The next larger one, after a system that was not solved; false beyond the largest.
  [[nodiscard]] bool raise(kkt::FactorisationStatus status) noexcept;
  /// This one was enough.
  void keep() noexcept;

 private:
  [[nodiscard]] double last_over(double divisor) const noexcept;

  double shift_ = 0.0;
  double last_ = 0.0;
  bool is_flat_ = false;  // a system without a shift was singular
  bool grows_ = false;    // the last system needed more than a third of the shift before it
};

/// The linear systems of the method. All have the form (13) of Wächter and Biegler,
///
///   (H + Σ_x + δ_w I) dx + Jᵀ dλ = -gradient,   J dx - (Σ_s + δ_w I)⁻¹ dλ = -constraints
///
/// (the second term for inequalities only), where the steps of slacks and of multipliers of bounds are eliminated.
class NewtonStep {
 public:
  NewtonStep(const BarrierProgram& program, kkt::KktSystem& kkt);
  /// Call before another solve: forgets the last one.
  void begin_solve();

  /// Newton's step for the barrier problem, from the program's derivatives at the iterate, `gradient` of the Lagrangian
  /// without bounds (`BarrierProgram::gradient_of_lagrangian`) and the residuals of the constraints. False if no shift
  /// of the Hessian gives a step.
  [[nodiscard]] bool compute(const Iterate& at, double mu, const Primal& gradient, const Eigen::VectorXd& constraints,
                             Iterate& step);
  /// The last step again for other residuals of the constraints: a second-order correction. False if it fails.
  [[nodiscard]] bool correct(const Iterate& at, double mu, const Primal& gradient, const Eigen::VectorXd& constraints,
                             Iterate& step);
  /// The shortest step of x and s to where the linearised constraints hold, in a norm in which a unit of length costs
  /// 1 + μ/d² at the distance d from a bound. False if it fails.
  [[nodiscard]] bool feasibility_step(const Iterate& at, double mu, const Eigen::VectorXd& constraints, Iterate& step);
  /// Sets λ to the least-squares multipliers, (36); to zero where they are larger than λ_max.
  void estimate_multipliers(Iterate& at);

  /// The derivative of φ_μ along a step.
  [[nodiscard]] double directional_derivative(const Iterate& at, double mu, const Iterate& step) const;
  /// δ_w of the last step.
  [[nodiscard]] double shift() const noexcept { return shift_.value(); }
  /// Systems solved so far.
  [[nodiscard]] int factorisations() const noexcept { return factorisations_; }
  /// Time spent in them.
  [[nodiscard]] double linear_seconds() const noexcept { return linear_seconds_; }

 private:
  [[nodiscard]] kkt::KktMatrix matrix_with(const Eigen::VectorXd& hessian) const {
    return {hessian, program_.jacobian(), diagonal_, compliance_};
  }
  [[nodiscard]] kkt::KktRightHandSide reduce(double shift, const Eigen::VectorXd& gradient,
                                             const Eigen::VectorXd& constraints, Iterate& step);
  [[nodiscard]] bool solve(const Eigen::VectorXd& hessian, double shift, const Eigen::VectorXd& gradient,
                           const Eigen::VectorXd& constraints, Iterate& step);
  [[nodiscard]] bool solve_least_squares(const Eigen::VectorXd& gradient, const Eigen::VectorXd& constraints,
                                         Iterate& step);
  void set_eliminated_steps(const Iterate& at, double mu, Iterate& step) const;

  const BarrierProgram& program_;
  kkt::KktSystem& kkt_;
  InertiaShift shift_;
  // Without bounds or slacks their parts stay empty: a pass over a long vector costs a fetch from memory.
  Primal sigma_;                 // Σ
  Primal gradient_;              // of the Lagrangian with the barrier
  Eigen::VectorXd diagonal_;     // Σ_x + δ_w
  double diagonal_shift_ = 0.0;  // δ_w in it
  Eigen::VectorXd compliance_;   // (Σ_s + δ_w)⁻¹, one per constraint
  Eigen::VectorXd constraints_;
  Eigen::VectorXd no_hessian_;  // made when they are first needed, as the next one
  Eigen::VectorXd no_gradient_;
  Eigen::VectorXd no_constraints_;
  Iterate of_least_squares_;
  int factorisations_ = 0;
  double linear_seconds_ = 0.0;
};

}  // namespace dmocbench::interior_point
