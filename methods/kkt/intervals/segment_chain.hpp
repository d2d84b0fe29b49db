#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace dmocbench::kkt {

/// The inertia that the factorisation of a small symmetric matrix shows.
struct DenseInertia {
  bool is_singular = false;
  bool is_certain = false;  ///< no eigenvalue of the scaled matrix is near zero
  Eigen::Index negative = 0;
};

/// Memory for `solve_symmetric`, used again from system to system.
struct SymmetricWork {
  /// Takes the memory for systems of `size` unknowns, unless already allocated.
  void make(Eigen::Index size);

  Eigen::VectorXd scale;
  std::vector<int> pivots;
  Eigen::VectorXd numbers;
};

/// Solves a dense symmetric, possibly indefinite system in place (LAPACK's Bunch-Kaufman factors, after scaling rows
/// and columns alike), and counts negative eigenvalues. `matrix`: its lower triangle is read, then overwritten.
[[nodiscard]] DenseInertia solve_symmetric(Eigen::MatrixXd& matrix, Eigen::VectorXd& right_hand_side,
                                           SymmetricWork& work);

/// A stretch of the horizon as seen from its ends: the value of its inside as a function of the state X at its
/// first node and of the multiplier ν of the condition that its last node has a given state d,
///
///   ½ XᵀPX + pᵀX + νᵀ(ΦᵀX + γ - d) - ½ νᵀΓν - ½ Σ ρ_i d_i².
///
/// P, Φ, Γ: X x X.
struct SegmentValue {
  Eigen::MatrixXd P;
  Eigen::VectorXd p;
  Eigen::MatrixXd Phi;
  Eigen::MatrixXd Gamma;
  Eigen::VectorXd gamma;
};

/// Joins neighbouring segments, from the last to the first, to the value of the whole horizon.
class SegmentChain {
 public:
  /// `terminal_weights` are the ρ_i (terminal_weights.hpp).
  void start(const SegmentValue& last, const Eigen::VectorXd& terminal_weights);
  /// Puts a segment in front whose pivots were all positive. False if eliminating the state between gives no minimum;
  /// then the chain stays as it was.
  [[nodiscard]] bool join(const SegmentValue& segment);
  /// Puts any segment in front, and counts. False if rounding hides the inertia of the eliminated block; then the chain
  /// stays as it was.
  [[nodiscard]] bool join_and_count(const SegmentValue& segment);
  /// Negative eigenvalues of the blocks that the joins eliminated, beyond their number at a minimum.
  [[nodiscard]] Eigen::Index negative() const noexcept { return negative_; }

  [[nodiscard]] const SegmentValue& total() const noexcept { return total_; }

  /// States and multipliers of all segments, first to last, from X at the first node and ν of the last: column s for
  /// segment s.
  void back_substitute(const Eigen::VectorXd& state, const Eigen::VectorXd& multiplier, Eigen::MatrixXd& states,
                       Eigen::MatrixXd& multipliers) const;

 private:
  /// A join as `back_substitute` needs it: y = state (X, ν, 1), and the multiplier of the segment in front, ν' =
  /// stiffness y + mixed ν + constant.
  struct Join {
    Eigen::MatrixXd state;
    Eigen::MatrixXd stiffness;
    Eigen::MatrixXd mixed;
    Eigen::VectorXd constant;
  };

  enum class Between : unsigned char { must_be_minimum, may_be_saddle };
  [[nodiscard]] bool join(const SegmentValue& segment, Between between);
  template <int size, int most>
  [[nodiscard]] bool join_sized(const SegmentValue& segment, Between between);

  Eigen::VectorXd terminal_weights_;
  SegmentValue total_;
  std::vector<Join> joins_;  // last to first; the first `count_` of them are of this chain
  std::size_t count_ = 0;
  Eigen::Index negative_ = 0;
  Eigen::MatrixXd between_;  // of `join_and_count`
  Eigen::VectorXd no_side_;
  SymmetricWork work_;
};

}  // namespace dmocbench::kkt
