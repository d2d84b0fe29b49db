#include "methods/transcription/interval_functions.hpp"

#include <numeric>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// The unknowns of an element, and the unknowns that the program adds.
struct Unknowns : IntervalUnknowns {
  ExpressionVector left_sums;   // z_k: the cost in Mayer form, integrals
  ExpressionVector right_sums;  // z_{k+1}
  ExpressionVector parameters;  // unknown ones
  ExpressionVector velocity;    // of the right node, where it is an unknown of its own
  LocalInputs inputs;
};

Unknowns make_unknowns(const TracedProblem& problem, const Element& element, const Tableau& tableau,
                       const IntervalRules& rules, bool has_velocity = false) {
  const std::size_t parameters = problem.open_parameters().size();
  InputCounter counter(parameters);
  Unknowns unknowns;
  static_cast<IntervalUnknowns&>(unknowns) = take_unknowns(counter, problem, element, tableau);
  const Eigen::Index sums = problem.integral_count() + (rules.mayer ? 1 : 0);
  unknowns.left_sums = counter.take(sums);
  unknowns.right_sums = counter.take(sums);
  const Expression horizon = rules.free_horizon ? counter.take() : Expression(1.0);
  unknowns.parameters = counter.take(problem.unknown_count());
  unknowns.velocity = counter.take(has_velocity ? problem.configuration_size() : 0);
  unknowns.inputs.parameters = parameters;
  unknowns.inputs.unknowns = counter.taken() - parameters;
  unknowns.h = horizon * Expression::input(unknowns.inputs.step());
  unknowns.t = horizon * Expression::input(unknowns.inputs.time());
  if (problem.first_order_size() == 0 || !element.has_stage_unknowns()) return unknowns;
  unknowns.rates_y = stage_rates(unknowns.left_y, unknowns.right_y, unknowns.rates_y, tableau.b, unknowns.h);
  unknowns.stages_y = stage_values(unknowns.left_y, unknowns.rates_y, tableau.a, unknowns.h);
  return unknowns;
}

/// Ẏ_i - g at the stages. Equations of nodes have the factor h of an impulse, and then these have it too: a filter adds
/// up the violations of all equations, and would let one kind outweigh the other N times.
ExpressionVector first_order_equations(const TracedProblem& problem, const Unknowns& unknowns,
                                       const IntervalTrace& trace) {
  if (problem.first_order_size() == 0) return {};
  const Expression factor = trace.left_rows.size() > 0 ? unknowns.h : Expression(1.0);
  std::vector<ExpressionVector> equations;
  for (std::size_t i = 0; i < trace.stages.size(); ++i) {
    equations.emplace_back(factor * (unknowns.rates_y[i] - problem.of_stages().at(trace.stages[i]).first_order_rates));
  }
  return stacked(equations);
}

ExpressionVector path_rows(const TracedProblem& problem, const std::vector<ControlledState>& stages,
                           const std::vector<Eigen::Index>& bounded_velocities) {
  std::vector<ExpressionVector> rows;
  for (const ControlledState& stage : stages) {
    for (const Eigen::Index i : bounded_velocities) rows.emplace_back(ExpressionVector::Constant(1, stage.v[i]));
    if (problem.path_constraint_count() > 0) rows.push_back(problem.of_stages().at(stage).path_constraints);
  }
  return stacked(rows);
}

/// z_{k+1} - z_k less h Σ b_i c: of the cost in Mayer form, then of the integrals.
ExpressionVector sum_rows(const TracedProblem& problem, const Unknowns& unknowns, const IntervalTrace& trace,
                          const Tableau& tableau, const Expression& cost, bool mayer) {
  ExpressionVector added(unknowns.left_sums.size());
  if (mayer) added[0] = cost;
  auto integrals = added.tail(problem.integral_count());
  for (std::size_t i = 0; i < trace.stages.size() && integrals.size() > 0; ++i) {
    const Expression weight = unknowns.h * Expression(tableau.b[static_cast<Eigen::Index>(i)]);
    integrals += weight * problem.of_stages().at(trace.stages[i]).integrands;
  }
  return unknowns.right_sums - unknowns.left_sums - added;
}

