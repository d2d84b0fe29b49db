#include "methods/solvers/interior_point/refined_kkt.hpp"

#include <utility>

#include "methods/solvers/interior_point/sparse_kkt.hpp"

namespace dmocbench::interior_point {

namespace {

constexpr int most_refinements = 5;
/// What a refinement leaves of the error, at most, to be worth another one.
constexpr double worthwhile = 0.3;
/// How much larger than wanted an error may stay: Newton's method still gains a digit in an iteration.
constexpr double tolerable = 1e5;
/// An error that is as small as wanted lets the next steps pass, and more of them where it is this much smaller.
constexpr double to_spare = 1e-2;
constexpr int steps_to_pass = 2;
constexpr int more_steps_to_pass = 7;
/// Shifts that are raised in vain before the sparse factorisation is asked: where the Hessian needs one, two or three
/// usually do.
constexpr int refusals_to_doubt = 4;

}  // namespace

RefinedKkt::RefinedKkt(const NonlinearProgram& program, const ProgramRuns& runs, std::unique_ptr<KktSystem> fast,
                       double accuracy)
    : program_(program), fast_(std::move(fast)), residual_(program, runs), accuracy_(accuracy) {}

FactorisationStatus RefinedKkt::solve(const KktMatrix& matrix, const Eigen::VectorXd& slope,
                                      const Eigen::VectorXd& rows, Eigen::VectorXd& primal_step,
                                      Eigen::VectorXd& multiplier_step) {
  const FactorisationStatus verdict = fast_->solve(matrix, slope, rows, primal_step, multiplier_step);
  // Usually a refusal is right, and a shift of the Hessian cheaper than to ask another; after several it is doubtful.
  refusals_ = verdict == FactorisationStatus::wrong_inertia ? refusals_ + 1 : 0;
  if (refusals_ % refusals_to_doubt != 0) return verdict;
  if (verdict == FactorisationStatus::solved && unlooked_ > 0) {
    --unlooked_;
    return verdict;
  }
  if (verdict == FactorisationStatus::solved && refine(*fast_, matrix, slope, rows, primal_step, multiplier_step))
    return verdict;
  if (!robust_) robust_ = std::make_unique<SparseKkt>(program_, SparseKkt::Order::along_the_horizon);
  ++fallbacks_;
  const FactorisationStatus robust = robust_->solve(matrix, slope, rows, primal_step, multiplier_step);
  if (robust != FactorisationStatus::solved) return robust;
  // Rounding may hide from it that rows depend on each other, but then its step solves nothing.
  return refine(*robust_, matrix, slope, rows, primal_step, multiplier_step) ? robust : FactorisationStatus::singular;
}

/// False if the step stays worse than tolerable.
bool RefinedKkt::refine(KktSystem& kkt, const KktMatrix& matrix, const Eigen::VectorXd& slope,
                        const Eigen::VectorXd& rows, Eigen::VectorXd& primal_step, Eigen::VectorXd& multiplier_step) {
  residual_.compute(matrix, slope, rows, primal_step, multiplier_step);
  double excess = residual_.excess(matrix, primal_step, multiplier_step, accuracy_);
  const bool is_fast = &kkt == fast_.get();
  if (is_fast && excess <= 1.0) unlooked_ = excess <= to_spare ? more_steps_to_pass : steps_to_pass;
  if (is_fast && excess > tolerable) {
    // The elimination by intervals learns from every system (its terminal weights): once more, from nothing.
    if (kkt.solve(matrix, slope, rows, primal_step, multiplier_step) != FactorisationStatus::solved) return false;
    residual_.compute(matrix, slope, rows, primal_step, multiplier_step);
    excess = residual_.excess(matrix, primal_step, multiplier_step, accuracy_);
  }
  for (int i = 0; i < most_refinements && excess > 1.0; ++i) {
    primal_correction_.resizeLike(primal_step);
    multiplier_correction_.resizeLike(multiplier_step);
    ++refinements_;
    if (kkt.solve(matrix, residual_.slope(), residual_.rows(), primal_correction_, multiplier_correction_) !=
        FactorisationStatus::solved) {
      break;
    }
    primal_step += primal_correction_;
    multiplier_step += multiplier_correction_;
    residual_.compute(matrix, slope, rows, primal_step, multiplier_step);
    const double before = excess;
    excess = residual_.excess(matrix, primal_step, multiplier_step, accuracy_);
    if (!(excess <= before)) {
      primal_step -= primal_correction_;
      multiplier_step -= multiplier_correction_;
      excess = before;
    }
    if (!(excess <= worthwhile * before)) break;
  }
  return excess <= tolerable;
}

}  // namespace dmocbench::interior_point
