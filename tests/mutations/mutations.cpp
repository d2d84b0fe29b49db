// One build of the tests, with mistakes chosen at run time by DMOCBENCH_MUTATION: the functions that the linker puts in
// place of the true ones (wrapped_functions.hpp) call these and, if asked to, spoil what goes in or comes out. What is
// tested knows nothing of it. Each mistake and the test that has to notice it stand in mutations.csv; `check` runs
// them.

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>

#include "tests/mutations/wrapped_functions.hpp"

namespace dmocbench::mutations {

namespace {

bool chosen(std::string_view mutation) {
  static const char* const choice = std::getenv("DMOCBENCH_MUTATION");
  return choice != nullptr && mutation == choice;
}

constexpr double one_percent_more = 1.01;

/// A family of elements that makes the chosen mistake.
class MutantElement final : public Element {
 public:
  explicit MutantElement(std::unique_ptr<Element> element)
      : Element(element->name(), element->description(), element->node_state()), element_(std::move(element)) {}
  [[nodiscard]] Tableau rates(const Tableau& tableau) const override { return element_->rates(tableau); }
  [[nodiscard]] Tableau controls(const Tableau& tableau) const override { return element_->controls(tableau); }
  [[nodiscard]] IntervalTrace trace(const TracedProblem& problem, const Tableau& tableau,
                                    const IntervalUnknowns& unknowns) const override {
    Tableau coefficients = tableau;
    IntervalUnknowns local = unknowns;
    if (chosen("wrong_weight_in_rows")) coefficients.b[0] *= one_percent_more;
    if (chosen("plain_tableau_for_momenta")) coefficients.a_conjugate = coefficients.a;
    if (chosen("stage_times_at_left_node")) coefficients.c.setZero();
    if (chosen("one_control_per_interval")) local.controls.assign(local.controls.size(), local.controls[0]);

    IntervalTrace trace = element_->trace(problem, coefficients, local);
    const bool is_variational = node_state() == NodeState::configuration;
    if (is_variational && chosen("dropped_half_force")) {
      trace.right_rows -= work_of_control(problem, trace.stages, unknowns.right_q, tableau.b, unknowns.h);
      trace.right_momentum = trace.right_rows;
    }
    if (is_variational && chosen("momenta_of_wrong_side")) std::swap(trace.left_momentum, trace.right_momentum);
    if (is_variational && chosen("momenta_of_nearest_stage")) {
      trace.left_momentum = problem.at(trace.stages.front()).momentum;
      trace.right_momentum = problem.at(trace.stages.back()).momentum;
    }
    return trace;
  }

 private:
  std::unique_ptr<Element> element_;
};

/// A back end whose Hessian lacks one local entry that neighbouring intervals merge at their node.
class LosesAMergedEntry final : public DerivativeBackEnd {
 public:
  LosesAMergedEntry(std::string_view name, const LocalFunctions& functions, DerivativePlaces places)
      : size_(static_cast<Eigen::Index>(places.hessian.size)) {
    // The entry is written behind the others instead, where nobody reads it.
    std::vector<SeriesPlace>& entries = places.hessian.places;
    for (SeriesPlace& place : entries) {
      if (place.is_global || std::count(entries.begin(), entries.end(), SeriesPlace(place.first + 1)) == 0) continue;
      place = places.hessian.size;
      places.hessian.size += places.hessian.intervals;
      break;
    }
    values_.resize(static_cast<Eigen::Index>(places.hessian.size));
    back_end_ = true_make_derivative_back_end(name, functions, places);
  }
  void gradient(Inputs inputs, VectorOut result) override { back_end_->gradient(inputs, result); }
  void jacobian(Inputs inputs, VectorOut values) override { back_end_->jacobian(inputs, values); }
  void hessian(Inputs inputs, VectorOut values) override {
    back_end_->hessian(inputs, values_);
    values = values_.head(size_);
  }

