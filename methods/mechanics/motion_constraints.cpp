#include "methods/mechanics/motion_constraints.hpp"

#include <cmath>
#include <span>

#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/expression/schedule.hpp"
#include "methods/mechanics/point_of_inputs.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

MotionConstraints::MotionConstraints(const TracedProblem& problem)
    : n_(problem.configuration_size()),
      c_(problem.constraint_count()),
      holonomic_(problem.holonomic_count()),
      function_(n_, problem.control_size(),
                [&](const ControlledState& x) {
                  const TracedProblem::ConstraintValues values = problem.constraints_at(x.q, x.v);
                  const ExpressionVector entries = values.jacobian.reshaped();
                  return stacked({values.residual, entries, dmocbench::jacobian(entries, x.q).reshaped()});
                }),
      values_(function_.output_count()) {}

void MotionConstraints::evaluate(const Eigen::VectorXd& q) {
  function_.evaluate(q, Eigen::VectorXd::Zero(n_), Eigen::VectorXd(), 0.0, values_);
}

void MotionConstraints::project(Eigen::Ref<Eigen::VectorXd> q, Eigen::Ref<Eigen::VectorXd> v) {
  constexpr int most_steps = 3;  // from near the manifold each doubles the digits
  const auto least = [&](const Eigen::VectorXd& change) -> Eigen::VectorXd {  // of the first constraints
    const Eigen::MatrixXd by_q = jacobian().topRows(change.size());
    return by_q.transpose() * solve_square(Eigen::MatrixXd(by_q * by_q.transpose()), change);
  };
  for (int step = 0; step < most_steps; ++step) {
    evaluate(q);
    q -= least(residual());
  }
  evaluate(q);
  v -= least(jacobian() * v);
}

Eigen::MatrixXd MotionConstraints::force_by_configuration(const Eigen::VectorXd& mu) const {
  // Entry (a, i) of G stands in row a + c i, its derivative by q_j in column j.
  const auto second = values_.tail(c_ * n_ * n_).reshaped(c_ * n_, n_);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n_, n_);
  for (Eigen::Index i = 0; i < n_; ++i) {
    for (Eigen::Index a = 0; a < c_; ++a) sum.row(i) += mu[a] * second.row(a + c_ * i);
  }
  return sum;
}

ExpressionVector constraint_multipliers(const Problem& problem, const ControlledState& x) {
  constexpr std::size_t own = 4096;  // where inputs of these formulas begin, after the parameters
  const Eigen::Index n = x.q.size();
  InputCounter inputs(own);
  const ControlledState at = take_point(inputs, n, x.u.size(), x.y.size());
  const Expression lagrangian = problem.lagrangian(at.state());
  const ExpressionVector momentum = gradient(lagrangian, at.v);
  ExpressionVector right = gradient(lagrangian, at.q) + problem.force(at) - jacobian(momentum, at.q) * at.v;
  right -= jacobian(momentum, ExpressionVector::Constant(1, at.t));
  if (at.y.size() > 0) right -= jacobian(momentum, at.y) * problem.first_order_rates(at);
  const ExpressionMatrix of_g = jacobian(problem.constraints(at.q), at.q);
  const ExpressionMatrix of_rates = jacobian(problem.velocity_constraints(at.q, at.v), at.v);
  ExpressionMatrix by_v(of_g.rows() + of_rates.rows(), n);  // G
  by_v.topRows(of_g.rows()) = of_g;
  by_v.bottomRows(of_rates.rows()) = of_rates;
  const ExpressionMatrix mass = jacobian(momentum, at.v);
  ExpressionMatrix moved(n, by_v.rows());  // L_vv⁻¹ Gᵀ
  for (Eigen::Index a = 0; a < by_v.rows(); ++a) moved.col(a) = solve_symmetric(mass, by_v.row(a).transpose());
  const ExpressionVector rate = by_v * solve_symmetric(mass, right) + jacobian(by_v * at.v, at.q) * at.v;
  const Schedule formulas(solve_symmetric(by_v * moved, rate));
  std::vector<Expression> point(own);
  for (std::size_t i = 0; i < own; ++i) point[i] = Expression::input(i);
  append(point, stacked({x.q, x.v, x.u, x.y}));
  point.push_back(x.t);
  const std::vector<Expression> result =
      replay<Expression>(formulas, std::span<const Expression>(point).first(formulas.input_count()));
  return Eigen::Map<const ExpressionVector>(result.data(), std::ssize(result));
}

std::vector<Eigen::Index> independent_columns(Eigen::MatrixXd jacobian, const std::vector<bool>& is_preferred) {
  constexpr double tiny = 1e-10;  // relative to the largest entry, where a column counts as dependent
  constexpr double usable = 1e-3;
  const double largest = jacobian.size() == 0 ? 0.0 : jacobian.cwiseAbs().maxCoeff();
  std::vector<Eigen::Index> columns;
  for (Eigen::Index step = 0; step < jacobian.rows(); ++step) {
    Eigen::Index row = 0;
    Eigen::Index column = 0;
    double pivot = 0.0;
    bool is_free = false;
    auto rest = jacobian.bottomRows(jacobian.rows() - step);
    for (Eigen::Index j = 0; j < jacobian.cols(); ++j) {
      Eigen::Index i = 0;
      const double size = rest.col(j).cwiseAbs().maxCoeff(&i);
      const bool is_better_kind = is_preferred[static_cast<std::size_t>(j)] && size > usable * largest;
      if ((is_free && !is_better_kind) || (is_better_kind == is_free && size <= pivot)) continue;
      row = i, column = j, pivot = size, is_free = is_better_kind;
    }
    if (!(pivot > tiny * largest)) return columns;
    columns.push_back(column);
    rest.row(0).swap(rest.row(row));
    for (Eigen::Index i = 1; i < rest.rows(); ++i) rest.row(i) -= rest(i, column) / rest(0, column) * rest.row(0);
    jacobian.col(column).setZero();
  }
  return columns;
}

Eigen::MatrixXd saddle_matrix(const Eigen::MatrixXd& a, const Eigen::MatrixXd& jacobian) {
  const Eigen::Index n = a.rows();
  const Eigen::Index c = jacobian.rows();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + c, n + c);
  matrix.topLeftCorner(n, n) = a;
  matrix.bottomLeftCorner(c, n) = jacobian;
  matrix.topRightCorner(n, c) = jacobian.transpose();
  return matrix;
}

}  // namespace dmocbench
