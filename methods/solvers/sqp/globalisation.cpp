#include "methods/solvers/sqp/globalisation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace dmocbench::sqp {

double Globalisation::merit(const Linearisation& at) const {
  return at.objective + weight_ * violations(program_, at.constraints).lpNorm<1>();
}

LineSearchResult Globalisation::search(const Linearisation& from, const Eigen::VectorXd& step, double curvature) {
  constexpr double sufficient = 1e-4;
  constexpr double kept = 0.5;  // share of the reduction of the violation that the merit must be predicted to keep
  constexpr double smallest_length = 1e-8;
  const double violation = violations(program_, from.constraints).lpNorm<1>();
  const double objective_derivative = from.gradient.dot(step);
  if (violation > 0.0) {
    const double needed = (objective_derivative + 0.5 * std::max(0.0, curvature)) / ((1.0 - kept) * violation);
    weight_ = std::max(weight_ / 2, needed);
  }
  const double merit_derivative = objective_derivative - weight_ * violation;
  const double merit_before = merit(from);
  // Close to the solution, differences of the merit are rounding.
  const double rounding = 10.0 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(merit_before));
  const auto falls_enough = [&](const Linearisation& at, double step_length) {
    return at.has_finite_values() &&
           merit(at) <= merit_before + sufficient * step_length * std::min(merit_derivative, 0.0) + rounding;
  };

  constexpr double limit = 2.0;
  const auto allowed = limit * (1.0 + from.point.array().abs());
  const double first_length = step.size() > 0 ? std::min(1.0, (allowed / step.array().abs()).minCoeff()) : 1.0;
  double step_length = first_length;
  while (step_length > smallest_length) {
    Linearisation tried = values_at(program_, from.point + step_length * step);
    if (falls_enough(tried, step_length)) return {std::move(tried), step_length};
    if (step_length == first_length && tried.has_finite_values()) {
      Linearisation curved = corrected(from, tried);
      if (falls_enough(curved, step_length)) return {std::move(curved), step_length};
    }
    step_length *= 0.5;
  }
  return {from, 0.0};
}

Linearisation Globalisation::corrected(const Linearisation& from, const Linearisation& tried) {
  const Eigen::Index n = from.point.size();
  const Eigen::Index m = from.constraints.size();
  Eigen::VectorXd right_hand_side = Eigen::VectorXd::Zero(n + m);
  right_hand_side.tail(m) = -violations(program_, tried.constraints);
  std::vector<bool> counts = equalities_of(program_);
  for (Eigen::Index i = 0; i < m; ++i) {
    if (right_hand_side[n + i] != 0.0) counts[static_cast<std::size_t>(i)] = true;
  }
  const Eigen::SparseMatrix<double> no_curvature(n, n);
  const Eigen::SparseMatrix<double> matrix =
      kkt_matrix(no_curvature, 1.0, from.jacobian, free_variables(program_), counts);
  if (!factorisation_.factorise(matrix)) return tried;
  const Eigen::VectorXd correction = factorisation_.solve(std::move(right_hand_side)).head(n);
  return values_at(program_,
                   (tried.point + correction).cwiseMax(program_.variable_lower()).cwiseMin(program_.variable_upper()));
}

}  // namespace dmocbench::sqp
