#pragma once

#include <memory>
#include <utility>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/kkt_system.hpp"
#include "methods/solvers/interior_point/newton_residual.hpp"

namespace dmocbench::interior_point {

/// A fast way to solve Newton systems, made safe: what its steps leave of the system is computed, and solved for again
/// (iterative refinement), and where that does not help a sparse factorisation with pivoting (sparse_kkt.hpp) solves
/// the system instead. So it does where the fast one has refused several systems one after the other for their inertia:
/// its test may be stricter than the truth.
///
/// To compute what is left takes a third to half of the time of the elimination. After a step that was good
/// enough the next two, after one that was much better the next seven are not looked at: their matrices are little
/// different, and Newton's method, whose right-hand sides are exact, forgives a worse one.
class RefinedKkt : public KktSystem {
 public:
  static constexpr double usual_accuracy = 1e-6;

  /// A step is good enough if it leaves `accuracy` of the right-hand side, or rounding.
  RefinedKkt(const NonlinearProgram& program, const ProgramRuns& runs, std::unique_ptr<KktSystem> fast,
             double accuracy = usual_accuracy);
  RefinedKkt(const NonlinearProgram& program, std::unique_ptr<KktSystem> fast, double accuracy = usual_accuracy)
      : RefinedKkt(program, ProgramRuns(program), std::move(fast), accuracy) {}

  [[nodiscard]] FactorisationStatus solve(const KktMatrix& matrix, const Eigen::VectorXd& slope,
                                          const Eigen::VectorXd& rows, Eigen::VectorXd& primal_step,
                                          Eigen::VectorXd& multiplier_step) override;

  [[nodiscard]] int refinements() const noexcept { return refinements_; }
  [[nodiscard]] int fallbacks() const noexcept { return fallbacks_; }

 private:
  [[nodiscard]] bool refine(KktSystem& kkt, const KktMatrix& matrix, const Eigen::VectorXd& slope,
                            const Eigen::VectorXd& rows, Eigen::VectorXd& primal_step,
                            Eigen::VectorXd& multiplier_step);

  const NonlinearProgram& program_;
  std::unique_ptr<KktSystem> fast_;
  std::unique_ptr<KktSystem> robust_;  // once it is needed
  NewtonResidual residual_;
  double accuracy_;
  int refusals_ = 0;  // one after the other
  int unlooked_ = 0;  // steps that need not be looked at
  Eigen::VectorXd primal_correction_;
  Eigen::VectorXd multiplier_correction_;
  int refinements_ = 0;
  int fallbacks_ = 0;
};

}  // namespace dmocbench::interior_point
