#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/assembled_tape.hpp"
#include "methods/transcription/derivative_back_end.hpp"
#include "methods/transcription/element.hpp"
#include "methods/transcription/grid.hpp"
#include "methods/transcription/interval_functions.hpp"
#include "methods/transcription/layout.hpp"
#include "methods/transcription/tableau.hpp"

namespace dmocbench {

/// An optimal control problem transcribed on a grid: a nonlinear program made of one element per interval.
///
/// Everything but the element's rule is here and is the same for all methods: numbering, sparsity, derivatives,
/// boundary conditions. The cost is multiplied by `Problem::cost_scale`. Boundary conditions: q_0, q_N (and p or v
/// there, where nodes carry them) are fixed by bounds; for DMOC the rows of nodes 0 and N are p⁰ + (∂A/∂q_0 + W) = 0
/// (eq:gDLOCP3) and -p^T + (∂A/∂q_N + W) = 0 (rem:inifinalvel), with p⁰ = L_v(q⁰, v⁰) in the bounds.
class Transcription final : public NonlinearProgram {
 public:
  /// Traces the problem on one interval and sets everything up for the grid. Throws `Error` if the grid has too few
  /// intervals (fewer free variables than rows; the sentence names the smallest number), or the problem is not well
  /// posed. `derivatives` names the back end of gradient, Jacobian and Hessian (`derivative_back_end_names`; the
  /// default is exact); values, momenta and costates come from the formulas whatever it is.
  Transcription(const Problem& problem, const Element& element, Tableau tableau, const Grid& grid,
                std::string_view derivatives = "tape");

  [[nodiscard]] std::size_t variable_count() const override { return layout_.variable_count(); }
  [[nodiscard]] std::size_t constraint_count() const override { return layout_.row_count(); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return variable_lower_; }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return variable_upper_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return constraint_bounds_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return constraint_bounds_; }
  [[nodiscard]] const SparsityPattern& jacobian_structure() const override { return jacobian_pattern_.pattern; }
  [[nodiscard]] const SparsityPattern& hessian_structure() const override { return hessian_pattern_.pattern; }
  [[nodiscard]] double objective(const VectorIn& x) override;
  void gradient(const VectorIn& x, VectorOut result) override;
  void constraints(const VectorIn& x, VectorOut result) override;
  void jacobian(const VectorIn& x, VectorOut values) override;
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override;
  /// 20 ε max|q| max|L_vv| / min h: rows are differences of momenta, and these are differences of q divided by h. The
  /// maxima are taken over the ends of the motion and the problem's guess.
  [[nodiscard]] double rounding_floor() const override { return rounding_floor_; }
  [[nodiscard]] const IntervalStructure* interval_structure() const override { return &layout_.structure(); }

  [[nodiscard]] const Layout& layout() const noexcept { return layout_; }
  [[nodiscard]] const Tableau& tableau() const noexcept { return tableau_; }
  [[nodiscard]] const TracedProblem& traced_problem() const noexcept { return traced_; }
  [[nodiscard]] const IntervalFunctions& functions() const noexcept { return functions_; }
  [[nodiscard]] double cost_scale() const noexcept { return cost_scale_; }
  /// t_0 .. t_N.
  [[nodiscard]] const Eigen::VectorXd& node_times() const noexcept { return node_times_; }
  /// h_0 .. h_{N-1}.
  [[nodiscard]] const Eigen::VectorXd& steps() const noexcept { return steps_; }

  /// The inputs of the interval formulas at a point (see `IntervalInputs`); `multipliers` may be empty where no formula
  /// reads them. Valid until the next call.
  [[nodiscard]] std::span<const Tape::Input> bind(const VectorIn& x, const VectorIn& multipliers,
                                                  double objective_factor);

 private:
  void set_bounds(const Problem& problem);
  void require_enough_intervals(const Problem& problem, const Element& element) const;

  Tableau tableau_;
  double cost_scale_;
  TracedProblem traced_;
  IntervalFunctions functions_;
  Layout layout_;
  Eigen::VectorXd node_times_;
  Eigen::VectorXd steps_;
  Eigen::VectorXd variable_lower_;
  Eigen::VectorXd variable_upper_;
  Eigen::VectorXd constraint_bounds_;  // all rows are equalities
  double rounding_floor_ = 0.0;
  double objective_factor_ = 1.0;
  Eigen::VectorXd no_multipliers_;
  std::vector<Tape::Input> inputs_;
  AssembledPattern jacobian_pattern_;
  AssembledPattern hessian_pattern_;
  AssembledTape cost_;
  AssembledTape rows_;
  std::unique_ptr<DerivativeBackEnd> derivatives_;
  Eigen::VectorXd costs_;  // per interval
};

}  // namespace dmocbench
