#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/intervals/interval_kkt.hpp"
#include "methods/solvers/interior_point/intervals/momentum_pairs.hpp"
#include "methods/solvers/interior_point/intervals/recombined_program.hpp"
#include "methods/solvers/interior_point/intervals/selection.hpp"
#include "methods/solvers/interior_point/kkt_system.hpp"

namespace dmocbench::interior_point {

/// The KKT system of the midpoint rule on (q, p), eliminated by DMOC's recursion: row 1 ∓ (h/2) row 2 of an interval
/// (momentum_pairs.hpp) are DMOC's rows p_k + left = 0 and p_{k+1} - right = 0, so that the momenta between the ends
/// drop out and `IntervalKkt` works on n unknowns per node instead of 2n. The combinations are taken with the numbers
/// of the Jacobian, not with h, and are exact for any residual; a multiplier η_k of the combined row of node k gives
/// back
///
///   row 1: a(η_k - η_{k+1}),  row 2: -(h/2)(η_k + η_{k+1}) at a = 1.
///
/// What a solver adds to the Hessian's diagonal at a momentum between the ends is left out: a shift acts on (q, u)
/// only. This is enough for its purpose, for no direction along the rows moves momenta alone; but where a shift is
/// needed, and in steps towards the rows, the steps are others than those of the unshifted elimination.
class RecombinedKkt final : public KktSystem {
 public:
  /// Null, with the reason in `why`, for a program that is no such rule.
  [[nodiscard]] static std::unique_ptr<RecombinedKkt> make(const NonlinearProgram& program, std::string& why,
                                                           SegmentKernelChoice choose = segment_kernel_for);

  RecombinedKkt(const NonlinearProgram& program, std::vector<MomentumPair> pairs, SegmentKernelChoice choose);

  [[nodiscard]] FactorisationStatus solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                          const KktStep& step) override;

  /// Multiplications and divisions per interval that combining the matrix takes, before it is eliminated.
  [[nodiscard]] double combination_operations() const;
  /// Of what is eliminated.
  [[nodiscard]] const Shape& shape() const noexcept { return system_->shape(); }

 private:
  /// Per interval, how the rows of a pair combine to one that has a single momentum: p_k (left) or -p_{k+1} (right).
  using Combination = std::array<Eigen::ArrayXd, 2>;
  struct Combinations {
    Combination left;
    Combination right;
    Eigen::ArrayXXd left_columns;  // of the pair, in the left combination; one row per interval
  };

  [[nodiscard]] bool find_combinations(const Eigen::VectorXd& jacobian);
  void combine_jacobian(const Eigen::VectorXd& jacobian);
  void combine_rows(const Eigen::VectorXd& rows);
  void move_slope(const Eigen::VectorXd& slope);
  void read_momenta(const Eigen::VectorXd& rows, Eigen::VectorXd& primal_step);
  void read_multipliers(const Eigen::VectorXd& slope, Eigen::VectorXd& multiplier_step);

  std::vector<MomentumPair> pairs_;
  RecombinedProgram recombined_;
  std::unique_ptr<IntervalKkt> system_;
  Selection unknowns_;  // of the program: ours
  Selection kept_rows_;
  Selection kept_entries_;
  Eigen::Index intervals_;
  std::vector<Combinations> combinations_;  // one per pair

  Eigen::ArrayXd scratch_;  // one number per interval

  // The system that is solved instead.
  Eigen::VectorXd jacobian_;
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd compliance_;
  Eigen::VectorXd slope_;
  Eigen::VectorXd rows_;
  Eigen::VectorXd primal_step_;
  Eigen::VectorXd multiplier_step_;
  Eigen::VectorXd all_slopes_;  // of the program's unknowns, with momenta taken out
};

}  // namespace dmocbench::interior_point
