#include "methods/transcription/end_functions.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/expression/schedule.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/motion_constraints.hpp"
#include "methods/mechanics/problem_bounds.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

namespace {

/// The state of an end: its unknowns, and numbers for the rest.
struct End {
  ExpressionVector q;
  ExpressionVector p = {};  // Hamiltonian only
  ExpressionVector v;
  ExpressionVector y = {};
};

/// Hidden constraints are formed with L_vv at rest. Throws `Error` if L_vv is another one in motion.
void require_quadratic(const Problem& problem, const TracedProblem& traced) {
  LegendreTransform legendre(traced);
  const BoundaryState at = problem.initial_state();
  const auto mass_at = [&](const Eigen::VectorXd& v) { return legendre.at(at.q, v, 0.0, at.y).mass; };
  const Eigen::MatrixXd at_rest = mass_at(Eigen::VectorXd::Zero(at.q.size()));
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    // At the speeds of the guess, each coordinate with another one.
    const Eigen::VectorXd speed = problem.guess(share * problem.horizon()).v.cwiseAbs().array() + 1.0;
    const Eigen::VectorXd order = Eigen::VectorXd::LinSpaced(speed.size(), 0.5, 1.0);
    const double change = (mass_at(share * speed.cwiseProduct(order)) - at_rest).lpNorm<Eigen::Infinity>();
    if (change <= 1e-9 * at_rest.lpNorm<Eigen::Infinity>()) continue;
    throw Error(problem.name() +
                ": hamiltonian supports constraints g(q) = 0 only if L is quadratic in v, but L_vv depends on v; use "
                "dmoc or tangent");
  }
}

/// The components of an end that are released: independent columns of G, and of G L_vv⁻¹ where p is fixed. Velocity
/// constraints, the last rows of G, release no q.
ReleasedComponents released(const Problem& problem, const TracedProblem& traced, const BoundaryState& state,
                            const EndBounds& end, double t, bool fixes_momentum, const char* name) {
  MotionConstraints constraints(traced);
  constraints.evaluate(state.q);
  const bool has_velocity = constraints.count() > constraints.holonomic_count();
  const auto choose = [&](const Eigen::MatrixXd& jacobian, const Bounds& bounds) {
    std::vector<bool> is_free;
    for (Eigen::Index i = 0; i < bounds.lower.size(); ++i) is_free.push_back(!bounds.is_fixed(i));
    std::vector<Eigen::Index> columns = independent_columns(jacobian, is_free);
    if (std::ssize(columns) < jacobian.rows()) {
      throw Error("{}: {} are dependent at {}: {} has rank {}, not {}", problem.name(),
                  has_velocity ? "velocity_constraints" : "constraints", member_name(name),
                  has_velocity ? "A" : "G = dg/dq", columns.size(), jacobian.rows());
    }
    std::erase_if(columns, [&](Eigen::Index i) { return is_free[static_cast<std::size_t>(i)]; });
    return columns;
  };
  const Eigen::MatrixXd jacobian = constraints.jacobian();
  ReleasedComponents result{.q = choose(jacobian.topRows(constraints.holonomic_count()), end.q)};
  if (!fixes_momentum) {
    result.second = choose(jacobian, end.v);
    return result;
  }
  const Eigen::MatrixXd mass = LegendreTransform(traced).at(state.q, state.v, t, state.y).mass;
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
  rules.constraints = traced.constraint_count();
  if (rules.constraints == 0) return rules;
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
    End end{.q = unknowns.take(n), .v = given.v.cast<Expression>()};
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
    const ExpressionVector force = -(traced.constraints_at(last.q, last.v).jacobian.transpose() * last_multiplier);
    if (rules.last_has_velocity()) {
      ties.back() += force;
    } else {
      ties.push_back(force);
    }
  }
  const ExpressionVector tied = stacked(ties);
  std::vector<ExpressionVector> constraints;
  if (rules.has_first_constraints()) {
    const TracedProblem::ConstraintValues values = traced.constraints_at(first.q, first.v);
    constraints = {values.residual, values.jacobian * first.v};
  }
  if (rules.has_last_constraints()) constraints.emplace_back(traced.constraints_at(last.q, last.v).jacobian * last.v);
  if (tied.size() == 0 && constraints.empty() && ends.conditions.size() == 0 && cost.is_zero()) return std::nullopt;
  EndFunctions functions;
  static_cast<LocalFunctions&>(functions) = differentiate(cost, stacked({tied, stacked(constraints), ends.conditions}),
                                                          unknowns.taken() - parameters, parameters);
  functions.ties = tied.size();
  functions.conditions = ends.conditions.size();
  return functions;
}

