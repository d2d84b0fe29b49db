#pragma once

#include <Eigen/Core>

#include "methods/solvers/interior_point/barrier_program.hpp"
#include "methods/solvers/interior_point/kkt_system.hpp"

namespace dmocbench::interior_point {

/// A step of all that moves.
struct Direction {
  Eigen::VectorXd x;
  Eigen::VectorXd s;
  Eigen::VectorXd multipliers;
  Eigen::VectorXd x_lower;
  Eigen::VectorXd x_upper;
  Eigen::VectorXd s_lower;
  Eigen::VectorXd s_upper;
};

/// How the Hessian is made positive definite where the equalities hold: by a multiple of the unit matrix that is raised
/// until the inertia is right, starting from a third of what was last needed (Wächter and Biegler 2006, Algorithm IC).
/// Where a third was too little the last time, the system without a shift is not tried first.
class InertiaShift {
 public:
  /// Before a new system with the program's Hessian.
  void begin() noexcept;
  /// Before one that needs no shift.
  void clear() noexcept { shift_ = 0.0; }
  [[nodiscard]] double value() const noexcept { return shift_; }
  /// The next larger one; false beyond the largest.
  [[nodiscard]] bool raise() noexcept;
  /// This one was enough.
  void keep() noexcept;

 private:
  [[nodiscard]] double third_of_last() const noexcept;

  double shift_ = 0.0;
  double last_ = 0.0;
  bool grows_ = false;  // the last system needed more than a third of what the one before it needed
};

/// Newton's step for the conditions of the barrier problem, with slacks and multipliers of bounds eliminated.
class NewtonStep {
 public:
  NewtonStep(const BarrierProgram& program, KktSystem& kkt);

  /// The step at a point, from the program's derivatives there, for the slope ∇φ + Jᵀλ (one entry per unknown) and the
  /// residual of the rows (one per row). False if no shift of the Hessian gives a step.
  [[nodiscard]] bool compute(const Point& point, double mu, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                             Direction& direction);
  /// The same matrix and slope for another residual of the rows; false if it fails.
  [[nodiscard]] bool correct(const Point& point, double mu, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                             Direction& direction);
  /// The shortest step to where the linearised rows hold, in a norm in which a unit of length costs 1 + μ/d² at the
  /// distance d from a bound.
  [[nodiscard]] bool towards_rows(const Point& point, double mu, const Eigen::VectorXd& rows, Direction& direction);
  /// Sets λ, one entry per row, to what balances the slope best in the sense of least squares; to zero if that has no
  /// reasonable size.
  void estimate_multipliers(Point& point);

  /// Derivative of the barrier function along a direction.
  [[nodiscard]] double slope_along(const Point& point, double mu, const Direction& direction) const;
  /// What the last step added to the Hessian's diagonal.
  [[nodiscard]] double shift() const noexcept { return shift_.value(); }
  /// Systems solved so far.
  [[nodiscard]] int factorisations() const noexcept { return factorisations_; }
  /// Time spent in them.
  [[nodiscard]] double linear_seconds() const noexcept { return linear_seconds_; }

 private:
  void fill_barrier(const Point& point, double mu, const Eigen::VectorXd& slope);
  /// With Σ + `constant` on the diagonal, of unknowns and of slacks.
  [[nodiscard]] FactorisationStatus solve(const Eigen::VectorXd& hessian, double constant, const Eigen::VectorXd& slope,
                                          const Eigen::VectorXd& rows, Direction& direction);
  [[nodiscard]] const Eigen::VectorXd& no_hessian();
  void fill_diagonal(double constant);
  void complete(const Point& point, double mu, Direction& direction) const;

  const BarrierProgram& program_;
  KktSystem& kkt_;
  InertiaShift shift_;
  // Empty, with the slope and the rows as they come, where nothing has a bound, or no row a slack: vectors of a long
  // horizon are fetched from memory.
  Eigen::VectorXd sigma_;        // Σ of the unknowns
  Eigen::VectorXd slack_sigma_;  // Σ of the slacks
  Eigen::VectorXd compliance_;   // one per row
  Eigen::VectorXd slope_;        // of the barrier function and the rows, with respect to the unknowns
  Eigen::VectorXd slack_slope_;  // with respect to the slacks
  Eigen::VectorXd right_rows_;

  Eigen::VectorXd diagonal_;
  double constant_ = 0.0;  // what fills the diagonal where nothing has a bound
  Eigen::VectorXd no_hessian_;
  int factorisations_ = 0;
  double linear_seconds_ = 0.0;
};

}  // namespace dmocbench::interior_point
