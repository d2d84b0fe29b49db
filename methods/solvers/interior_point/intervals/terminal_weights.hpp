#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/solvers/interior_point/intervals/interval_entries.hpp"
#include "methods/solvers/interior_point/intervals/segment_kernel.hpp"

namespace dmocbench::interior_point {

/// The weights ρ_i of ½ Σ ρ_i (X_i - d_i)² at the end of every segment. The term is zero where the segment ends at the
/// state d that it has to; without it a segment whose end were free could have a conjugate point, and its elimination
/// no minimum, where the whole problem has one (Finsler: for ρ large enough the two are the same).
///
/// Too large a weight drowns the stiffness a_i that the free unknowns give the end of a segment, and with it the digits
/// of what is joined: the reach of a segment is about 1/(ρ + a). So weights are multiples of the smallest stiffness
/// that was last seen, which moves with the compliance of the free unknowns from one matrix to the next.
class TerminalWeights {
 public:
  explicit TerminalWeights(const IntervalEntries& entries);

  /// For another order of elimination: which unknowns of the intervals it leaves free. (Those that equalities
  /// determine, the slopes of several stages say, may cost nothing; their compliance is not the segment's.)
  void use(const EliminationPlan& plan);
  /// For a new matrix.
  void follow(const NewtonArrays& arrays);
  /// After a failure: takes the next multiple, which stays if it succeeds; false if none is left for this matrix.
  [[nodiscard]] bool try_another();
  /// The next failure is not believed: all multiples are tried.
  void believe_no_failure() noexcept { believed_ = 0; }
  /// Learns the stiffness from the reach Γ of a segment that was eliminated with these weights.
  void learn(const Eigen::MatrixXd& reach);

  /// ρ, one per entry of the state.
  [[nodiscard]] const Eigen::VectorXd& values() const noexcept { return values_; }

 private:
  /// Where the diagonal entries of the Hessian of an unknown of the intervals are.
  struct Diagonal {
    bool moves = false;     ///< is not fixed
    std::size_t first = 0;  ///< of what is added to them
    bool has_hessian = false;
    Source source = Source::hessian;
    std::size_t entry = 0;
    bool is_free = true;
  };
  [[nodiscard]] double compliance_of(const Diagonal& diagonal, const NewtonArrays& arrays) const;
  [[nodiscard]] double stiffness_of_free_unknowns(const NewtonArrays& arrays) const;
  void update();

  std::size_t intervals_;
  std::vector<Diagonal> diagonals_;
  std::size_t level_ = 0;  // which multiple
  std::size_t tried_ = 0;  // others, for this matrix
  int believed_ = 0;       // failures that are still to be believed
  double scale_ = 1.0;
  Eigen::VectorXd stiffness_;  // relative to the scale
  Eigen::VectorXd learned_;    // since the last matrix
  Eigen::VectorXd values_;
};

}  // namespace dmocbench::interior_point
