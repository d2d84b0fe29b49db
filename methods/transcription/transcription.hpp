#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/parameter_scope.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/blocks.hpp"
#include "methods/transcription/derivatives/program_part.hpp"
#include "methods/transcription/derivatives/series_assembly.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/end_functions.hpp"
#include "methods/transcription/interval_functions.hpp"
#include "methods/transcription/motions/grid.hpp"
#include "methods/transcription/motions/guess_check.hpp"
#include "methods/transcription/program_bounds.hpp"

namespace dmocbench {

/// The form of the cost.
enum class CostForm : std::uint8_t {
  bolza,  ///< Σ h Σ b_i C + Φ, as the problem states it (eq:gDLOCP1)
  mayer,  ///< z_N + Φ with z_{k+1} - z_k = h Σ b_i C, z_0 = 0 (eq:gDLOCP_mayer): the same solutions
};

/// The form `name`. Throws `Error` that lists the names if it is unknown.
[[nodiscard]] CostForm cost_form_named(std::string_view name);

/// Parameters of a problem that its formulas read by `Problem::varying` (`TracedProblem::varying_parameters`) and that
/// `Transcription::set_parameters` shall change.
struct OpenParameters {
  std::vector<std::string> names;  ///< as in `Problem::parameters`
};

/// An optimal control problem transcribed on a grid: a nonlinear program made of one element per interval and of the
/// ends of the horizon.
///
/// Everything except the element's formulas is the same for all methods: numbering, sparsity, derivatives, bounds, path
/// constraints, boundary conditions, horizon. The cost is multiplied by `Problem::cost_scale`. `EndRules` describes how
/// the ends enter, `program_bounds` how the bounds do.
///
/// Where the problem has bounds at times between the ends, the grid is moved so that it has nodes there
/// (`Grid::with_nodes_at`).
///
/// A program is made once and may then be given other values: parameters, ends, bounds and horizon (`set_parameters`
/// and the functions after it), while tapes, patterns and memory stay. The structure stays too, and another one is
/// rejected: the number of unknowns, which bounds exist and which of them are equal, parameters whose values formulas
/// contain. The cost scale and the sizes of q and L_vv in `rounding_floors` belong to the values at set-up, so that
/// answers for different values are measured alike.
class Transcription final : public NonlinearProgram {
 public:
  /// Traces the problem on one interval and sets everything up for the grid. Throws `Error` if the grid has too few
  /// intervals (fewer free variables than equations; the sentence names the smallest number), or the problem is not
  /// well posed. `derivatives` names the back end of gradient, Jacobian and Hessian (`derivative_back_end_names`; the
  /// default is exact); values, momenta and costates always come from the formulas.
  Transcription(const Problem& problem, const Element& element, Tableau tableau, const Grid& grid,
                std::string_view derivatives = "tape", CostForm form = CostForm::bolza);
  /// The same with parameters that stay inputs of the trace. Throws as `ParameterTrace` does about their names.
  Transcription(const Problem& problem, const Element& element, Tableau tableau, const Grid& grid,
                const OpenParameters& open, std::string_view derivatives = "tape", CostForm form = CostForm::bolza);

  // Other values. For all of these the problem of the constructor must still exist; it stays as it is. All throw
  // `Error` and change nothing if a value is not allowed or requires another structure. Not to be called while a solve
  // runs.

  /// Gives the problem's parameters other values, in the order of `Problem::parameters`, and reads its ends, bounds and
  /// horizon again; values set by the functions below are discarded. A parameter that formulas contain may change only
  /// if it is kept open.
  void set_parameters(const Eigen::VectorXd& values);
  /// The same for one parameter; the others keep their values.
  void set_parameter(std::string_view name, double value);
  /// The state of the first (last) end: its fixed components take these values, the others stay free.
  void set_initial_state(const BoundaryState& state);
  /// The state of the last end, likewise.
  void set_final_state(const BoundaryState& state);
  /// All bounds, including the ends'. The bounds of a fixed horizon set T.
  void set_bounds(const ProblemBounds& bounds);
  /// T, where it is fixed; where it is free, the T that guesses take.
  void set_horizon(double horizon);

