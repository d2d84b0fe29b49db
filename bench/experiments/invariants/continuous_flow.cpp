#include "bench/experiments/invariants/continuous_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/experiments/invariants/example_systems.hpp"
#include "bench/run/column.hpp"
#include "bench/run/interrupt.hpp"
#include "methods/diagnostics/exact_discrete_lagrangian.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/numerics/adaptive_integration.hpp"

namespace dmocbench {

namespace {

struct FlowMomentum {
  std::string problem;
  const char* force = "";
  double horizon = 0.0;
  double tolerance = 0.0;
  double change = 0.0;
  double work = 0.0;
};

/// Integrates (q, v) and the work of f along ξ under a smooth control.
FlowMomentum momentum_along(const InvariantSystem& system) {
  constexpr double horizon = 10.0;
  constexpr double tolerance = 1e-12;
  const Problem& problem = *system.problem;
  const Eigen::Index n = problem.configuration_size();
  const TracedProblem traced(problem);
  EquationsOfMotion motion(traced);
  LegendreTransform legendre(traced);
  PointFunction force(n, problem.control_size(), [&](const ControlledState& x) { return problem.force(x); });
  const Eigen::VectorXd xi = constant_generator(problem);
  Eigen::VectorXd f(n);
  const auto rate = [&](const std::vector<double>& x, std::vector<double>& derivative, double t) {
    throw_if_interrupted();
    const Eigen::VectorXd u = Eigen::VectorXd::NullaryExpr(problem.control_size(), [&](Eigen::Index j) {
      return system.amplitude * std::sin(1.0 + 2.3 * t + 3.7 * static_cast<double>(j));
    });
    motion.write_rate(x, u, t, derivative);
    force.evaluate(Eigen::Map<const Eigen::VectorXd>(x.data(), n), Eigen::Map<const Eigen::VectorXd>(x.data() + n, n),
                   u, t, f);
    derivative.back() = f.dot(xi);
  };
  std::vector<double> state(system.start.q.begin(), system.start.q.end());
  state.insert(state.end(), system.start.v.begin(), system.start.v.end());
  state.push_back(0.0);
  if (!integrate<double>(rate, state, 0.0, horizon, 0.1, tolerance)) {
    throw Error("the trajectory of " + problem.name() + " could not be integrated");
  }
  const Eigen::Map<const Eigen::VectorXd> q(state.data(), n);
  const Eigen::Map<const Eigen::VectorXd> v(state.data() + n, n);
  const double first = legendre.momentum(system.start.q, system.start.v, 0.0).dot(xi);
  return {.problem = problem.name(),
          .force = system.orthogonal ? "orthogonal" : "along",
          .horizon = horizon,
          .tolerance = tolerance,
          .change = legendre.momentum(q, v, horizon).dot(xi) - first,
          .work = state.back()};
}

/// Ω(a, b) = aᵀ W b of a form dp∧dq, with p = L_v(q, v).
Eigen::MatrixXd lagrangian_form(LegendreTransform& legendre, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  const Eigen::Index n = q.size();
  const auto [p, by_v, by_q, by_y] = legendre.at(q, v, 0.0);
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  form.topLeftCorner(n, n) = by_q.transpose() - by_q;
  form.topRightCorner(n, n) = -by_v;
  form.bottomLeftCorner(n, n) = by_v.transpose();
  return form;
}

struct FlowSymplecticity {
  std::string problem;
  double horizon = 0.0;
  double defect = 0.0;
  double rounding = 0.0;
  double printed_change = 0.0;
};

FlowSymplecticity form_along(const MappedStates& system) {
  constexpr double horizon = 1.0;
  const Problem& problem = *system.problem;
  const Eigen::Index n = problem.configuration_size();
  const TracedProblem traced(problem);
  LegendreTransform legendre(traced);
  const ExactDiscreteLagrangian flow(
      problem, [&](const Expression&) { return ExpressionVector::Constant(problem.control_size(), Expression(0.0)); });
  // L_vv is symmetric, so that the printed dv∧dv has no part, and dq∧dq is left.
  const auto printed = [n](const Eigen::MatrixXd& form) {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    result.topLeftCorner(n, n) = form.topLeftCorner(n, n);
    return result;
  };
  const auto change = [](const Eigen::MatrixXd& d, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after) {
    return (d.transpose() * after * d - before).cwiseAbs().maxCoeff();
  };
  FlowSymplecticity result{.problem = problem.name(), .horizon = horizon};
  for (const BoundaryState& state : system.states) {
    throw_if_interrupted();
    const ExactInterval motion = flow.along(state.q.cast<long double>(), state.v.cast<long double>(), horizon);
    const Eigen::MatrixXd d = motion.derivative.cast<double>();
    const Eigen::MatrixXd before = lagrangian_form(legendre, state.q, state.v);
    const Eigen::MatrixXd after = lagrangian_form(legendre, motion.q_1.cast<double>(), motion.v_1.cast<double>());
    result.defect = std::max(result.defect, change(d, before, after));
    result.printed_change = std::max(result.printed_change, change(d, printed(before), printed(after)));
    result.rounding = std::max(result.rounding, std::numeric_limits<double>::epsilon() * d.cwiseAbs2().maxCoeff() *
                                                    after.cwiseAbs().maxCoeff());
  }
  return result;
}

}  // namespace

Table flow_momentum_table() {
  std::vector<FlowMomentum> rows;
  for (const InvariantSystem& system : invariant_systems()) rows.push_back(momentum_along(system));
  return table_of(Columns<FlowMomentum>{{"problem", "", "name of the problem", &FlowMomentum::problem, in_key},
                                        {"force", "", "force: orthogonal to the group action, or along it",
                                         &FlowMomentum::force, in_key},
                                        {"horizon", "", "T", &FlowMomentum::horizon, in_key},
                                        {"tolerance", "", "tolerance of the integration", &FlowMomentum::tolerance},
                                        {"momentum_change", "", "J(T) - J(0)", &FlowMomentum::change},
                                        {"work", "", "integral of f·xi", &FlowMomentum::work}},
                  rows);
}

Table flow_symplecticity_table(const std::vector<MappedStates>& systems) {
  std::vector<FlowSymplecticity> rows;
  for (const MappedStates& system : systems) rows.push_back(form_along(system));
  return table_of(
      Columns<FlowSymplecticity>{
          {"problem", "", "name of the problem", &FlowSymplecticity::problem, in_key},
          {"horizon", "", "T", &FlowSymplecticity::horizon, in_key},
          {"defect", "", "largest entry of D^T Omega_L D - Omega_L over some states (D: derivative of the flow)",
           &FlowSymplecticity::defect},
          {"rounding", "", "machine epsilon times the largest squared entry of D times the largest entry of Omega_L",
           &FlowSymplecticity::rounding},
          {"printed_change", "", "defect of the form as printed, only dq∧dq", &FlowSymplecticity::printed_change}},
      rows);
}

}  // namespace dmocbench
