#include "methods/diagnostics/exact_discrete_lagrangian.hpp"

#include <algorithm>
#include <utility>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/numerics/adaptive_integration.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/transcription/elements/dmoc_element.hpp"

namespace dmocbench {

namespace {

using PhaseVector = std::vector<long double>;

constexpr long double tolerance = 1e-17L;

/// The consecutive parts of the integrated vector.
template <class Long>
struct Parts {
  Eigen::Map<Eigen::Matrix<Long, Eigen::Dynamic, 1>> q, v;
  /// ∂q/∂(q(0), q̇(0)) and ∂q̇/∂(q(0), q̇(0)), n × 2n: A and B side by side
  Eigen::Map<Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>> q_variation, v_variation;
  Long& action;                                             ///< ∫ L dt
  Eigen::Map<Eigen::Matrix<Long, Eigen::Dynamic, 1>> work;  ///< ∫ f·(A, B) dt, 2n entries

  Parts(Long* data, Eigen::Index n)
      : q(data, n),
        v(data + n, n),
        q_variation(data + 2 * n, n, 2 * n),
        v_variation(data + 2 * n + 2 * n * n, n, 2 * n),
        action(data[2 * n + 4 * n * n]),
        work(data + 2 * n + 4 * n * n + 1, 2 * n) {}

  static std::size_t size(Eigen::Index n) { return static_cast<std::size_t>(4 * n + 4 * n * n + 1); }
};

}  // namespace

ExactDiscreteLagrangian::ExactDiscreteLagrangian(const Problem& problem, const ControlFormula& control)
    : n_(problem.configuration_size()) {
  control_ = Schedule(control(Expression::input(0)));
  const ExpressionVector q = input_vector(0, n_);
  const ExpressionVector v = input_vector(static_cast<std::size_t>(n_), n_);
  const ExpressionVector a = input_vector(static_cast<std::size_t>(2 * n_), n_);
  const Expression t = Expression::input(static_cast<std::size_t>(3 * n_));
  const ControlledState point{q, v, control(t), t};
  const TracedProblem::Values values = TracedProblem(problem).at(point);
  ExpressionVector residual = values.mass * a + values.momentum_by_time;
  residual += values.momentum_by_configuration * v;
  residual -= values.generalised_force;
  std::vector<Expression> outputs;
  append(outputs, residual);
  append(outputs, values.mass);
  append(outputs, jacobian(residual, q));
  append(outputs, jacobian(residual, v));
  outputs.push_back(problem.lagrangian(point.state()));
  append(outputs, values.control_force);
  equation_ = Schedule(outputs);
  momentum_ = Schedule(values.momentum);
}

LongVector ExactDiscreteLagrangian::control(long double t) const {
  return OutputBlocks<long double>(control_, {t}).take(static_cast<Eigen::Index>(control_.outputs().size()));
}

void ExactDiscreteLagrangian::derivative(const PhaseVector& state, PhaseVector& rate, long double t) const {
  PhaseVector copy = state;
  const Parts<long double> x(copy.data(), n_);
  Parts<long double> x_dot(rate.data(), n_);
  PhaseVector inputs(copy.begin(), copy.begin() + 2 * n_);
  inputs.resize(static_cast<std::size_t>(3 * n_), 0.0L);
  inputs.push_back(t);
  // At a = 0 the residual is -L_vv q̈; at the true q̈ its derivatives give the variational equations.
  OutputBlocks<long double> at_zero(equation_, inputs);
  const LongVector force = at_zero.take(n_);
  const LongMatrix mass = at_zero.take(n_, n_);
  x_dot.q = x.v;
  x_dot.v = -solve_square(mass, force);
  std::copy(x_dot.v.begin(), x_dot.v.end(), inputs.begin() + 2 * n_);
  OutputBlocks<long double> blocks(equation_, inputs);
  static_cast<void>(blocks.take(n_, 1 + n_));  // the residual, and L_vv again
  const LongMatrix by_q = blocks.take(n_, n_);
  const LongMatrix by_v = blocks.take(n_, n_);
  x_dot.q_variation = x.v_variation;
  // lazyProduct: the blocked product costs seconds of compile time and pays off only for large matrices.
  const LongMatrix residual_variation = by_q.lazyProduct(x.q_variation) + by_v.lazyProduct(x.v_variation);
  x_dot.v_variation = -solve_square(mass, residual_variation);
  x_dot.action = blocks.take(1)(0, 0);
  x_dot.work = x.q_variation.transpose() * blocks.take(n_).col(0);
}

ExactInterval ExactDiscreteLagrangian::along(const LongVector& q_0, const LongVector& v_0, long double h) const {
  PhaseVector state(Parts<long double>::size(n_), 0.0L);
  Parts<long double> x(state.data(), n_);
  x.q = q_0;
  x.v = v_0;
  x.q_variation.leftCols(n_).setIdentity();
  x.v_variation.rightCols(n_).setIdentity();
  const auto momentum = [&](long double t) {
    PhaseVector inputs(state.begin(), state.begin() + 2 * n_);
    inputs.resize(static_cast<std::size_t>(3 * n_), 0.0L);
    inputs.push_back(t);
    return LongVector(OutputBlocks<long double>(momentum_, inputs).take(n_));
  };
  ExactInterval interval;
  interval.q_0 = q_0;
  interval.v_0 = v_0;
  interval.objects.left_momentum = momentum(0.0L);
  const auto equations = [this](const PhaseVector& at, PhaseVector& rate, long double t) { derivative(at, rate, t); };
  if (!integrate(equations, state, 0.0L, h, h / 4.0L, tolerance))
    throw Error("the step size vanished during the integration of the exact trajectory");
  interval.q_1 = x.q;
  interval.v_1 = x.v;
  interval.derivative.resize(2 * n_, 2 * n_);
  interval.derivative << x.q_variation, x.v_variation;
  interval.right_by_velocity = x.q_variation.rightCols(n_);
  interval.objects.right_momentum = momentum(h);
  interval.objects.lagrangian = x.action;
  interval.objects.right_force =
      solve_square(LongMatrix(interval.right_by_velocity.transpose()), LongVector(x.work.tail(n_)));
  interval.objects.left_force = x.work.head(n_) - x.q_variation.leftCols(n_).transpose() * interval.objects.right_force;
  if (!interval.q_1.allFinite() || !interval.objects.left_force.allFinite()) {
    throw Error("the exact trajectory leaves the domain of the equations of motion, or h is a conjugate time");
  }
  return interval;
}

ExactInterval ExactDiscreteLagrangian::between(const LongVector& q_0, const LongVector& q_1, const LongVector& v_start,
                                               long double h) const {
  constexpr int most_iterations = 30;
  constexpr long double last_step = 1e-15L;
  LongVector v_0 = v_start;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const ExactInterval interval = along(q_0, v_0, h);
    const LongVector step = solve_square(interval.right_by_velocity, LongVector(interval.q_1 - q_1));
    v_0 -= step;
    // Convergence is quadratic, so the next iterate is exact to rounding.
    if (step.lpNorm<Eigen::Infinity>() < last_step * (1.0L + v_0.lpNorm<Eigen::Infinity>())) return along(q_0, v_0, h);
  }
  throw Error("shooting for the trajectory between two configurations does not converge; the step is too large");
}

