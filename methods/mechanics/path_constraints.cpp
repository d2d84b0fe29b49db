#include "methods/mechanics/path_constraints.hpp"

#include <algorithm>
#include <vector>

namespace dmocbench {

namespace {

Schedule schedule_of(const TracedProblem& traced) {
  InputCounter inputs;
  const Eigen::Index n = traced.configuration_size();
  const ExpressionVector q = inputs.take(n);
  const ExpressionVector v = inputs.take(n);
  const ExpressionVector u = inputs.take(traced.control_size());
  const ExpressionVector y = inputs.take(traced.first_order_size());
  return Schedule(traced.at(ControlledState{q, v, u, inputs.take(), y}).path_constraints);
}

}  // namespace

PathConstraints::PathConstraints(const TracedProblem& traced, Eigen::Index most_rows)
    : PathConstraints(schedule_of(traced),
                      2 * traced.configuration_size() + traced.control_size() + traced.first_order_size(), most_rows) {}

PathConstraints::PathConstraints(const Schedule& schedule, Eigen::Index time_input, Eigen::Index most_rows)
    : tape_(schedule),
      workspace_(tape_),
      values_(most_rows, static_cast<Eigen::Index>(schedule.outputs().size())),
      reads_time_(std::ranges::any_of(schedule.steps(), [time_input](const Schedule::Step& step) {
        return step.operation == Operation::input && step.input_index == static_cast<std::size_t>(time_input);
      })) {}

Eigen::Ref<const Eigen::MatrixXd> PathConstraints::at(const Eigen::MatrixXd& rows, Eigen::Index count) {
  std::vector<Tape::Input> inputs;
  std::vector<double*> outputs;
  for (const auto& column : rows.colwise()) inputs.push_back({column.data(), false});
  for (auto column : values_.colwise()) outputs.push_back(column.data());
  tape_.evaluate(static_cast<std::size_t>(count), inputs, outputs, workspace_);
  return values_.topRows(count);
}

}  // namespace dmocbench
