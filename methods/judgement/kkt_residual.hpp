#pragma once

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// The residuals of the Karush-Kuhn-Tucker conditions at a point, computed from the program alone.
struct KktResidual {
  /// Largest entry of ∇φ + (∂a/∂ξ)ᵀλ over the free variables, and largest multiplier of an inequality. Where a bound at
  /// the distance d may take up an entry g, |g| min(1, d) counts: stationarity without its multiplier, complementarity
  /// with it. (The projected gradient min(|g|, d) would require of a weakly active bound, g and d both small, the
  /// square of the solvers' tolerance.)
  double stationarity = 0.0;
  /// Largest amount by which a constraint or a variable leaves its bounds.
  double constraint_violation = 0.0;
};

/// The entries that `KktResidual` holds the largest of.
struct KktEntries {
  Eigen::VectorXd gradient;     ///< stationarity of every variable
  Eigen::VectorXd multipliers;  ///< stationarity of every constraint's slack; 0 of equalities
  Eigen::VectorXd rows;         ///< violation of every constraint
  double bounds = 0.0;          ///< largest violation of a bound of a variable
};

/// Memory for residuals that are computed again and again: after the first time nothing is allocated.
/// The data that they were computed from stay there.
struct KktMemory {
  Eigen::VectorXd constraints;       ///< a, an entry per constraint
  Eigen::VectorXd gradient_of_cost;  ///< ∇φ, an entry per variable
  Eigen::VectorXd gradient;          ///< of the Lagrangian
  Eigen::VectorXd jacobian;          ///< the entries of ∂a/∂ξ
};

/// Evaluates the program at `primal` with `multipliers`.
void evaluate_kkt(NonlinearProgram& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers,
                  KktMemory& memory);

/// The residual at `primal` (variable_count() entries) with `multipliers` (constraint_count() entries).
/// NaN where the program gives NaN. Throws `Error` if a size is wrong, as all functions here do.
[[nodiscard]] KktResidual kkt_residual(NonlinearProgram& program, const Eigen::VectorXd& primal,
                                       const Eigen::VectorXd& multipliers, KktMemory& memory);
/// The same with memory of its own.
[[nodiscard]] inline KktResidual kkt_residual(NonlinearProgram& program, const Eigen::VectorXd& primal,
                                              const Eigen::VectorXd& multipliers) {
  KktMemory memory;
  return kkt_residual(program, primal, multipliers, memory);
}

/// The same entry by entry, where constraints and variables are allowed residuals of their own (`RoundingFloors`).
void kkt_entries(NonlinearProgram& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers,
                 KktMemory& memory, KktEntries& entries);

/// The constraint violation alone.
[[nodiscard]] double constraint_violation(NonlinearProgram& program, const Eigen::VectorXd& primal);

/// Multipliers for a point that has none: the λ that minimises |∇φ + (∂a/∂ξ)ᵀλ|₂ over the variables that are
/// neither fixed nor at a bound. An inequality that is not at a bound gets 0.
///
/// "At a bound" means closer than `activity_tolerance` · max(1, |bound|). Signs are not imposed: the residual of the
/// result shows a sign that is wrong, as it shows a point that is not stationary. At a KKT point whose active
/// constraints are independent these are the multipliers; where they depend on each other, one of many choices.
///
/// `primal` has variable_count() entries, the result constraint_count(), all NaN where the program gives NaN or
/// infinity.
[[nodiscard]] Eigen::VectorXd least_squares_multipliers(NonlinearProgram& program, const Eigen::VectorXd& primal);

/// The same where some multipliers are known. Entries of `known` (constraint_count() of them) that are NaN are chosen
/// to minimise the remaining gradient. An inequality that comes no nearer to a bound than 1e-3 · max(1, |bound|)
/// gets 0, as does one whose multiplier would have the wrong sign; variables that near to a bound do not count.
[[nodiscard]] Eigen::VectorXd complete_multipliers(NonlinearProgram& program, const Eigen::VectorXd& primal,
                                                   const Eigen::VectorXd& known);

/// The distance from a bound below which a variable or a constraint counts as active; see above.
inline constexpr double activity_tolerance = 1e-8;

/// True at a point that violates constraints and where, to first order, no step within the bounds of the variables
/// reduces the violation: with r the amounts by which constraints leave their bounds, all steps of at most max(1, |ξᵢ|)
/// in each variable change ½|r|² by less than `least_violation_share` · |r|². `primal` has variable_count() entries;
/// false where a number is not finite.
[[nodiscard]] bool is_point_of_least_violation(NonlinearProgram& program, const Eigen::VectorXd& primal);

/// See above; rounding leaves a gradient of the violation everywhere.
inline constexpr double least_violation_share = 1e-3;

}  // namespace dmocbench
