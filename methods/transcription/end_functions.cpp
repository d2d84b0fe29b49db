#include "methods/transcription/end_functions.hpp"

#include <vector>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/mechanics/holonomic_constraints.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/problem_bounds.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

namespace {

/// The state of an end: its unknowns, and numbers for the rest.
struct End {
  ExpressionVector q;
  ExpressionVector p;  // Hamiltonian only
  ExpressionVector v;
  ExpressionVector y;
};

/// Hidden constraints are formed with L_vv at rest. Throws `Error` if L_vv is another one in motion.
void require_quadratic(const Problem& problem, const TracedProblem& traced) {
  LegendreTransform legendre(traced);
  const BoundaryState at = problem.initial_state();
  const auto mass_at = [&](const Eigen::VectorXd& v) { return legendre.mass(at.q, v, 0.0, at.y); };
  const Eigen::MatrixXd at_rest = mass_at(Eigen::VectorXd::Zero(at.q.size()));
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    // At the speeds of the guess, each coordinate with another one.
    const Eigen::VectorXd speed = problem.guess(share * problem.horizon()).v.cwiseAbs().array() + 1.0;
    const Eigen::VectorXd order = Eigen::VectorXd::LinSpaced(speed.size(), 0.5, 1.0);
    const double change = (mass_at(share * speed.cwiseProduct(order)) - at_rest).lpNorm<Eigen::Infinity>();
    if (change <= 1e-9 * at_rest.lpNorm<Eigen::Infinity>()) continue;
    throw Error(problem.name() +
                ": hamiltonian takes constraints g(q) = 0 only where L is quadratic in the velocity, and here L_vv "
                "depends on it; take dmoc or tangent");
  }
}

/// The components of an end that are released: independent columns of G, and of G L_vv⁻¹ where p is fixed.
ReleasedComponents released(const Problem& problem, const TracedProblem& traced, const BoundaryState& state,
                            const EndBounds& end, double t, bool fixes_momentum, const char* name) {
  HolonomicConstraints constraints(traced);
  constraints.evaluate(state.q);
  const auto choose = [&](const Eigen::MatrixXd& jacobian, const Bounds& bounds) {
    std::vector<bool> is_free;
    for (Eigen::Index i = 0; i < bounds.lower.size(); ++i) is_free.push_back(!bounds.is_fixed(i));
    std::vector<Eigen::Index> columns = independent_columns(jacobian, is_free);
    if (std::ssize(columns) < constraints.count()) {
      throw Error(fmt::format("{}: constraints are dependent at {}: G = dg/dq has rank {}, not {}", problem.name(),
                              member_name(name), columns.size(), constraints.count()));
    }
    std::erase_if(columns, [&](Eigen::Index i) { return is_free[static_cast<std::size_t>(i)]; });
    return columns;
  };
  const Eigen::MatrixXd jacobian = constraints.jacobian();
  ReleasedComponents result{.q = choose(jacobian, end.q), .second = {}};
  if (!fixes_momentum) {
    result.second = choose(jacobian, end.v);
    return result;
  }
  const Eigen::MatrixXd mass = LegendreTransform(traced).mass(state.q, state.v, t, state.y);
  result.second = choose(solve_square(mass, Eigen::MatrixXd(jacobian.transpose())).transpose(), end.v);
  return result;
}

}  // namespace

EndRules end_rules(const Problem& problem, const TracedProblem& traced, NodeState node_state, bool mayer) {
  EndRules rules;
  rules.node_state = node_state;
  rules.cost_scale = problem.cost_scale();
  rules.mayer = mayer;
  const ProblemBounds bounds = problem_bounds(problem);
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
  rules.holonomic = traced.holonomic_count();
  if (rules.holonomic == 0) return rules;
  if (node_state == NodeState::momentum) require_quadratic(problem, traced);
  const BoundaryState first = problem.initial_state();
  const BoundaryState last = problem.final_state();
  if (!rules.first_clamped) {
    rules.released_at_first = released(problem, traced, first, bounds.first, 0.0, false, "initial_state");
  }
  const bool fixes_momentum = node_state == NodeState::momentum && rules.last_clamped;
  rules.released_at_last =
      released(problem, traced, last, bounds.last, problem.horizon(), fixes_momentum, "final_state");
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
  const ExpressionVector last_multiplier = unknowns.take(rules.last_multipliers());
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
  if (rules.last_multipliers() > 0) {
    const ExpressionVector force = -(traced.holonomic_at(last.q, last.v).jacobian.transpose() * last_multiplier);
    if (rules.last_has_velocity()) {
      ties.back() += force;
    } else {
      ties.push_back(force);
    }
  }
  const ExpressionVector tied = stacked(ties);
  std::vector<ExpressionVector> holonomic;
  if (rules.first_holonomic() > 0) {
    const TracedProblem::HolonomicValues values = traced.holonomic_at(first.q, first.v);
    holonomic = {values.residual, values.jacobian * first.v};
  }
  if (rules.last_holonomic() > 0) holonomic.emplace_back(traced.holonomic_at(last.q, last.v).jacobian * last.v);
  if (tied.size() == 0 && holonomic.empty() && ends.conditions.size() == 0 && cost.is_zero()) return std::nullopt;
  EndFunctions functions;
  static_cast<LocalFunctions&>(functions) = differentiate(cost, stacked({tied, stacked(holonomic), ends.conditions}),
                                                          unknowns.taken() - parameters, parameters);
  functions.ties = tied.size();
  functions.conditions = ends.conditions.size();
  return functions;
}

}  // namespace dmocbench
