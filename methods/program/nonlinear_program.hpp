#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "methods/program/block_pattern.hpp"
#include "methods/program/interval_structure.hpp"

namespace dmocbench {

/// The sizes below which residuals of a program are rounding: about ε · (size of the terms of a constraint).
///
/// Each constraint and each variable has a floor of its own, so that a constraint whose terms are large excuses nothing
/// elsewhere.
struct RoundingFloors {
  double smallest = 0.0;  ///< of all constraints and variables
  double largest = 0.0;   ///< of all constraints and variables
  /// One for every constraint; empty where all floors are equal.
  Eigen::VectorXd constraints = {};
  /// One for every variable, for its entry of (∂a/∂ξ)ᵀλ with |λ| = 1; empty where all floors are equal.
  Eigen::VectorXd variables = {};

  /// True if one floor holds for all.
  [[nodiscard]] bool are_equal() const noexcept { return constraints.size() == 0; }
  /// The floor of constraint i.
  [[nodiscard]] double of_constraint(Eigen::Index i) const { return are_equal() ? largest : constraints[i]; }
  /// The Euclidean norm of the floors of all `count` constraints.
  [[nodiscard]] double norm_of_constraints(Eigen::Index count) const {
    return are_equal() ? largest * std::sqrt(static_cast<double>(count)) : constraints.norm();
  }
  /// The floor of variable j.
  [[nodiscard]] double of_variable(Eigen::Index j) const { return are_equal() ? largest : variables[j]; }
};

/// "No bound" on one side.
inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// A vector that is read, or written, in place: an Eigen vector or a map of someone else's memory.
using VectorIn = Eigen::Ref<const Eigen::VectorXd>;
/// The same to be written.
using VectorOut = Eigen::Ref<Eigen::VectorXd>;

/// A nonlinear program, (NLP) of the paper with constants in the bounds:
///
///   minimise φ(ξ)  such that  a⁻ <= a(ξ) <= a⁺,  ξ⁻ <= ξ <= ξ⁺.
///
/// An equality is a constraint whose two bounds are equal; a variable whose two bounds are equal is fixed. The
/// Lagrangian is σφ + λᵀa: multipliers carry the sign that makes ∇φ + (∂a/∂ξ)ᵀλ vanish in the directions of the free
/// variables.
///
/// Sizes and structures never change, nor does which bounds exist and which are equal; the values of bounds may change
/// between two solves. Evaluations allocate nothing; they are not to be called from two threads at once.
class NonlinearProgram {
 public:
  virtual ~NonlinearProgram() = default;
  NonlinearProgram(const NonlinearProgram&) = delete;
  NonlinearProgram& operator=(const NonlinearProgram&) = delete;

  /// Number of unknowns ξ.
  [[nodiscard]] virtual std::size_t variable_count() const = 0;
  /// Number of constraints, the entries of a.
  [[nodiscard]] virtual std::size_t constraint_count() const = 0;

  [[nodiscard]] virtual const Eigen::VectorXd& variable_lower() const = 0;    ///< ξ⁻, variable_count() entries.
  [[nodiscard]] virtual const Eigen::VectorXd& variable_upper() const = 0;    ///< ξ⁺, variable_count() entries.
  [[nodiscard]] virtual const Eigen::VectorXd& constraint_lower() const = 0;  ///< a⁻, constraint_count() entries.
  [[nodiscard]] virtual const Eigen::VectorXd& constraint_upper() const = 0;  ///< a⁺, constraint_count() entries.

  /// ∂a_i/∂ξ_j.
  [[nodiscard]] virtual const BlockPattern& jacobian_structure() const = 0;
  /// Lower triangle (row >= column) of the Hessian of the Lagrangian. A run lies on the diagonal, or does not touch it.
  [[nodiscard]] virtual const BlockPattern& hessian_structure() const = 0;

  /// φ(x). `x` has variable_count() entries, here and below.
  [[nodiscard]] virtual double objective(const VectorIn& x) = 0;
  /// `result`: variable_count() entries.
  virtual void gradient(const VectorIn& x, VectorOut result) = 0;
  /// `result`: constraint_count() entries.
  virtual void constraints(const VectorIn& x, VectorOut result) = 0;
  /// `values`: one per entry of jacobian_structure().
  virtual void jacobian(const VectorIn& x, VectorOut values) = 0;
  /// Hessian of objective_factor · φ + λᵀa; `values`: one per entry of hessian_structure().
  virtual void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) = 0;

  /// The sizes below which residuals of this program are rounding; by default 0.
  [[nodiscard]] virtual const RoundingFloors& rounding_floors() const {
    static const RoundingFloors none;
    return none;
  }

  /// The places of unknowns and constraints on the grid; null if the program has no such structure.
  [[nodiscard]] virtual const IntervalStructure* interval_structure() const { return nullptr; }

 protected:
  NonlinearProgram() = default;
};

/// Whether the two bounds of a variable are equal.
[[nodiscard]] inline bool is_fixed(const NonlinearProgram& program, Eigen::Index variable) {
  return program.variable_lower()[variable] == program.variable_upper()[variable];
}

/// Number of variables whose two bounds differ.
[[nodiscard]] inline std::size_t free_variable_count(const NonlinearProgram& program) {
  return static_cast<std::size_t>((program.variable_lower().array() != program.variable_upper().array()).count());
}

/// Forwards every call to another program, which must outlive it. Derived classes override some of them.
class ForwardingProgram : public NonlinearProgram {
 public:
  [[nodiscard]] std::size_t variable_count() const override { return original_.variable_count(); }
  [[nodiscard]] std::size_t constraint_count() const override { return original_.constraint_count(); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return original_.variable_lower(); }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return original_.variable_upper(); }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return original_.constraint_lower(); }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return original_.constraint_upper(); }
  [[nodiscard]] const BlockPattern& jacobian_structure() const override { return original_.jacobian_structure(); }
  [[nodiscard]] const BlockPattern& hessian_structure() const override { return original_.hessian_structure(); }
  [[nodiscard]] const RoundingFloors& rounding_floors() const override { return original_.rounding_floors(); }
  [[nodiscard]] const IntervalStructure* interval_structure() const override { return original_.interval_structure(); }

  [[nodiscard]] double objective(const VectorIn& x) override { return original_.objective(x); }
  void gradient(const VectorIn& x, VectorOut result) override { original_.gradient(x, result); }
  void constraints(const VectorIn& x, VectorOut result) override { original_.constraints(x, result); }
  void jacobian(const VectorIn& x, VectorOut values) override { original_.jacobian(x, values); }
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override {
    original_.hessian(x, objective_factor, multipliers, values);
  }

 protected:
  /// It must outlive this.
  explicit ForwardingProgram(NonlinearProgram& original) : original_(original) {}
  /// The original program.
  [[nodiscard]] NonlinearProgram& original() const noexcept { return original_; }

 private:
  NonlinearProgram& original_;
};

}  // namespace dmocbench
