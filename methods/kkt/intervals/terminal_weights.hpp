#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "methods/kkt/intervals/interval_entries.hpp"
#include "methods/kkt/intervals/segment_kernel.hpp"

namespace dmocbench::kkt {

/// The weights ρ_i of ½ Σ ρ_i (X_i - d_i)² at the end of every segment. The term is zero where the segment ends at the
/// given state d, and prevents conjugate points inside (Finsler; README.md, "Terminal weights").
///
/// The reachability Γ of a segment is about 1/(ρ + a), a_i being the stiffness that the free unknowns give its end. Too
/// large a weight swamps a_i, and with it the digits of the join. So weights are multiples of the smallest stiffness
/// that was last observed, rescaled from matrix to matrix by the compliance of the free unknowns.
class TerminalWeights {
 public:
  explicit TerminalWeights(const IntervalEntries& entries);

  /// Takes another order of elimination and the unknowns of the intervals that it leaves free. (Unknowns that
  /// equalities determine, such as stage rates, may cost nothing; their compliance is not the segment's.)
  void use(const EliminationPlan& plan);
  /// Forgets all observations and trials.
  void forget();
  /// Adapts the weights to a new matrix.
  void rescale(const NewtonArrays& arrays);
  /// The same where the compliances of the free unknowns are known, one per entry of `free_diagonals()`.
  void rescale(const std::vector<double>& compliances);

  /// The diagonal entry of the matrix that a moving unknown of the intervals has: `added` (of d) and, where it has one,
  /// the Hessian's. Their sum c, interval by interval, makes its compliance Σ 1/(|c| + negligible_curvature).
  struct Diagonal {
    LocalEntry added{};
    std::optional<LocalEntry> hessian;
    bool is_free = true;
  };
  static constexpr double negligible_curvature = 1e-12;
  /// The diagonal entries of unknowns that the order of elimination leaves free.
  [[nodiscard]] std::vector<Diagonal> free_diagonals() const;
  /// Chooses the multiple to try after a failure: the next larger one, and after the largest the smallest. A multiple
  /// that succeeds stays in use. Returns false if all multiples, the largest among them, have failed for this matrix.
  [[nodiscard]] bool next_multiple();
  /// Chooses the largest multiple, which stays in use; false if it was in use already.
  [[nodiscard]] bool take_largest();
  /// Begins with the middle multiple, which suits a segment that is the whole horizon: it is joined to no other
  /// segment, so the digits of the reachability that a larger weight cancels matter less.
  void prefer_middle() noexcept;
  /// The next matrix begins with a larger multiple, unless this one is the middle one or larger.
  void raise() noexcept;
  /// All multiples are tried after the next failure.
  void distrust_next_failure() noexcept { believed_ = 0; }
  /// Reads the stiffness off the reachability Γ of a segment that was eliminated with these weights.
  void observe(const Eigen::MatrixXd& Gamma);

  /// ρ, one per entry of the state.
  [[nodiscard]] const Eigen::VectorXd& values() const noexcept { return values_; }

 private:
  [[nodiscard]] double compliance_of(const Diagonal& diagonal, const NewtonArrays& arrays) const;
  [[nodiscard]] double stiffness_of_free_unknowns(const std::vector<double>& compliances) const;
  void take(std::size_t level);
  void update();

  Eigen::Index intervals_;
  std::vector<Diagonal> diagonals_;
  std::vector<double> compliances_;  // of the free ones, for the last matrix
  std::size_t level_ = 0;            // which multiple
  std::size_t tried_ = 0;            // others, for this matrix
  int believed_ = 0;                 // next failures of the largest that are accepted without smaller ones
  double scale_ = 1.0;
  Eigen::VectorXd stiffness_;  // relative to the scale
  Eigen::VectorXd observed_;   // since the last matrix
  Eigen::VectorXd values_;
};

}  // namespace dmocbench::kkt