 private:
  Eigen::Index size_;
  Eigen::VectorXd values_;
  std::unique_ptr<DerivativeBackEnd> back_end_;
};

}  // namespace

std::unique_ptr<Element> mutable_make_element(std::string_view name) {
  return std::make_unique<MutantElement>(true_make_element(name));
}

Tableau mutable_gauss_tableau(int stages) {
  Tableau tableau = true_gauss_tableau(stages);
  if (chosen("wrong_weight")) tableau.b[0] *= one_percent_more;
  return tableau;
}

Tableau mutable_lobatto_tableau(int stages, bool shares_controls) {
  Tableau tableau = true_lobatto_tableau(stages, shares_controls);
  if (chosen("plain_tableau_for_conjugate")) tableau.a_conjugate = tableau.a;
  return tableau;
}

TracedProblem::Values mutable_formulas_at(const TracedProblem* problem, const ControlledState& point) {
  TracedProblem::Values values = true_formulas_at(problem, point);
  if (chosen("momentum_independent_of_configuration")) values.momentum_by_configuration.setConstant(Expression(0.0));
  return values;
}

void mutable_construct_transcription(Transcription* self, const Problem& problem, const Element& element,
                                     Tableau tableau, const Grid& grid, std::string_view derivatives, CostForm form) {
  true_construct_transcription(self, problem, element, std::move(tableau), grid, derivatives, form);
  if (!chosen("swapped_end_momenta") || element.node_state() != NodeState::configuration) return;
  // The bounds of the rows of nodes 0 and N are -p⁰ and p^T.
  for (const Eigen::VectorXd* bounds : {&self->constraint_lower(), &self->constraint_upper()}) {
    auto& rows = const_cast<Eigen::VectorXd&>(*bounds);  // NOLINT: nobody asked the class for a hook
    for (Eigen::Index i = 0; i < problem.configuration_size(); ++i) {
      const auto head = self->blocks().row(Equation::euler_lagrange).index(i);
      double& last = rows[head + static_cast<Eigen::Index>(self->blocks().intervals())];
      rows[head] = -std::exchange(last, -rows[head]);
    }
  }
}

std::unique_ptr<DerivativeBackEnd> mutable_make_derivative_back_end(std::string_view name,
                                                                    const LocalFunctions& functions,
                                                                    const DerivativePlaces& places) {
  const bool is_of_intervals = places.hessian.mode == AssemblyMode::whole;
  if (is_of_intervals && chosen("lost_hessian_entry")) {
    return std::make_unique<LosesAMergedEntry>(name, functions, places);
  }
  return true_make_derivative_back_end(name, functions, places);
}

Costates mutable_costates(Transcription& transcription, const Eigen::VectorXd& primal,
                          const Eigen::VectorXd& multipliers, const Eigen::MatrixXd& v) {
  return true_costates(transcription, primal, chosen("costates_of_wrong_sign") ? -multipliers : multipliers, v);
}

KktResidual mutable_kkt_residual(NonlinearProgram& program, const Eigen::VectorXd& primal,
                                 const Eigen::VectorXd& multipliers, KktMemory& memory) {
  KktResidual residual =
      true_kkt_residual(program, primal, chosen("multipliers_of_wrong_sign") ? -multipliers : multipliers, memory);
  if (chosen("ignored_violation")) residual.constraint_violation = 0.0;
  return residual;
}

void mutable_judge(Confirmation* self, double tolerance, Solution& solution, bool asks_newton) {
  const Status claim = solution.status;
  true_judge(self, tolerance, solution, asks_newton);
  if (chosen("believed_solver")) solution.status = claim;
}

ReplayError mutable_replay_error(const Problem& problem, const Trajectory& trajectory, double tolerance) {
  if (chosen("replay_without_error")) return {};
  return true_replay_error(problem, trajectory, tolerance);
}

MomentumConsistency mutable_momentum_consistency(const Problem& problem, const Trajectory& trajectory) {
  MomentumConsistency result = true_momentum_consistency(problem, trajectory);
  if (chosen("consistency_at_any_point")) result.defects.setZero();
  return result;
}

}  // namespace dmocbench::mutations
