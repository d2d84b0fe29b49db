#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "methods/solvers/sqp/quadratic/basis.hpp"
#include "methods/solvers/sqp/quadratic/quadratic_program.hpp"

namespace dmocbench::sqp {

/// Which of the n + m columns of (A, -I) are basic (m, in the order of the positions of the basis), superbasic (free to
/// move, one per degree of freedom in use) or nonbasic (held at their present value).
///
/// Every change below moves at most one column into a set and one out of it.
class WorkingSet {
 public:
  enum class Membership : std::uint8_t { basic, superbasic, nonbasic };

  WorkingSet(Eigen::Index columns, std::vector<Eigen::Index> basics, std::vector<Eigen::Index> superbasics)
      : basics_(std::move(basics)),
        superbasics_(std::move(superbasics)),
        membership_(static_cast<std::size_t>(columns), Membership::nonbasic) {
    for (const Eigen::Index j : basics_) at(j) = Membership::basic;
    for (const Eigen::Index j : superbasics_) at(j) = Membership::superbasic;
  }

  [[nodiscard]] const std::vector<Eigen::Index>& basics() const noexcept { return basics_; }
  [[nodiscard]] const std::vector<Eigen::Index>& superbasics() const noexcept { return superbasics_; }
  [[nodiscard]] Membership of(Eigen::Index j) const { return membership_[static_cast<std::size_t>(j)]; }

  /// A nonbasic column may move from now on.
  void make_superbasic(Eigen::Index j) {
    at(j) = Membership::superbasic;
    superbasics_.push_back(j);
  }

  /// The superbasic column at `place` in the list stays where it is from now on.
  void drop_superbasic(Eigen::Index place) {
    const auto position = superbasics_.begin() + place;
    at(*position) = Membership::nonbasic;
    superbasics_.erase(position);
  }

  /// Column `entering`, nonbasic or superbasic, takes the place of the basic column at `position`, which becomes
  /// nonbasic.
  void replace_basic(Eigen::Index position, Eigen::Index entering) {
    if (of(entering) == Membership::superbasic) std::erase(superbasics_, entering);
    Eigen::Index& place = basics_[static_cast<std::size_t>(position)];
    at(place) = Membership::nonbasic;
    at(entering) = Membership::basic;
    place = entering;
  }

 private:
  Membership& at(Eigen::Index j) { return membership_[static_cast<std::size_t>(j)]; }

  std::vector<Eigen::Index> basics_;
  std::vector<Eigen::Index> superbasics_;
  std::vector<Membership> membership_;
};

/// Thrown where the basis is singular or the reduced Hessian not positive definite: the quadratic program cannot be
/// solved from these sets.
class Breakdown : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A point (d, s) of the active-set method with its sets. A d = s always holds: the basic columns follow from the
/// others.
class QuadraticIterate {
 public:
  /// All columns that are not basic are at 0, or at the bound nearest to 0. Throws `Breakdown` if the basis is
  /// singular.
  QuadraticIterate(const QuadraticProgram& program, WorkingSet sets, double tolerance);

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

  /// The bound that a column leaves by more than the tolerance: -1 the lower one, 1 the upper one, 0 none.
  [[nodiscard]] int violated_side(Eigen::Index column) const {
    if (values_[column] < lower_[column] - tolerance_) return -1;
    return values_[column] > upper_[column] + tolerance_ ? 1 : 0;
  }
  /// Sum over all columns of the distance to their bounds, where it exceeds the tolerance.
  [[nodiscard]] double infeasibility() const;
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
  /// Replaces the basic column at `position` by the column `entering`; `solved` is B⁻¹ times that column. Throws
  /// `Breakdown` if the new basis is singular.
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
