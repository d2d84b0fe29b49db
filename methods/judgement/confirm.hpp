#pragma once

#include <optional>

#include "methods/judgement/hidden_violation.hpp"
#include "methods/judgement/kkt_residual.hpp"
#include "methods/judgement/negative_curvature.hpp"
#include "methods/judgement/newton_correction.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"

namespace dmocbench {

/// Computes the objective, KKT residual and constraint violation at `solution.primal` (variable_count() entries); where
/// the solver gave no multipliers, also their least-squares estimate, so that every point is judged alike. Where a
/// limit of time or an interrupt ended the solve they are not estimated: they are NaN, and there is no KKT residual.
void judge_residuals(NonlinearProgram& program, Solution& solution);

/// The larger of KKT residual and constraint violation, each divided by its limit of `StopRule` at this tolerance: at
/// most 1 where a solver may stop. Infinity if the residuals have not been computed, NaN if one of them is NaN. The
/// mean multiplier of the rule is taken over the constraints, since multipliers of bounds are not known. Where the rule
/// allows constraints and variables residuals of their own, each entry counts by its own (`kkt_entries`); otherwise the
/// residuals of `solution` decide.
[[nodiscard]] double scaled_residual(NonlinearProgram& program, double tolerance, const Solution& solution);

/// The status of an answer that the solver calls "solved" or "acceptable", at this scaled residual.
///
/// "Solved" if it is at most `confirmation_factor`; an "acceptable" one stays so up to `acceptable_factor` times that;
/// all else is "not confirmed".
[[nodiscard]] Status confirmed_status(Status claim, double residual);

/// Powers of two by which a program has to be multiplied before its tolerance can distinguish a solution from other
/// points.
struct Scaling {
  double of_cost = 1.0;     ///< 1 where the cost is large enough
  Eigen::VectorXd of_rows;  ///< constraint_count() entries; empty where all are 1

  /// True where nothing has to be multiplied.
  [[nodiscard]] bool is_one() const { return of_cost == 1.0 && of_rows.size() == 0; }
};

/// Judges answers of one program, with memory of its own: after the first one that is solved nothing is allocated.
class Confirmation {
 public:
  /// The program must outlive it.
  explicit Confirmation(NonlinearProgram& program) : program_(program) {}

  /// Computes the residuals of a solution and judges its claim; other statuses are unchanged, and so is a solution
  /// without a point, unless it claims to be solved. The message states the judgement.
  ///
  /// "Solved" requires residuals that are small next to the program's own sizes too: no violation may be more than a
  /// thousandth of its constraint's size (`ConstraintSizes`), and no stationarity that only round-off excuses more than
  /// a thousandth of the gradient of the cost.
  ///
  /// "Solved" requires a settled answer too: a Newton step from it moves no unknown by more than `settled` of its
  /// size, nor the cost (`NewtonCorrections`). Otherwise it is "not confirmed", although the residuals are, or, where
  /// controls alone would move, "solved, control not determined"; `settle` may settle it. Negative curvature there is
  /// measured (`Solution::curvature`), unless the tolerance hides the decrease that it promises within the size of the
  /// unknowns, and left to `leave_saddle` to decide about. Where the step cannot be
  /// computed the residuals alone decide, and where `asks_newton` is false. Where the `StopScope` of the thread ends
  /// its computation, see `tell_of_stop`.
  void judge(double tolerance, Solution& solution, bool asks_newton = true);

  /// Computes the residuals of a solution that was judged in other units of its constraints, and takes "solved" back
  /// where the tolerance hides a violation (`ConstraintSizes`).
  void judge_sizes(Solution& solution);

  /// The scaling that the program needs, for the answer judged last.
  ///
  /// The cost needs one where no entry of ∇φ and ∇²φ over the free variables, at the answer and at the start, reaches
  /// `confirmation_factor` times the tolerance: then λ = 0 passes everywhere. Not so where all of them vanish: a
  /// program without a cost only needs feasibility.
  ///
  /// Constraints need one where the tolerance, or round-off, hides a residual, or where an inequality is tiny
  /// (`ConstraintSizes`).
  [[nodiscard]] Scaling scaling(double tolerance, const Eigen::VectorXd& start, const Solution& solution);

  /// True if multipliers of the answer judged last are so large that their terms, in the gradient of the Lagrangian,
  /// exceed `largest_terms` times the gradient of the cost: round-off of these terms may hide any residual. Constraints
  /// that depend on each other have such multipliers.
  [[nodiscard]] bool has_huge_multipliers() const noexcept { return has_huge_multipliers_; }
  /// See above.
  static constexpr double largest_terms = 1e7;

  /// The negative curvature at the answer judged last, if `Solution::curvature` reports one.
  [[nodiscard]] const std::optional<NegativeCurvature>& negative_curvature() const noexcept { return curvature_; }

 private:
  void judge_residuals(Solution& solution);
  [[nodiscard]] double scaled_residual(double tolerance, const Solution& solution);
  /// Lengths of the Newton step of all unknowns, and of all except the controls.
  struct StepLengths {
    double of_all = 0.0;
    double of_state = 0.0;
  };
  [[nodiscard]] std::optional<StepLengths> newton_step(const Solution& solution);
  [[nodiscard]] double factor_of_cost(double tolerance, const Eigen::VectorXd& start, const Solution& solution);
  bool refuse_hidden_violation(Solution& solution);
  void require_visible(double tolerance, Solution& solution);
  [[nodiscard]] double largest_term(const Eigen::VectorXd& multipliers) const;
  void require_settled(double tolerance, Solution& solution);
  void look_for_curvature(double tolerance, Solution& solution);

  friend void judge_residuals(NonlinearProgram& program, Solution& solution);
  friend double scaled_residual(NonlinearProgram& program, double tolerance, const Solution& solution);

  NonlinearProgram& program_;
  KktMemory memory_;
  KktEntries entries_;
  std::optional<NewtonCorrections> corrections_;  // made when it is first needed
  std::optional<NegativeCurvature> curvature_;
  ConstraintSizes sizes_;
  bool needs_factors_of_rows_ = false;
  bool has_huge_multipliers_ = false;
};

/// `Confirmation::judge`, once.
void confirm(NonlinearProgram& program, double tolerance, Solution& solution);

/// Status and message where a limit came before it was known whether the answer is settled: "time limit" or
/// "interrupted".
void tell_of_stop(Solution& solution);

/// Status and message where an answer is undecided, because the tolerance does not constrain the cost
/// (`Confirmation::scaling`): "not confirmed".
void refuse_small_cost(double factor, Solution& solution);

/// The permitted ratio of our residual to the tolerance: ours is the largest entry as it is, solvers scale theirs.
inline constexpr double confirmation_factor = 10.0;

/// The permitted ratio of the residual of an acceptable solution to a solved one's.
inline constexpr double acceptable_factor = 100.0;

}  // namespace dmocbench
