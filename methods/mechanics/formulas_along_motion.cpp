#include "methods/mechanics/formulas_along_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/mechanics/point_of_inputs.hpp"

namespace dmocbench {

FormulaCheck::FormulaCheck(const Problem& problem, Derivatives up_to)
    : formulas_(problem, [&](const ControlledState& x) { return trace(problem, x, up_to); }),
      values_(formulas_.output_count()) {}

ExpressionVector FormulaCheck::trace(const Problem& problem, const ControlledState& x, Derivatives up_to) {
  ExpressionVector inputs(x.q.size() + x.v.size() + x.u.size() + x.y.size());
  inputs << x.q, x.v, x.u, x.y;
  std::vector<Expression> outputs;
  const auto add = [&](const ExpressionVector& entries, const std::string& name) {
    append(outputs, entries);
    names_.resize(outputs.size(), name);
  };
  const auto add_formula = [&](const char* name, const ExpressionVector& formula) {
    for (Eigen::Index i = 0; i < formula.size(); ++i) {
      const std::string entry = formula.size() > 1 ? fmt::format("{}[{}]", name, i) : name;
      add(formula.segment(i, 1), entry);
      add(gradient(formula[i], inputs), "a derivative of " + entry);
    }
    if (up_to == Derivatives::first || formula.size() == 0) return;
    add(gradient(gradient(formula.sum(), inputs).sum(), inputs), std::string("a second derivative of ") + name);
  };
  add_formula("lagrangian", ExpressionVector::Constant(1, problem.lagrangian(x.state())));
  add_formula("force", problem.force(x));
  add_formula("running_cost", ExpressionVector::Constant(1, problem.running_cost(x)));
  add_formula("path_constraints", problem.path_constraints(x));
  add_formula("constraints", problem.constraints(x.q));
  add_formula("velocity_constraints", problem.velocity_constraints(x.q, x.v));
  add_formula("first_order_rates", problem.first_order_rates(x));
  add_formula("integrands", problem.integrands(x));
  return Eigen::Map<const ExpressionVector>(outputs.data(), static_cast<Eigen::Index>(outputs.size()));
}

std::string FormulaCheck::undefined_at(const MotionPoint& point, double t) {
  formulas_.evaluate(point, t, values_);
  if (values_.allFinite()) return "";
  Eigen::Index i = 0;
  while (std::isfinite(values_[i])) ++i;
  return names_[static_cast<std::size_t>(i)];
}

namespace {

Schedule schedule_of(const TracedProblem& traced) {
  return Schedule(traced.at(point_of_inputs(traced)).path_constraints);
}

}  // namespace

PathConstraints::PathConstraints(const TracedProblem& traced, Eigen::Index most_rows)
    : PathConstraints(schedule_of(traced),
                      2 * traced.configuration_size() + traced.control_size() + traced.first_order_size(), most_rows) {}

PathConstraints::PathConstraints(Schedule schedule, Eigen::Index time_input, Eigen::Index most_rows)
    : schedule_(std::move(schedule)),
      tape_(schedule_),
      workspace_(tape_),
      values_(most_rows, static_cast<Eigen::Index>(schedule_.outputs().size())),
      reads_time_(std::ranges::any_of(schedule_.steps(), [time_input](const Schedule::Step& step) {
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

std::vector<EnclosedRate> PathConstraints::on(std::span<const EnclosedRate> part) const {
  return replay<EnclosedRate>(schedule_, part);
}

}  // namespace dmocbench
