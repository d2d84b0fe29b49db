#pragma once

#include <optional>

#include <Eigen/Core>

#include "methods/judgement/kkt_residual.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// A violation that passes an absolute tolerance only because its constraint, or unknown, is stated in tiny units.
struct HiddenViolation {
  bool is_of_bound = false;  ///< of an unknown, not of a constraint
  Eigen::Index number = 0;   ///< of the constraint, or of the unknown
  double size = 0.0;   ///< of the unknown, or Σ_j |∂a_i/∂ξ_j| · size of ξ_j: by how much these could change a_i
  double share = 0.0;  ///< violation / size
};

/// Compares the violation of every constraint, and of every bound of an unknown, with its own size, and finds the
/// worst. Next to a tolerance of 1e-8 any point meets a constraint of size 1e-14.
///
/// The size of an unknown is the largest magnitude in its run of the interval structure (in all unknowns without one),
/// or 1 where that is below 1e-6 of the largest unknown, or of 1: at rest it is not known. In the size of a constraint
/// it is then no more than every equation that it is in allows, given the sizes of the other unknowns there: a rate
/// ẏ = c u is at most c times as large as u. An unknown of all nodes that
/// only adds up others, as an integral does, all its derivatives being 1 or -1, is as large as what is added at most
/// from one node to the next; what its equations miss together is compared with its largest value, too, because many
/// small violations add up to a large one of its last bound. Where all derivatives of a constraint vanish its value
/// stands for its size.
class ConstraintSizes {
 public:
  /// The worst violation above `largest_share`, at a point where `memory` holds the results of `evaluate_kkt`; none if
  /// there is none. Allocates nothing after the first time.
  [[nodiscard]] std::optional<HiddenViolation> hidden_violation(const NonlinearProgram& program,
                                                                const Eigen::VectorXd& primal, const KktMemory& memory);

  // The size of an inequality is, from here on, at least its distance from the nearer bound: a derivative may vanish
  // far from the bound, and a constraint in tiny units is near it in these.

  /// The powers of two that bring constraints smaller than `smallest_size` or larger than its inverse to a size of
  /// about 1, at the point of the last `hidden_violation`; constraint_count() entries, or none where all are 1.
  [[nodiscard]] Eigen::VectorXd factors() const;

  /// True if an inequality is smaller than `smallest_size` there: solvers then stop a visible distance from its bound.
  [[nodiscard]] bool has_small_inequality(const NonlinearProgram& program) const;

  /// See above. A solved row of size 1e-5 or more stays below it.
  static constexpr double largest_share = 1e-3;
  /// See above.
  static constexpr double smallest_size = 1e-5;

 private:
  void add_distances_from_bounds(const NonlinearProgram& program, const Eigen::VectorXd& constraints);
  void measure_unknowns(const NonlinearProgram& program, const Eigen::VectorXd& primal);
  void limit_those_at_rest(const NonlinearProgram& program, const Eigen::VectorXd& primal, const KktMemory& memory);
  void measure_sums(const NonlinearProgram& program, const KktMemory& memory);
  template <class Compare>
  void compare_sums(const NonlinearProgram& program, const Eigen::VectorXd& primal, const KktMemory& memory,
                    const Compare& compare);

  Eigen::VectorXd of_unknowns_;
  Eigen::VectorXd of_rows_;
  Eigen::VectorXd adds_;     // 1 for each unknown that only adds up others
  Eigen::VectorXd of_sums_;  // of each such unknown: its largest row, then what its rows miss
};

}  // namespace dmocbench
