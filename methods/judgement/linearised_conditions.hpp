#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "methods/judgement/kkt_residual.hpp"
#include "methods/kkt/kkt_system.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

namespace kkt {
class SparseKkt;
}

/// The Karush-Kuhn-Tucker conditions of a program, linearised at a point.
///
/// A bound that the gradient of the Lagrangian points to takes up the gradient with its multiplier, and the linearised
/// complementarity decides whether the unknown moves to the bound: `diagonal` is the multiplier over the distance. An
/// inequality is treated alike with its multiplier: `compliance` is the distance over the multiplier.
struct LinearisedConditions {
  Eigen::VectorXd hessian;                 ///< of the Lagrangian
  Eigen::VectorXd jacobian;                ///< the entries of ∂a/∂ξ
  Eigen::VectorXd diagonal;                ///< one per variable
  Eigen::VectorXd compliance;              ///< one per constraint; `no_part` where nothing holds an inequality
  Eigen::VectorXd gradient_of_cost;        ///< ∇φ
  Eigen::VectorXd gradient_of_lagrangian;  ///< ∇φ + (∂a/∂ξ)ᵀλ
  Eigen::VectorXd gradient;                ///< of the Lagrangian, less the part that bounds balance
  Eigen::VectorXd constraints;             ///< residuals

  LinearisedConditions() = default;
  /// variable_count() and constraint_count() entries.
  LinearisedConditions(NonlinearProgram& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers);
  /// Those at another point of which `evaluate_kkt` left `memory`; allocates nothing where the sizes stay.
  void compute(NonlinearProgram& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers,
               const KktMemory& memory);

  /// True if every number is finite.
  [[nodiscard]] bool is_finite() const;

  /// The compliance of an inequality that takes no part.
  static constexpr double no_part = 1e10;

 private:
  void linearise_bound(Eigen::Index j, double x, double lower, double upper);
  void linearise_constraint(Eigen::Index i, double multiplier, double lower, double upper);
};

/// The matrix of linearised conditions, which must outlive it.
[[nodiscard]] inline kkt::KktMatrix kkt_matrix_of(const LinearisedConditions& at) {
  return {at.hessian, at.jacobian, at.diagonal, at.compliance};
}

/// A way to solve with such a matrix by intervals, in time linear in their number; null where the program's structure
/// does not allow it.
[[nodiscard]] std::unique_ptr<kkt::KktSystem> kkt_system_by_intervals(const NonlinearProgram& program);
/// A sparse factorisation that accepts any point: rounding of the multipliers may hide that it is a minimum.
[[nodiscard]] std::unique_ptr<kkt::SparseKkt> kkt_system_of_any_point(const NonlinearProgram& program);

/// The largest entry of a Hessian between variables that may move, by its entries' values.
[[nodiscard]] double largest_entry(const NonlinearProgram& program, const Eigen::VectorXd& hessian);

/// Whether a value is at a finite bound, up to 1e-6 of its size.
[[nodiscard]] bool is_held(double value, double bound);

/// Constraints whose gradients depend on each other at a point, up to rounding: Σ y_i ∇a_i = 0 over the variables whose
/// bounds differ, with y largest at the first row and at least a tenth of that at the others. Equalities count, and
/// inequalities that are held there. One row means that its derivatives vanish. If there are several dependencies it is
/// one of them. Empty if there is none, or if a number is not finite.
///
/// `point` has variable_count() entries. It takes an elimination by intervals, or one sparse factorisation where that
/// does not show independence, and throws `Stopped` as these do.
[[nodiscard]] std::vector<std::size_t> dependent_rows(NonlinearProgram& program, const Eigen::VectorXd& point);

}  // namespace dmocbench
