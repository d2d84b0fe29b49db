#include "methods/adaptive/extremal_flow.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/vectors.hpp"
#include "methods/numerics/adaptive_integration.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

namespace {

/// The inputs of both tapes: q, v, α, β, u, t.
struct TracedPoint {
  ExpressionVector q, v, alpha, beta, u;
  Expression t;

  TracedPoint(Eigen::Index n, Eigen::Index m) {
    InputCounter inputs;
    q = inputs.take(n);
    v = inputs.take(n);
    alpha = inputs.take(n);
    beta = inputs.take(n);
    u = inputs.take(m);
    t = inputs.take();
  }
};

struct TracedFlow {
  TracedPoint at;
  ExpressionVector acceleration;
  Expression cost;
  Expression hamiltonian;

  TracedFlow(const TracedProblem& problem, double cost_scale)
      : at(problem.configuration_size(), problem.control_size()) {
    const TracedProblem::Values values = problem.at(ControlledState{at.q, at.v, at.u, at.t});
    ExpressionVector force = values.generalised_force - values.momentum_by_time;
    force -= values.momentum_by_configuration * at.v;
    acceleration = solve_symmetric(values.mass, force);
    cost = Expression(cost_scale) * values.running_cost;
    hamiltonian = cost;
    for (Eigen::Index i = 0; i < at.v.size(); ++i) {
      hamiltonian += at.alpha[i] * at.v[i] + at.beta[i] * acceleration[i];
    }
  }

