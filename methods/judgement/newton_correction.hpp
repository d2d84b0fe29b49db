#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <Eigen/Core>

#include "methods/judgement/kkt_residual.hpp"
#include "methods/judgement/linearised_conditions.hpp"
#include "methods/kkt/kkt_system.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

namespace kkt {
class NewtonResidual;
}

/// A Newton step from a point near an optimum towards it.
struct NewtonCorrection {
  Eigen::VectorXd primal;       ///< δξ, variable_count() entries
  Eigen::VectorXd multipliers;  ///< δλ, constraint_count() entries
  /// Its length, see `NewtonCorrections`.
  double length = 0.0;
  /// The same without the unknowns that are values of a control.
  double length_of_state = 0.0;
};

/// The largest Newton step, relative to the answer, at which an answer is settled.
inline constexpr double settled = 1e-4;

/// The distance of answers of a program from the point where the Karush-Kuhn-Tucker conditions hold exactly, to first
/// order: the error of an answer that small residuals still permit. Where the cost is flat, or a step h is small,
/// residuals at the tolerance may leave an unknown wrong in its second digit.
///
/// The step solves the linearised conditions. A bound that the gradient points to takes up the gradient with its
/// multiplier, and the linearised complementarity decides whether the unknown moves to the bound; an inequality is
/// treated alike with its multiplier. `length` is the largest of
///
///   max |δξ_j| / max |ξ_j| over the unknowns of one run of the interval structure (over all unknowns without one),
///   |∇φ δξ| / max(1, |φ|),
///
/// where a run counts as at least `smallest_share` of the largest unknown, and of 1, the size that unknowns should
/// have: at rest they are rounding, and so is a step. φ is scaled as the solver sees it.
class NewtonCorrections {
 public:
  /// The factorisation of the linear systems.
  enum class Factorisation : std::uint8_t {
    by_intervals,  ///< where the program's structure allows it, in time linear in the intervals, long steps refined,
                   ///< since elimination by intervals does not pivot across them; otherwise, and where that fails,
                   ///< sparse
    sparse,        ///< with pivoting: slower, and the last digits are better
  };

  /// The program must outlive this.
  explicit NewtonCorrections(NonlinearProgram& program, Factorisation factorisation = Factorisation::by_intervals);
  ~NewtonCorrections();
  NewtonCorrections(const NewtonCorrections&) = delete;
  NewtonCorrections& operator=(const NewtonCorrections&) = delete;

  /// The length of the step from `primal`, see `at` and `length_of_state`; `memory` holds the results of `evaluate_kkt`
  /// at this point. Allocates nothing after the first time unless elimination by intervals fails without a shift.
  [[nodiscard]] std::optional<double> length_at(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers,
                                                const KktMemory& memory);
  /// The step from `primal` (variable_count() entries) with `multipliers` (constraint_count() entries). Of infinite
  /// length where a derivative is not finite; none where the matrix is singular or its factorisation fails. Throws
  /// `Stopped` where the `StopScope` of the thread ends that.
  [[nodiscard]] std::optional<NewtonCorrection> at(const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers);

  /// True where the matrix of the last step is positive definite along the equalities. Where it is not, or is singular,
  /// rounding or directions without curvature may be the reason (`negative_curvature` of `conditions()` decides).
  [[nodiscard]] bool has_minimum() const noexcept { return has_minimum_; }
  /// The linearised conditions at the last point.
  [[nodiscard]] const LinearisedConditions& conditions() const noexcept { return conditions_; }

  /// `NewtonCorrection::length_of_state` of the last step.
  [[nodiscard]] double length_of_state() const noexcept { return step_.length_of_state; }

  /// See above: a run of small unknowns counts as at least this share of the largest one, or of 1.
  static constexpr double smallest_share = 1e-6;

 private:
  void measure_step(const Eigen::VectorXd& primal, const Eigen::VectorXd& gradient);
  [[nodiscard]] bool refine_step(const kkt::KktMatrix& eliminated);

  NonlinearProgram& program_;
  std::unique_ptr<kkt::KktSystem> by_intervals_;  // until it fails once
  std::unique_ptr<kkt::SparseKkt> pivoting_;      // made when it is first needed
  bool has_minimum_ = false;
  LinearisedConditions conditions_;
  std::unique_ptr<kkt::NewtonResidual> residual_;  // made when it is first needed
  NewtonCorrection step_;                          // the last one
};

}  // namespace dmocbench
