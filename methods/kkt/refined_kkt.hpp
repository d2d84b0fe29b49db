#pragma once

#include <memory>

#include <Eigen/Core>

#include "methods/kkt/kkt_system.hpp"
#include "methods/kkt/newton_residual.hpp"
#include "methods/kkt/refusal_checks.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::kkt {

/// A fast KKT system made safe by iterative refinement and by a fallback to a sparse factorisation with pivoting
/// (sparse_kkt.hpp):
///
/// - A step is refined until its residual is small enough. If refinement does not reach that, the sparse factorisation
///   solves the system.
/// - A step that is `untrusted` or `singular` goes to the sparse factorisation at once.
/// - `wrong_inertia` is accepted where it is certain. Of the others, the sparse factorisation checks those that
///   `RefusalChecks` chooses.
///
/// A residual costs a good part of an elimination (`bench/speed/speed`), so the two steps after an accurate one are not
/// checked, nor the seven after a very accurate one: their matrices differ little, and Newton's method corrects itself.
class RefinedKkt : public KktSystem {
 public:
  /// The default of `accuracy`.
  static constexpr double usual_accuracy = 1e-6;

  /// A step is accurate enough if its residual is at most `accuracy` times the right-hand side, or rounding
  /// (`NewtonResidual::excess`).
  RefinedKkt(const NonlinearProgram& program, std::unique_ptr<KktSystem> fast, double accuracy = usual_accuracy);

  void begin_solve() override;
  [[nodiscard]] FactorisationStatus solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                          const KktStep& step) override;

  /// Corrections by refinement so far.
  [[nodiscard]] int refinements() const noexcept { return refinements_; }
  /// Systems given to the sparse factorisation so far.
  [[nodiscard]] int fallbacks() const noexcept { return fallbacks_; }

 private:
  [[nodiscard]] bool is_accurate(const KktMatrix& matrix, const KktRightHandSide& right_hand_side, const KktStep& step);
  [[nodiscard]] bool refine(KktSystem& kkt, const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                            const KktStep& step);

  const NonlinearProgram& program_;
  std::unique_ptr<KktSystem> fast_;
  std::unique_ptr<KktSystem> robust_;  // made when it is first needed
  NewtonResidual residual_;
  double accuracy_;
  RefusalChecks checks_;
  int unchecked_ = 0;  // coming steps whose residual is not computed
  Eigen::VectorXd primal_correction_;
  Eigen::VectorXd multiplier_correction_;
  int refinements_ = 0;
  int fallbacks_ = 0;
};

}  // namespace dmocbench::kkt
