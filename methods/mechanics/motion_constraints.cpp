#include "methods/mechanics/motion_constraints.hpp"

#include <cmath>

#include "methods/expression/derivatives.hpp"
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
