#include "methods/mechanics/point_function.hpp"

#include "methods/error.hpp"
#include "methods/mechanics/point_of_inputs.hpp"

namespace dmocbench {

namespace {

Tape trace(Eigen::Index n, Eigen::Index m, Eigen::Index l,
           const std::function<ExpressionVector(const ControlledState&)>& formulas) {
  InputCounter inputs;
  return Tape(Schedule(formulas(take_point(inputs, n, m, l))));
}

}  // namespace

PointFunction::PointFunction(Eigen::Index configuration_size, Eigen::Index control_size,
                             const std::function<ExpressionVector(const ControlledState&)>& formulas,
                             Eigen::Index first_order_size)
    : n_(configuration_size),
      m_(control_size),
      l_(first_order_size),
      tape_(trace(n_, m_, l_, formulas)),
      workspace_(tape_),
      point_(2 * n_ + m_ + l_ + 1),
      outputs_(tape_.output_count()) {
  for (const double& entry : point_) inputs_.push_back({&entry, false});
}

void PointFunction::evaluate(const Eigen::Ref<const Eigen::VectorXd>& q, const Eigen::Ref<const Eigen::VectorXd>& v,
                             const Eigen::Ref<const Eigen::VectorXd>& u, double t, Eigen::Ref<Eigen::VectorXd> result,
                             const Eigen::Ref<const Eigen::VectorXd>& y) {
  if (q.size() != n_ || v.size() != n_ || (u.size() != m_ && u.size() != 0) || y.size() != l_ ||
      result.size() != output_count()) {
    throw Error("a point function cannot be evaluated: a vector has the wrong size");
  }
  point_ << q, v, Eigen::VectorXd::Zero(m_), y, t;
  if (u.size() > 0) point_.segment(2 * n_, m_) = u;
  for (std::size_t i = 0; i < outputs_.size(); ++i) outputs_[i] = result.data() + i;
  tape_.evaluate(1, inputs_, outputs_, workspace_);
}

}  // namespace dmocbench
