#include "methods/kkt/refined_kkt.hpp"

#include <utility>

#include "methods/kkt/sparse_kkt.hpp"
#include "methods/runtime/long_vectors.hpp"

namespace dmocbench::kkt {

namespace {

constexpr int most_refinements = 5;
/// A refinement that leaves more than this share of the excess is the last one.
constexpr double worthwhile = 0.3;
/// The excess at which a step is still used: Newton's method gains a digit per iteration with it.
constexpr double tolerable = 1e5;
/// The excess below which a step is very accurate, and how many coming steps are then not checked.
constexpr double very_accurate = 1e-2;
constexpr int unchecked_after_accurate = 2;
constexpr int unchecked_after_very_accurate = 7;
/// The number of sparse factorisations after which the order that MUMPS finds has repaid the time to find it.
constexpr int repaid_after = 4;

}  // namespace

RefinedKkt::RefinedKkt(const NonlinearProgram& program, std::unique_ptr<KktSystem> fast, double accuracy)
    : program_(program), fast_(std::move(fast)), residual_(program), accuracy_(accuracy) {}

void RefinedKkt::begin_solve() {
  fast_->begin_solve();
  checks_.forget();
  unchecked_ = 0;
}

FactorisationStatus RefinedKkt::solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                      const KktStep& step) {
  const FactorisationStatus status = fast_->solve(matrix, right_hand_side, step);
  const bool is_refusal = status == FactorisationStatus::wrong_inertia;
  if (is_refusal && (fast_->is_certain() || !checks_.ask())) return status;
  if (status == FactorisationStatus::solved && is_accurate(matrix, right_hand_side, step)) {
    checks_.end_matrix();
    return status;
  }
  if (!robust_) robust_ = std::make_unique<SparseKkt>(program_, SparseKkt::Order::along_the_horizon);
  if (fallbacks_++ == repaid_after) robust_ = std::make_unique<SparseKkt>(program_, SparseKkt::Order::found);
  const FactorisationStatus robust = robust_->solve(matrix, right_hand_side, step);
  if (robust != FactorisationStatus::solved) return robust;
  // Rounding may hide dependent constraints from its pivots, but not from the residual of its step.
  if (!refine(*robust_, matrix, right_hand_side, step)) return FactorisationStatus::singular;
  if (is_refusal) checks_.contradict();
  checks_.end_matrix();
  return robust;
}

/// Refines a step of the fast system, or accepts it without a check if the steps before it were accurate.
bool RefinedKkt::is_accurate(const KktMatrix& matrix, const KktRightHandSide& right_hand_side, const KktStep& step) {
  if (unchecked_ > 0) {
    --unchecked_;
    return true;
  }
  return refine(*fast_, matrix, right_hand_side, step);
}

/// Refines a step of `kkt`; false if its residual stays above `tolerable`.
bool RefinedKkt::refine(KktSystem& kkt, const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                        const KktStep& step) {
  const auto excess_of_step = [&] {
    residual_.compute(matrix, right_hand_side, step);
    return residual_.excess(matrix, step, accuracy_);
  };
  double excess = excess_of_step();
  const bool is_fast = &kkt == fast_.get();
  if (is_fast && excess <= 1.0) {
    unchecked_ = excess <= very_accurate ? unchecked_after_very_accurate : unchecked_after_accurate;
  }
  if (is_fast && excess > tolerable) {
    // A solve updates the terminal weights of the elimination by intervals, so a second one may succeed.
    if (kkt.solve(matrix, right_hand_side, step) != FactorisationStatus::solved) return false;
    excess = excess_of_step();
  }
  for (int i = 0; i < most_refinements && excess > 1.0; ++i) {
    resize_unwritten(primal_correction_, step.primal.size());
    resize_unwritten(multiplier_correction_, step.multipliers.size());
    ++refinements_;
    if (kkt.solve(matrix, residual_.value(), {primal_correction_, multiplier_correction_}) !=
        FactorisationStatus::solved) {
      break;
    }
    set_to_sum(step.primal, step.primal, 1.0, primal_correction_);
    set_to_sum(step.multipliers, step.multipliers, 1.0, multiplier_correction_);
    const double before = excess;
    excess = excess_of_step();
    if (!(excess <= before)) {
      set_to_sum(step.primal, step.primal, -1.0, primal_correction_);
      set_to_sum(step.multipliers, step.multipliers, -1.0, multiplier_correction_);
      excess = before;
    }
    if (!(excess <= worthwhile * before)) break;
  }
  return excess <= tolerable;
}

}  // namespace dmocbench::kkt
