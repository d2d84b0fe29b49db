#include "methods/transcription/elements/element.hpp"

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

Eigen::Index Element::multipliers(const Tableau& /*tableau*/) const {
  throw Error("constraints g(q) = 0 are not supported with --method " + name() + "; use dmoc, hamiltonian or tangent");
}

std::vector<bool> Element::velocity_multipliers(const Tableau& /*tableau*/) const {
  throw Error("velocity_constraints are not supported with --method " + name() + "; use dmoc, hamiltonian or tangent");
}

bool Element::takes_embedding(const Tableau& /*tableau*/) const { return false; }

IntervalUnknowns take_unknowns(InputCounter& counter, const TracedProblem& problem, const Element& element,
                               const Tableau& tableau) {
  const Eigen::Index n = problem.configuration_size();
  const Eigen::Index second = element.node_state() == NodeState::configuration ? 0 : n;
  const bool has_stages = element.has_stage_unknowns();
  const Eigen::Index interior = has_stages ? element.rates(tableau).stages() - 1 : 0;
  const Eigen::Index interior_y = has_stages ? tableau.stages() - 1 : 0;
  const Eigen::Index controls = element.controls(tableau).stages();
  IntervalUnknowns unknowns;
  unknowns.left_q = counter.take(n);
  unknowns.left_second = counter.take(second);
  unknowns.left_y = counter.take(problem.first_order_size());
  unknowns.right_q = counter.take(n);
  unknowns.right_second = counter.take(second);
  unknowns.right_y = counter.take(problem.first_order_size());
  for (Eigen::Index j = 0; j < interior; ++j) unknowns.rates_q.push_back(counter.take(n));
  for (Eigen::Index j = 0; j < interior && second > 0; ++j) unknowns.rates_second.push_back(counter.take(n));
  for (Eigen::Index j = 0; j < interior_y; ++j) unknowns.rates_y.push_back(counter.take(problem.first_order_size()));
  for (Eigen::Index i = 0; i < controls; ++i) unknowns.controls.push_back(counter.take(problem.control_size()));
  if (problem.constraint_count() == 0) return unknowns;
  std::vector<bool> of_velocity;
  if (problem.velocity_constraint_count() > 0) of_velocity = element.velocity_multipliers(tableau);
  of_velocity.resize(static_cast<std::size_t>(element.multipliers(tableau)), false);
  for (const bool of_all : of_velocity) {
    unknowns.multipliers.push_back(counter.take(of_all ? problem.constraint_count() : problem.holonomic_count()));
  }
  return unknowns;
}

bool has_stages_at_nodes(const Tableau& tableau) { return tableau.c.minCoeff() == 0.0 && tableau.c.maxCoeff() == 1.0; }

bool takes_constraints(const Element& element, const TracedProblem& problem, const Tableau& tableau) {
  if (problem.has_embedding()) return element.takes_embedding(tableau);
  if (problem.constraint_count() == 0) return true;
  try {
    if (problem.velocity_constraint_count() > 0) static_cast<void>(element.velocity_multipliers(tableau));
    return element.multipliers(tableau) > 0;
  } catch (const Error&) {
    return false;
  }
}

ExpressionVector constraint_force(const TracedProblem& problem, const ExpressionVector& q,
                                  const ExpressionVector& multiplier) {
  const ExpressionMatrix jacobian = problem.constraints_at(q, ExpressionVector(q.size())).jacobian;
  return -(jacobian.topRows(multiplier.size()).transpose() * multiplier);
}

ExpressionVector velocity_conditions(const TracedProblem& problem, const ExpressionVector& q,
                                     const ExpressionVector& v) {
  return problem.constraints_at(q, v).jacobian.bottomRows(problem.velocity_constraint_count()) * v;
}

std::vector<ExpressionVector> stage_rates(const ExpressionVector& left, const ExpressionVector& right,
                                          const std::vector<ExpressionVector>& interior, const Eigen::VectorXd& b,
                                          const Expression& h) {
  std::vector<ExpressionVector> rates = interior;
  ExpressionVector last = (right - left) / h;
  for (std::size_t j = 0; j < interior.size(); ++j) last -= Expression(b[static_cast<Eigen::Index>(j)]) * interior[j];
  last /= Expression(b[b.size() - 1]);
  rates.push_back(last);
  return rates;
}

std::vector<ExpressionVector> stage_values(const ExpressionVector& left, const std::vector<ExpressionVector>& rates,
                                           const Eigen::MatrixXd& a, const Expression& h) {
  std::vector<ExpressionVector> stages;
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    ExpressionVector stage = left;
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      stage += (h * Expression(a(i, j))) * rates[static_cast<std::size_t>(j)];
    }
    stages.push_back(stage);
  }
  return stages;
}

ExpressionVector polynomial_at(const Eigen::VectorXd& c, const std::vector<ExpressionVector>& values, double tau) {
  const Eigen::VectorXd weights = lagrange_basis(c, tau);
  ExpressionVector sum(values.front().size());
  for (Eigen::Index j = 0; j < weights.size(); ++j) {
    sum += Expression(weights[j]) * values[static_cast<std::size_t>(j)];
  }
  return sum;
}

ExpressionVector variation(const ExpressionVector& x, const std::vector<std::vector<ConjugatePair>>& stages,
                           const Eigen::VectorXd& b, const Expression& h) {
  ExpressionVector sum(x.size());
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const Expression weight = h * Expression(b[static_cast<Eigen::Index>(i)]);
    std::vector<ExpressionMatrix> weighted;
    for (const ConjugatePair& pair : stages[i]) weighted.emplace_back(weight * jacobian(pair.moved, x).transpose());
    for (std::size_t j = 0; j < weighted.size(); ++j) sum += weighted[j] * stages[i][j].force;
  }
  return sum;
}

ExpressionVector work_of_control(const TracedProblem& problem, const std::vector<ControlledState>& stages,
                                 const ExpressionVector& x, const Eigen::VectorXd& b, const Expression& h) {
  std::vector<std::vector<ConjugatePair>> pairs;
  pairs.reserve(stages.size());
  for (const ControlledState& stage : stages) pairs.push_back({{stage.q, problem.at(stage).control_force}});
  return variation(x, pairs, b, h);
}

Expression quadrature_of_cost(const std::vector<TracedProblem::Values>& stages, const Eigen::VectorXd& b,
                              const Expression& h) {
  Expression sum;
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    sum += Expression(b[i]) * stages[static_cast<std::size_t>(i)].running_cost;
  }
  return h * sum;
}

}  // namespace dmocbench