  [[nodiscard]] ExpressionMatrix curvature() const { return hessian(hamiltonian, at.u); }
  [[nodiscard]] Schedule control_step() const {
    return Schedule(ExpressionVector(
        at.u -
        solve_symmetric(curvature(), gradient(hamiltonian, at.u),
                        "the error cannot be estimated: H_u = 0 does not determine the control from the costate, "
                        "because H_uu vanishes; the running cost must be strictly convex in the control")));
  }
  /// True if H is quadratic in u: one step of Newton's method finds the control.
  [[nodiscard]] bool is_quadratic() const {
    const ExpressionMatrix gradients_of_curvature = jacobian(ExpressionVector(curvature().reshaped()), at.u);
    return std::ranges::all_of(
        std::span(gradients_of_curvature.data(), static_cast<std::size_t>(gradients_of_curvature.size())),
        &Expression::is_zero);
  }
  [[nodiscard]] Schedule rates() const {
    ExpressionVector outputs(4 * at.q.size() + 1);
    const Expression minus(-1.0);
    outputs << at.v, acceleration, minus * gradient(hamiltonian, at.q), minus * gradient(hamiltonian, at.v), cost;
    return Schedule(outputs);
  }
};

Schedule transform_of(const TracedProblem& problem) {
  InputCounter inputs;
  State x;
  x.q = inputs.take(problem.configuration_size());
  x.v = inputs.take(problem.configuration_size());
  x.t = inputs.take();
  const TracedProblem::Values values = problem.at(x);
  ExpressionVector outputs(values.momentum.size() + 2 * values.mass.size());
  outputs << values.momentum, values.mass.reshaped(), values.momentum_by_configuration.reshaped();
  return Schedule(outputs);
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

ExtremalFlow::Tapes ExtremalFlow::trace(const TracedProblem& problem, double cost_scale) {
  constexpr int steps_of_other_costs = 4;  // from an error of order h, quadratic convergence leaves rounding
  const TracedFlow flow(problem, cost_scale);
  return {.control_step = Tape(flow.control_step()),
          .rates = Tape(flow.rates()),
          .newton_steps = flow.is_quadratic() ? 1 : steps_of_other_costs};
}

ExtremalFlow::ExtremalFlow(const TracedProblem& problem, double cost_scale)
    : n_(problem.configuration_size()),
      m_(problem.control_size()),
      tapes_(trace(problem, cost_scale)),
      control_memory_(tapes_.control_step),
      rate_memory_(tapes_.rates) {}

void ExtremalFlow::bind(const std::vector<double>& state, Eigen::Index rows) {
  inputs_.clear();
  for (Eigen::Index i = 0; i < 4 * n_; ++i) inputs_.push_back({state.data() + i * rows});
  for (Eigen::Index i = 0; i < m_; ++i) inputs_.push_back({controls_.col(i).data()});
  inputs_.push_back({times_.data()});
}

void ExtremalFlow::find_controls(const std::vector<double>& state, const Trajectory& motion, double tau) {
  const Eigen::Index rows = motion.intervals();
  const Eigen::Index s = motion.stages();
  const Eigen::VectorXd weights = lagrange_basis(motion.tableau.c, tau);
  controls_.setZero(rows, m_);
  next_controls_.resize(rows, m_);
  for (Eigen::Index i = 0; i < s; ++i) controls_ += weights[i] * motion.stage_u(Eigen::seqN(i, rows, s), Eigen::all);
  for (int step = 0; step < tapes_.newton_steps; ++step) {
    bind(state, rows);
    std::vector<double*> outputs;
    for (Eigen::Index i = 0; i < m_; ++i) outputs.push_back(next_controls_.col(i).data());
    tapes_.control_step.evaluate(static_cast<std::size_t>(rows), inputs_, outputs, control_memory_);
    controls_.swap(next_controls_);
  }
}

ExtremalFlow::CarriedNodes ExtremalFlow::carry(const ExtremalStates& nodes, const Trajectory& motion,
                                               double tolerance) {
  const Eigen::Index rows = motion.intervals();
  const Eigen::VectorXd left = motion.node_times.head(rows);
  const Eigen::VectorXd steps = motion.node_times.tail(rows) - left;
  std::vector<double> state(static_cast<std::size_t>(rows * (4 * n_ + 1)));
  Eigen::Map<Eigen::MatrixXd> table(state.data(), rows, 4 * n_ + 1);
  table << nodes.q.topRows(rows), nodes.v.topRows(rows), nodes.alpha.topRows(rows), nodes.beta.topRows(rows),
      Eigen::VectorXd::Zero(rows);
  const auto equations = [&](const std::vector<double>& x, std::vector<double>& rate, double tau) {
    times_ = left + tau * steps;
    find_controls(x, motion, tau);
    bind(x, rows);
    std::vector<double*> outputs;
    for (Eigen::Index i = 0; i <= 4 * n_; ++i) outputs.push_back(rate.data() + i * rows);
    tapes_.rates.evaluate(static_cast<std::size_t>(rows), inputs_, outputs, rate_memory_);
    Eigen::Map<Eigen::MatrixXd>(rate.data(), rows, 4 * n_ + 1).array().colwise() *= steps.array();
  };
  constexpr double first_step = 0.5;
  if (!integrate(equations, state, 0.0, 1.0, first_step, tolerance)) table.setConstant(not_a_number);
  return {{table.leftCols(n_), table.middleCols(n_, n_), table.middleCols(2 * n_, n_), table.middleCols(3 * n_, n_)},
          table.col(4 * n_)};
}

ExtremalCoordinates::ExtremalCoordinates(const TracedProblem& problem, double cost_scale)
    : n_(problem.configuration_size()), cost_scale_(cost_scale), transform_(transform_of(problem)) {}

void ExtremalCoordinates::evaluate(const Eigen::MatrixXd& q, const Eigen::MatrixXd& v, const Eigen::VectorXd& times) {
  std::vector<Tape::Input> inputs;
  for (Eigen::Index i = 0; i < n_; ++i) inputs.push_back({q.col(i).data()});
  for (Eigen::Index i = 0; i < n_; ++i) inputs.push_back({v.col(i).data()});
  inputs.push_back({times.data()});
  values_ = transform_.table(q.rows(), inputs);
}

/// L_vv (0) or L_vq (1).
Eigen::MatrixXd ExtremalCoordinates::matrix(Eigen::Index row, Eigen::Index which) const {
  return values_.row(row).segment(n_ + which * n_ * n_, n_ * n_).reshaped(n_, n_);
}

ExtremalStates ExtremalCoordinates::of_nodes(const Trajectory& motion) {
  if (!motion.has_costates()) throw Error("an optimal trajectory can be replayed only with its costates");
  evaluate(motion.q, motion.v, motion.node_times);
  ExtremalStates states{motion.q, motion.v, cost_scale_ * motion.psi_q, cost_scale_ * motion.psi_p};
  for (Eigen::Index k = 0; k < motion.q.rows(); ++k) {
    const Eigen::VectorXd psi_p = cost_scale_ * motion.psi_p.row(k).transpose();
    states.alpha.row(k) += (matrix(k, 1).transpose() * psi_p).transpose();
    states.beta.row(k) = (matrix(k, 0) * psi_p).transpose();
  }
  return states;
}

ExtremalCoordinates::Canonical ExtremalCoordinates::canonical(const ExtremalStates& states,
                                                              const Eigen::VectorXd& times) {
  evaluate(states.q, states.v, times);
  Canonical result{states.q, values_.leftCols(n_), states.alpha, states.beta};
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    const auto psi_p = solve_if_invertible(matrix(k, 0), states.beta.row(k).transpose());
    if (!psi_p) {
      result.psi_q.row(k).setConstant(not_a_number);
      result.psi_p.row(k).setConstant(not_a_number);
      continue;
    }
    result.psi_p.row(k) = psi_p->transpose();
    result.psi_q.row(k) -= (matrix(k, 1).transpose() * *psi_p).transpose();
  }
  return result;
}

}  // namespace dmocbench
