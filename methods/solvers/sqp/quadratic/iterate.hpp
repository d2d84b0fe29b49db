#pragma once

#include <stdexcept>
#include <vector>

#include <Eigen/Core>

#include "methods/solvers/sqp/quadratic/basis.hpp"
#include "methods/solvers/sqp/quadratic/quadratic_program.hpp"
#include "methods/solvers/sqp/quadratic/working_set.hpp"

namespace dmocbench::sqp {

/// Thrown where the basis is singular or the reduced Hessian not positive definite: the quadratic program cannot be
/// solved from these sets.
class Breakdown : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A point (d, s) of the active-set method with its sets. A d = s always holds: the basic columns follow from the
/// others.
class Iterate {
 public:
  /// All columns that are not basic are at 0, or at the bound nearest to 0. Throws `Breakdown` if the basis is
  /// singular.
  Iterate(const QuadraticProgram& program, WorkingSet sets, double feasibility_tolerance);

  [[nodiscard]] const QuadraticProgram& program() const noexcept { return *program_; }
  [[nodiscard]] const WorkingSet& sets() const noexcept { return sets_; }
  [[nodiscard]] const BasisFactorisation& basis() const noexcept { return basis_; }
  [[nodiscard]] double tolerance() const noexcept { return tolerance_; }
  /// (d, s), n + m entries.
  [[nodiscard]] const Eigen::VectorXd& values() const noexcept { return values_; }
  [[nodiscard]] Eigen::VectorXd variables() const { return values_.head(program_->variable_count()); }
  /// The bounds in force: the program's, except where `accept_violations` widened them.
  [[nodiscard]] const Eigen::VectorXd& lower() const noexcept { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const noexcept { return upper_; }

  /// Sum over all columns of the distance to their bounds, where it exceeds the tolerance.
  [[nodiscard]] double infeasibility() const;
  /// The entries of a vector over all columns that belong to the basic ones, in the order of positions.
  [[nodiscard]] Eigen::VectorXd at_basics(const Eigen::VectorXd& of_columns) const {
    return of_columns(sets_.basics());
  }
  /// The same for the superbasic ones.
  [[nodiscard]] Eigen::VectorXd at_superbasics(const Eigen::VectorXd& of_columns) const {
    return of_columns(sets_.superbasics());
  }
  /// gᵀd + ½ dᵀHd.
  [[nodiscard]] double objective() const;

  // The null space of A d - s = 0 with the nonbasic columns at rest has the basis Z = (-B⁻¹S; I; 0): one direction per
  // superbasic column. Z is never stored.

  /// Z w, for a vector over the superbasic columns: all n + m columns.
  [[nodiscard]] Eigen::VectorXd null_space_times(const Eigen::VectorXd& of_superbasics) const;
  /// Zᵀ w, for a vector over the n variables: one entry per superbasic column.
  [[nodiscard]] Eigen::VectorXd null_space_transposed_times(const Eigen::VectorXd& of_variables) const;
  /// ZᵀHZ, dense.
  [[nodiscard]] Eigen::MatrixXd reduced_hessian() const;

  /// Moves all columns by `step` times `direction` (n + m entries).
  void move(const Eigen::VectorXd& direction, double step) { values_ += step * direction; }
  /// Puts a column exactly onto the bound that it has reached.
  void put_on_bound(Eigen::Index column, bool at_upper) {
    values_[column] = at_upper ? upper_[column] : lower_[column];
  }

  void make_superbasic(Eigen::Index column) { sets_.make_superbasic(column); }
  void drop_superbasic(Eigen::Index place) { sets_.drop_superbasic(place); }
  /// `entering` takes the basic place at `position`; `solved` = B⁻¹ (its column). Throws `Breakdown`.
  void replace_basic(Eigen::Index position, Eigen::Index entering, const Eigen::VectorXd& solved);

  /// Chooses a well-conditioned basis among the basic and superbasic columns; the point stays. Throws `Breakdown`.
  void choose_basis_again();

  /// Widens the bounds of columns that violate them to their present values: elastic mode with an infinite weight.
  void accept_violations();

 private:
  void refactorise();

  const QuadraticProgram* program_;
  WorkingSet sets_;
  double tolerance_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::VectorXd values_;
  BasisFactorisation basis_;
};

}  // namespace dmocbench::sqp