  /// The values of all parameters, in the order of `Problem::parameters`.
  [[nodiscard]] const Eigen::VectorXd& parameter_values() const noexcept { return parameters_; }
  /// Lets this thread see the problem with these values as long as the scope exists: for its guess and for diagnostics
  /// that take the problem.
  [[nodiscard]] ParameterScope parameter_scope() const { return {*problem_, parameters_}; }
  /// The transcribed problem.
  [[nodiscard]] const Problem& problem() const noexcept { return *problem_; }

  [[nodiscard]] std::size_t variable_count() const override { return blocks_.variable_count(); }
  [[nodiscard]] std::size_t constraint_count() const override { return blocks_.constraint_count(); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return bounds_.variables.lower; }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return bounds_.variables.upper; }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return bounds_.constraints.lower; }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return bounds_.constraints.upper; }
  [[nodiscard]] const BlockPattern& jacobian_structure() const override { return jacobian_pattern_.pattern; }
  [[nodiscard]] const BlockPattern& hessian_structure() const override { return hessian_pattern_.pattern; }
  [[nodiscard]] double objective(const VectorIn& x) override;
  void gradient(const VectorIn& x, VectorOut result) override;
  void constraints(const VectorIn& x, VectorOut result) override;
  void jacobian(const VectorIn& x, VectorOut values) override;
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override;
  /// 20 ε max|q| max|L_vv| / h: constraints are differences of momenta, and these are differences of q divided by h.
  /// Of variables, 1 stands in the place of a max|q| below it: they multiply λ by L_vv / h, however small q is.
  /// The maxima are taken over the ends of the motion and the problem's guess; h is the step of the row's or the
  /// variable's interval, at a node the smaller one of both sides. Rows of the border have the smallest floor, its
  /// variables the largest. No floor is above 1e-6 of max|q| max|L_vv| / T, because no interval is as narrow (`Grid`).
  [[nodiscard]] const RoundingFloors& rounding_floors() const override { return rounding_floors_; }
  [[nodiscard]] const IntervalStructure* interval_structure() const override { return &blocks_.structure(); }

  /// How unknowns and rows are numbered and called.
  [[nodiscard]] const ProgramBlocks& blocks() const noexcept { return blocks_; }
  /// The second part of the nodes' states.
  [[nodiscard]] NodeState node_state() const noexcept { return end_rules_.node_state; }
  /// (A, b, c).
  [[nodiscard]] const Tableau& tableau() const noexcept { return tableau_; }
  /// Relative node times: the constructor's, moved to the times of `ProblemBounds::interior`.
  [[nodiscard]] const Grid& grid() const noexcept { return grid_; }
  /// The formulas of the problem.
  [[nodiscard]] const TracedProblem& traced_problem() const noexcept { return traced_; }
  /// The formulas of one interval.
  [[nodiscard]] const IntervalFunctions& functions() const noexcept { return functions_; }
  /// Nothing where the ends add nothing to the program.
  [[nodiscard]] const std::optional<EndFunctions>& end_functions() const noexcept { return end_functions_; }
  /// The factor by which the program has the cost.
  [[nodiscard]] double cost_scale() const noexcept { return cost_scale_; }
  /// The problem's bounds, checked (`problem_bounds`).
  [[nodiscard]] const ProblemBounds& bounds() const noexcept { return problem_bounds_; }

  /// T of the problem, or of its guess where it is free.
  [[nodiscard]] double guessed_horizon() const noexcept { return guessed_horizon_; }
  /// True if T is an unknown.
  [[nodiscard]] bool has_free_horizon() const noexcept { return functions_.free_horizon; }
  /// T at a point.
  [[nodiscard]] double horizon(const VectorIn& x) const;
  /// The unknown parameters at a point, in the order of `Problem::unknowns`.
  [[nodiscard]] Eigen::VectorXd unknown_parameters(const VectorIn& x) const;
  /// Lets `traced_problem` have these values of the unknown parameters, where it had the guess's: of an
  /// answer that is read and judged.
  void set_unknown_parameters(const Eigen::VectorXd& values) { traced_.set_unknowns(values); }
  /// t_0 to t_N and h_0 to h_{N-1} at a point.
  [[nodiscard]] Eigen::VectorXd node_times(const VectorIn& x) const { return horizon(x) * grid_.relative_times(); }
  /// h_0 to h_{N-1} at a point.
  [[nodiscard]] Eigen::VectorXd steps(const VectorIn& x) const { return horizon(x) * grid_.relative_widths(); }

  /// The step and the time of the left node that the interval formulas read: relative to the horizon where that is an
  /// unknown.
  [[nodiscard]] const Eigen::VectorXd& step_inputs() const noexcept { return step_inputs_; }
  /// The times of the left nodes as interval formulas read them, likewise.
  [[nodiscard]] const Eigen::VectorXd& time_inputs() const noexcept { return time_inputs_; }

  /// The inputs of the interval formulas at a point (see `LocalInputs`); `multipliers` may be empty where no formula
  /// reads them. Valid until the next call.
  [[nodiscard]] std::span<const Tape::Input> bind(const VectorIn& x, const VectorIn& multipliers,
                                                  double objective_factor);
  /// The outputs of a schedule with these inputs (`functions()` has several) for all intervals: row k for interval k, a
  /// column per output. For results that are computed once after a solve.
  [[nodiscard]] Eigen::MatrixXd tabulate(const Schedule& schedule, const VectorIn& x,
                                         const VectorIn& multipliers = Eigen::VectorXd());

 private:
  /// The values that setters change.
  struct Values {
    ProblemBounds bounds;
    double horizon = 0.0;
  };
  [[nodiscard]] Values present_values() const { return {problem_bounds_, guessed_horizon_}; }
  /// Checks values and makes them the program's; the open parameters are set before.
  void use(Values values);
  void require_readable_ends(const Values& values) const;
  [[nodiscard]] IntervalRules interval_rules() const;
  void set_end(const BoundaryState& state, EndBounds ProblemBounds::*end, const char* name);
  void require_enough_intervals(const Problem& problem, const Element& element) const;
  [[nodiscard]] long long fixed_variables_of_an_interval() const;
  [[nodiscard]] long long inequalities_of_an_interval() const;
  /// A part that adds to the entries of the intervals: the ends, or a tie.
  struct AddedPart {
    const LocalFunctions* functions;
    std::vector<SeriesPlace> unknowns;
    std::vector<SeriesPlace> rows;
    const Eigen::VectorXd* steps;
    const Eigen::VectorXd* times;
    std::vector<SeriesPlace> jacobian = {};  // entries of the patterns
    std::vector<SeriesPlace> hessian = {};
  };
  /// The intervals at the first call, added parts at others; the patterns must be complete.
  void add_part(const AddedPart& part, std::string_view derivatives);
  /// Step and time of the interval before a node whose velocity is an unknown of its own.
  struct TieInputs {
    Eigen::Index interval = 0;
    Eigen::VectorXd step = Eigen::VectorXd(1);
    Eigen::VectorXd time = Eigen::VectorXd(1);
  };
  /// The part that ties the velocity of a node between the ends.
  [[nodiscard]] AddedPart tie_of(const LocalFunctions& functions, const UnknownBlock& velocity,
                                 const TieInputs& inputs) const;
  void set_tie_inputs();

  const Problem* problem_;
  Eigen::VectorXd parameters_;
  Tableau tableau_;
  double cost_scale_;
  double guessed_horizon_;
  TracedProblem traced_;
  ProblemBounds problem_bounds_;
  Grid grid_;
  EndRules end_rules_;
  IntervalFunctions functions_;
  std::optional<EndFunctions> end_functions_;
  ProgramBlocks blocks_;
  Eigen::Index horizon_place_;  // of T, where that is an unknown
  ProgramBounds bounds_;
  GuessMagnitudes magnitudes_;
  RoundingFloors rounding_floors_;
  Eigen::VectorXd step_inputs_;
  Eigen::VectorXd time_inputs_;
  AssembledPattern jacobian_pattern_;
  AssembledPattern hessian_pattern_;
  std::vector<TieInputs> tie_inputs_;
  std::vector<std::unique_ptr<ProgramPart>> parts_;  // the intervals; the ends, unless they add nothing; ties
};

}  // namespace dmocbench