namespace {

void raise(double& largest, long double error) { largest = std::max(largest, static_cast<double>(error)); }

LongMatrix stage_controls(const ExactDiscreteLagrangian& exact, const Tableau& tableau, long double h) {
  LongMatrix controls(tableau.stages(), exact.control(0.0L).size());
  for (Eigen::Index i = 0; i < tableau.stages(); ++i) controls.row(i) = exact.control(tableau.c[i] * h).transpose();
  return controls;
}

void compare(const DiscreteObjects& discrete, const DiscreteObjects& exact, ConsistencyErrors& errors) {
  raise(errors.lagrangian, std::abs(discrete.lagrangian - exact.lagrangian));
  raise(errors.left_force, (discrete.left_force - exact.left_force).norm());
  raise(errors.right_force, (discrete.right_force - exact.right_force).norm());
  raise(errors.left_legendre, (discrete.left_momentum - exact.left_momentum).norm());
  raise(errors.right_legendre, (discrete.right_momentum - exact.right_momentum).norm());
}

}  // namespace

ConsistencyOrder::ConsistencyOrder(const Problem& problem, const ControlFormula& control,
                                   std::vector<BoundaryState> starts)
    : problem_(problem), exact_(problem, control), starts_(std::move(starts)) {}

std::vector<ConsistencyErrors> ConsistencyOrder::errors(const std::vector<Tableau>& tableaus, double h) const {
  std::vector<ExactInterval> motions;
  motions.reserve(starts_.size());
  for (const BoundaryState& start : starts_) {
    motions.push_back(exact_.along(start.q.cast<long double>(), start.v.cast<long double>(), h));
  }
  const TracedProblem traced(problem_);
  std::vector<ConsistencyErrors> result;
  for (const Tableau& tableau : tableaus) {
    const DiscreteLagrangian discrete(problem_, tableau);
    const OneStepMap<long double> map(traced, DmocElement(), tableau);
    const LongMatrix controls = stage_controls(exact_, tableau, h);
    ConsistencyErrors errors;
    for (const ExactInterval& motion : motions) {
      compare(discrete.at(motion.q_0, motion.q_1, controls, h, 0.0L), motion.objects, errors);
      const auto step = map.advance(motion.q_0, motion.objects.left_momentum, motion.v_0, controls, h, 0.0L);
      raise(errors.map, std::hypot((step.q - motion.q_1).norm(), (step.p - motion.objects.right_momentum).norm()));
    }
    result.push_back(errors);
  }
  return result;
}

}  // namespace dmocbench