namespace {

/// The known part of the point (q, v, u, t) at an end: the values, 0 where they are unknown.
struct KnownPoint {
  const char* name;             ///< of the function that states it
  double time;                  ///< of the end
  std::vector<double> values;   ///< q, v, u, y, t
  std::vector<bool> are_given;  ///< as many
};

KnownPoint known_point(const char* name, const EndBounds& end, Eigen::Index controls, double time, bool is_time_given) {
  const auto add = [](KnownPoint& point, const Bounds& bounds) {
    for (Eigen::Index i = 0; i < bounds.lower.size(); ++i) {
      point.values.push_back(bounds.is_fixed(i) ? bounds.lower[i] : 0.0);
      point.are_given.push_back(bounds.is_fixed(i));
    }
  };
  KnownPoint point{name, time, {}, {}};
  add(point, end.q);
  add(point, end.v);
  point.values.resize(point.values.size() + static_cast<std::size_t>(controls), 0.0);
  point.are_given.resize(point.values.size(), false);
  add(point, end.y);
  point.values.push_back(time);
  point.are_given.push_back(is_time_given);
  return point;
}

/// True unless every constraint is kept where the components that are not given vanish, which settles most problems
/// fast.
bool may_be_broken(const TracedProblem& traced, const Bounds& path, const KnownPoint& point) {
  const Eigen::Index n = traced.configuration_size();
  const Eigen::Map<const Eigen::VectorXd> x(point.values.data(), static_cast<Eigen::Index>(point.values.size()));
  const Eigen::Index m = traced.control_size();
  const MotionPoint numbers{x.head(n), x.segment(n, n), x.segment(2 * n, m),
                            x.segment(2 * n + m, traced.first_order_size())};
  const Eigen::MatrixXd table = traced.table({&numbers, 1}, Eigen::VectorXd::Constant(1, point.time));
  const auto h = table.row(0).segment(3 * n + 1, traced.path_constraint_count());
  return !((h.transpose().array() >= path.lower.array()).all() && (h.transpose().array() <= path.upper.array()).all());
}

bool reads_given_only(const Schedule& formula, const std::vector<bool>& are_given) {
  return std::ranges::all_of(formula.steps(), [&](const Schedule::Step& step) {
    return step.operation != Operation::input || are_given[step.input_index];
  });
}

/// The uncertainty of a formula of numbers known to twelve digits: Σ |∂h/∂x_i x_i| 1e-12.
double uncertainty(const Expression& h, const ExpressionVector& inputs, std::span<const double> values) {
  const std::vector<double> derivatives = replay<double>(Schedule(gradient(h, inputs)), values);
  double sum = 1.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += std::abs(derivatives[i] * values[i]);
  return 1e-12 * sum;
}

void require_constraints_at(const KnownPoint& point, const Problem& problem, const TracedProblem& traced,
                            const Bounds& path) {
  if (!may_be_broken(traced, path, point)) return;
  const Eigen::Index n = traced.configuration_size();
  const Eigen::Index m = traced.control_size();
  const Eigen::Index l = traced.first_order_size();
  const ExpressionVector x = input_vector(0, 2 * n + m + l + 1);
  const ExpressionVector constraints = traced
                                           .at(ControlledState{x.head(n), x.segment(n, n), x.segment(2 * n, m),
                                                               x[2 * n + m + l], x.segment(2 * n + m, l)})
                                           .path_constraints;
  const std::vector<std::string> names = problem.card().path_constraint_names;
  const std::span<const double> values(point.values);
  for (std::size_t i = 0; i < static_cast<std::size_t>(constraints.size()); ++i) {
    const Expression& h = constraints[static_cast<Eigen::Index>(i)];
    const Schedule formula(std::span(&h, 1));
    if (!reads_given_only(formula, point.are_given)) continue;
    const double value = replay<double>(formula, values).front();
    const auto entry = static_cast<Eigen::Index>(i);
    const bool is_below = value < path.lower[entry];
    const double excess = is_below ? path.lower[entry] - value : value - path.upper[entry];
    if (!(excess > uncertainty(h, x, values))) continue;  // a NaN at an end may be a number inside
    throw Error(
        "{}: {} and path_constraints contradict each other: path_constraints[{}]{} is {:g} at t = {:g}, "
        "but must be at {} {:g}",
        problem.name(), member_name(point.name), i, names.empty() ? "" : " (" + names[i] + ")", value, point.time,
        is_below ? "least" : "most", is_below ? path.lower[entry] : path.upper[entry]);
  }
}

}  // namespace

void require_path_constraints_at_ends(const Problem& problem, const TracedProblem& traced, const ProblemBounds& bounds,
                                      double horizon) {
  // Unknown parameters may be such that the ends keep the constraints.
  if (traced.path_constraint_count() == 0 || traced.unknown_count() > 0) return;
  const Bounds path = bounds.of_path(traced.path_constraint_count());
  const Eigen::Index m = traced.control_size();
  require_constraints_at(known_point("initial_state", bounds.first, m, 0.0, true), problem, traced, path);
  require_constraints_at(known_point("final_state", bounds.last, m, horizon, !bounds.horizon.is_free()), problem,
                         traced, path);
}

void require_motion_constraints_at_ends(const Problem& problem, const TracedProblem& traced,
                                        const ProblemBounds& bounds) {
  // Unknown parameters may be such that the ends keep the constraints.
  if (traced.constraint_count() == 0 || traced.unknown_count() > 0) return;
  constexpr double known_digits = 1e-9;  // ends are numbers that users compute
  MotionConstraints constraints(traced);
  const auto require_small = [&](const Eigen::VectorXd& values, const Eigen::VectorXd& of, const char* what,
                                 const char* name) {
    const Eigen::VectorXd terms = constraints.jacobian().cwiseAbs() * of.cwiseAbs();
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      if (std::abs(values[i]) <= known_digits * (1.0 + terms[i])) continue;
      const Eigen::Index of_velocity = i - traced.holonomic_count();
      const bool is_holonomic = of_velocity < 0;
      throw Error("{}: {} violates {}constraints[{}]: {} = {:.3g}, but must be 0", problem.name(), member_name(name),
                  is_holonomic ? "" : "velocity_", is_holonomic ? i : of_velocity, is_holonomic ? what : "A v",
                  values[i]);
    }
  };
  for (const auto& [end, name] : {std::pair(&bounds.first, "initial_state"), std::pair(&bounds.last, "final_state")}) {
    if (!end->q.all_fixed()) continue;
    constraints.evaluate(end->q.lower);
    require_small(constraints.residual(), end->q.lower, "g", name);
    if (!end->v.all_fixed()) continue;
    require_small(constraints.jacobian() * end->v.lower, end->v.lower, "G v", name);
  }
}

}  // namespace dmocbench
