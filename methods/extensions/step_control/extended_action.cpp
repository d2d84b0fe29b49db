#include "methods/extensions/step_control/extended_action.hpp"

#include "methods/expression/derivatives.hpp"
#include "methods/transcription/elements/dmoc_element.hpp"

namespace dmocbench {

ExtendedAction::ExtendedAction(const Problem& problem, const TracedProblem& traced, const Tableau& tableau,
                               const IntervalUnknowns& unknowns)
    : b_(tableau.b), h_(unknowns.h), element_(DmocElement().trace(traced, tableau, unknowns)) {
  for (std::size_t i = 0; i < element_.stages.size(); ++i) {
    const ControlledState& stage = element_.stages[i];
    const TracedProblem::Values values = traced.at(stage);
    forces_.push_back(values.control_force);
    if (traced.has_symmetry()) symmetries_.push_back(values.symmetry);
    action_ += h_ * Expression(b_[static_cast<Eigen::Index>(i)]) * problem.lagrangian(stage.state());
  }
}

Expression ExtendedAction::mean_of(const StepFunction& sigma) const {
  Expression sum;
  for (std::size_t i = 0; i < element_.stages.size(); ++i) {
    sum += Expression(b_[static_cast<Eigen::Index>(i)]) / sigma(element_.stages[i]);
  }
  return 1.0 / sum;
}

ExpressionVector ExtendedAction::variation_by(const ExpressionVector& x, const Expression& constraint,
                                              const Expression& multiplier) const {
  std::vector<std::vector<ConjugatePair>> pairs;  // f works along Q_i, -f·Q̇_i along T_i
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    const ControlledState& stage = element_.stages[i];
    const Expression power = forces_[i].dot(stage.v);
    pairs.push_back(
        {{stage.q, forces_[i]}, {ExpressionVector::Constant(1, stage.t), ExpressionVector::Constant(1, -power)}});
  }
  return gradient(action_, x) + multiplier * gradient(constraint, x) + variation(x, pairs, b_, h_);
}

ExpressionVector ExtendedAction::impulse() const {
  ExpressionVector sum = ExpressionVector::Zero(element_.left_rows.size());
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    sum += (h_ * Expression(b_[static_cast<Eigen::Index>(i)])) * forces_[i];
  }
  return sum;
}

Expression ExtendedAction::torque() const {
  Expression sum;
  for (std::size_t i = 0; i < symmetries_.size(); ++i) {
    sum += h_ * Expression(b_[static_cast<Eigen::Index>(i)]) * forces_[i].dot(symmetries_[i]);
  }
  return sum;
}

}  // namespace dmocbench