/// The one stage in θ, where nodes carry θ: in the middle of the nodes.
std::vector<ControlledState> stages_between_nodes(std::vector<ControlledState> stages, const Unknowns& unknowns) {
  stages[0].q = 0.5 * (unknowns.left_q + unknowns.right_q);
  stages[0].v = (unknowns.right_q - unknowns.left_q) / unknowns.h;
  return stages;
}

Schedule stage_table(const std::vector<ControlledState>& stages, const std::vector<ExpressionVector>& rates_y) {
  std::vector<ExpressionVector> parts;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const ControlledState& stage = stages[i];
    parts.push_back(stage.q);
    parts.push_back(stage.v);
    parts.emplace_back(ExpressionVector::Constant(1, stage.t));
    parts.push_back(stage.u);
    parts.push_back(stage.y);
    if (stage.y.size() > 0) parts.push_back(rates_y[i]);
  }
  return Schedule(stacked(parts));
}

}  // namespace

LocalFunctions trace_velocity_tie(const TracedProblem& traced, const Element& element, const Tableau& tableau,
                                  const IntervalRules& rules) {
  const Unknowns unknowns = make_unknowns(traced, element, tableau, rules, true);
  const TracedProblem problem = traced.with_open_inputs(unknowns.parameters);
  const State right{unknowns.right_q, unknowns.velocity, unknowns.t + unknowns.h, unknowns.right_y};
  const ExpressionVector tie = element.trace(problem, tableau, unknowns).right_momentum - problem.at(right).momentum;
  return differentiate(Expression(0.0), tie, unknowns.inputs.unknowns, unknowns.inputs.parameters);
}

IntervalFunctions trace_interval(const TracedProblem& traced, const Element& element, const Tableau& tableau,
                                 const IntervalRules& rules) {
  if (traced.has_embedding() && !element.takes_embedding(tableau)) {
    throw Error(
        "the embedding of constraints is supported only by dmoc and hamiltonian with --tableau gauss --stages 1");
  }
  const Unknowns unknowns = make_unknowns(traced, element, tableau, rules);
  const TracedProblem problem = traced.with_open_inputs(unknowns.parameters);
  IntervalTrace trace = element.trace(problem, tableau, unknowns);
  trace.stage_equations = stacked({trace.stage_equations, first_order_equations(problem, unknowns, trace)});
  const ExpressionVector path = path_rows(problem, trace.stages, rules.bounded_velocities);
  const Expression running = Expression(rules.cost_scale) * trace.cost;
  const ExpressionVector rows = stacked({trace.left_rows, trace.right_rows, trace.stage_equations, path,
                                         sum_rows(problem, unknowns, trace, tableau, running, rules.mayer)});
  const Expression cost = rules.mayer ? Expression(0.0) : running;

  IntervalFunctions functions;
  const Eigen::Index of_nodes = 2 * (unknowns.left_q.size() + unknowns.left_second.size() + unknowns.left_y.size());
  static_cast<LocalFunctions&>(functions) =
      differentiate(cost, rows, unknowns.inputs.unknowns, unknowns.inputs.parameters, of_nodes);
  functions.has_stage_unknowns = element.has_stage_unknowns();
  functions.rates = element.rates(tableau);
  functions.controls = element.controls(tableau);
  functions.node_rows = trace.left_rows.size();
  functions.stage_equations = trace.stage_equations.size();
  functions.path_rows = path.size();
  functions.mayer = rules.mayer;
  functions.free_horizon = rules.free_horizon;
  functions.integrals = problem.integral_count();
  for (const ExpressionVector& vector : unknowns.multipliers) functions.conditions.push_back(vector.size());
  functions.multipliers = std::reduce(functions.conditions.begin(), functions.conditions.end());
  functions.momenta = Schedule(stacked({trace.left_momentum, trace.right_momentum, trace.left_impulse,
                                        trace.right_impulse, stacked(trace.stage_forces)}));
  const auto stages = problem.has_embedding() ? stages_between_nodes(trace.stages, unknowns) : trace.stages;
  functions.stages = stage_table(stages, unknowns.rates_y);
  return functions;
}

}  // namespace dmocbench
