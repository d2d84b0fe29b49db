#include "methods/transcription/end_functions.hpp"

#include <vector>

namespace dmocbench {

namespace {

/// The state of an end: its unknowns, and numbers for the rest.
struct End {
  ExpressionVector q;
  ExpressionVector p;  // Hamiltonian only
  ExpressionVector v;
  ExpressionVector y;
};

}  // namespace

EndRules end_rules(const Problem& problem, const TracedProblem& traced, NodeState node_state, bool mayer) {
  EndRules rules;
  rules.node_state = node_state;
  rules.cost_scale = problem.cost_scale();
  rules.mayer = mayer;
  const ProblemBounds bounds = problem.bounds();
  rules.free_horizon = bounds.horizon.is_free();
  // The momentum of a given velocity may depend on a free horizon, or on unknown parameters.
  const bool has_momenta = node_state != NodeState::velocity;
  const bool varies = has_momenta && traced.momentum_depends_on_unknowns();
  const bool moves = has_momenta && rules.free_horizon && traced.momentum_depends_on_time();
  const auto is_clamped = [&](const EndBounds& end) {
    const bool slides = has_momenta && traced.momentum_depends_on_first_order() && !end.y.all_fixed();
    return end.all_fixed() && !varies && !slides;
  };
  rules.first_clamped = is_clamped(bounds.first);
  rules.last_clamped = is_clamped(bounds.last) && !moves;
  return rules;
}

std::optional<EndFunctions> trace_ends(const Problem& problem, const TracedProblem& closed, const EndRules& rules) {
  const std::size_t parameters = closed.open_parameters().size();
  InputCounter unknowns(parameters);
  const auto take_end = [&](bool has_velocity, const BoundaryState& given) {
    const Eigen::Index n = closed.configuration_size();
    End end{.q = unknowns.take(n), .p = {}, .v = given.v.cast<Expression>(), .y = {}};
    if (rules.node_state == NodeState::momentum) end.p = unknowns.take(n);
    if (rules.node_state == NodeState::velocity) end.v = unknowns.take(n);
    end.y = unknowns.take(closed.first_order_size());
    if (has_velocity) end.v = unknowns.take(n);
    return end;
  };
  const End first = take_end(rules.first_has_velocity(), problem.initial_state());
  const End last = take_end(rules.last_has_velocity(), problem.final_state());
  const Expression running = rules.mayer ? unknowns.take() : Expression(0.0);
  const Expression horizon = rules.free_horizon ? unknowns.take() : Expression(problem.horizon());
  const TracedProblem traced = closed.with_open_inputs(unknowns.take(closed.unknown_count()));
  const State first_state{first.q, first.v, Expression(0.0), first.y};
  const State last_state{last.q, last.v, horizon, last.y};
  const TracedProblem::EndValues ends = traced.at_ends(first_state, last_state);
  const Expression cost = running + Expression(rules.cost_scale) * ends.final_cost;

  std::vector<ExpressionVector> ties;
  const auto tie = [&](const End& end, const State& state, double sign) {
    const ExpressionVector momentum = traced.at(state).momentum;
    ties.emplace_back(rules.node_state == NodeState::configuration ? ExpressionVector(Expression(sign) * momentum)
                                                                   : ExpressionVector(end.p - momentum));
  };
  if (rules.first_has_velocity()) tie(first, first_state, 1.0);
  if (rules.last_has_velocity()) tie(last, last_state, -1.0);
  const ExpressionVector tied = stacked(ties);
  if (tied.size() == 0 && ends.conditions.size() == 0 && cost.is_zero()) return std::nullopt;
  EndFunctions functions;
  static_cast<LocalFunctions&>(functions) =
      differentiate(cost, stacked({tied, ends.conditions}), unknowns.taken() - parameters, parameters);
  functions.ties = tied.size();
  functions.conditions = ends.conditions.size();
  return functions;
}

}  // namespace dmocbench
