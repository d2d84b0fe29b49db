#include "methods/extensions/step_control/extended_action.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
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

namespace {

/// 1/σ at the points of a motion.
class DensityOfSteps {
 public:
  DensityOfSteps(const StepFunction& sigma, const MotionPoint& like) {
    InputCounter counter;
    const ExpressionVector q = counter.take(like.q.size());
    const ExpressionVector v = counter.take(like.v.size());
    const ExpressionVector u = counter.take(like.u.size());
    formula_ = Schedule(ExpressionVector(ExpressionVector::Constant(1, sigma({q, v, u, counter.take()}))));
  }
  [[nodiscard]] double at(const MotionPoint& point, double t) const {
    std::vector<double> inputs;
    for (const Eigen::VectorXd* part : {&point.q, &point.v, &point.u}) {
      inputs.insert(inputs.end(), part->begin(), part->end());
    }
    inputs.push_back(t);
    const double sigma = replay<double>(formula_, std::span<const double>(inputs)).front();
    require_positive_step(sigma, t);
    return 1.0 / sigma;
  }

 private:
  Schedule formula_;
};

}  // namespace

void require_positive_step(double sigma, double t) {
  if (sigma > 0.0 && std::isfinite(sigma)) return;
  throw Error("the step size function is {:g} at t = {:g}; it must be positive and finite along the whole trajectory",
              sigma, t);
}

StepTimes step_times(const StepFunction& sigma, const Motion& motion, Eigen::Index intervals) {
  if (intervals < 1) throw Error("a trajectory needs at least one step");
  const Eigen::Index parts = std::max<Eigen::Index>(4096, 8 * intervals);
  const double width = motion.horizon / static_cast<double>(parts);
  const DensityOfSteps density(sigma, motion.at(0.0));
  Eigen::VectorXd passed(parts + 1);  // ∫ dt/σ from 0
  passed[0] = 0.0;
  double before = density.at(motion.at(0.0), 0.0);
  for (Eigen::Index i = 1; i <= parts; ++i) {
    const double t = width * static_cast<double>(i);
    const double now = density.at(motion.at(t), t);
    passed[i] = passed[i - 1] + 0.5 * width * (before + now);
    before = now;
  }
  StepTimes result{.pace = passed[parts] / static_cast<double>(intervals), .times = Eigen::VectorXd(intervals + 1)};
  Eigen::Index left = 0;
  for (Eigen::Index k = 0; k <= intervals; ++k) {
    const double wanted = result.pace * static_cast<double>(k);
    while (left + 1 < parts && passed[left + 1] < wanted) ++left;
    const double share = (wanted - passed[left]) / (passed[left + 1] - passed[left]);
    result.times[k] = width * (static_cast<double>(left) + share);
  }
  result.times[0] = 0.0;
  result.times[intervals] = motion.horizon;
  return result;
}

}  // namespace dmocbench
