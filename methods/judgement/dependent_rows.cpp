#include "methods/judgement/dependent_rows.hpp"

#include <algorithm>
#include <cmath>

#include "methods/kkt/linearisation.hpp"
#include "methods/kkt/symmetric_factorisation.hpp"

namespace dmocbench {

namespace {

/// The equalities, and the inequalities that are at a bound.
std::vector<bool> held_rows(const NonlinearProgram& program, const Eigen::VectorXd& constraints) {
  std::vector<bool> held = equalities_of(program);
  for (const Eigen::Index i : inequalities_of(program)) {
    held[static_cast<std::size_t>(i)] = is_held(constraints[i], program.constraint_lower()[i]) ||
                                        is_held(constraints[i], program.constraint_upper()[i]);
  }
  return held;
}

/// The Jacobian of the held rows by the free variables, each row of length 1, or 0 if its derivatives vanish.
Eigen::SparseMatrix<double> normalised(const Eigen::SparseMatrix<double>& jacobian, const std::vector<bool>& held,
                                       const std::vector<bool>& is_free) {
  Eigen::SparseMatrix<double> result = jacobian;
  result.prune([&](Eigen::Index row, Eigen::Index column, double value) {
    return held[static_cast<std::size_t>(row)] && is_free[static_cast<std::size_t>(column)] && value != 0.0;
  });
  const Eigen::VectorXd lengths = (result.cwiseProduct(result) * Eigen::VectorXd::Ones(result.cols())).cwiseSqrt();
  return lengths.unaryExpr([](double length) { return length > 0.0 ? 1.0 / length : 0.0; }).asDiagonal() * result;
}

}  // namespace

bool is_held(double value, double bound) {
  constexpr double near = 1e-6;
  return std::isfinite(bound) && std::abs(value - bound) <= near * std::max(1.0, std::abs(bound));
}

std::vector<std::size_t> dependent_rows(NonlinearProgram& program, const Eigen::VectorXd& point) {
  constexpr double shift = 1e-13;
  constexpr double rounding = 1e-8;
  constexpr double small_share = 0.1;
  Linearisation at = values_at(program, point);
  differentiate(program, at);
  if (!at.has_finite_values() || !at.jacobian.coeffs().allFinite()) return {};
  const std::vector<bool> is_free = free_variables(program);
  const std::vector<bool> held = held_rows(program, at.constraints);
  const Eigen::SparseMatrix<double> rows = normalised(at.jacobian, held, is_free);

  const Eigen::Index n = rows.cols();
  const Eigen::Index m = rows.rows();
  Eigen::SparseMatrix<double> matrix = kkt_matrix(Eigen::SparseMatrix<double>(n, n), 1.0, rows, is_free, held);
  for (Eigen::Index i = 0; i < m; ++i) {
    if (held[static_cast<std::size_t>(i)]) matrix.coeffRef(n + i, n + i) -= shift;
  }
  SymmetricFactorisation factorisation;
  if (!factorisation.factorise(matrix)) return {};
  // (J Jᵀ + shift)⁻¹ y of unit length: it enlarges the part of y without a gradient most.
  const auto enlarge = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
    Eigen::VectorXd right_hand_side = Eigen::VectorXd::Zero(n + m);
    right_hand_side.tail(m) = y;
    return factorisation.solve(std::move(right_hand_side)).tail(m).normalized();
  };
  Eigen::VectorXd y(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    y[i] = held[static_cast<std::size_t>(i)] ? std::cos(static_cast<double>(i) + 1.0) : 0.0;  // any numbers
  }
  y = enlarge(enlarge(y));
  Eigen::Index first = 0;
  y.cwiseAbs().maxCoeff(&first);
  // Among several dependencies, the shortest one with this row.
  y = enlarge(Eigen::VectorXd::Unit(m, first));
  if (!((rows.transpose() * y).norm() <= rounding)) return {};
  std::vector<std::size_t> dependent;
  const double most = y.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < m; ++i) {
    if (std::abs(y[i]) >= small_share * most) dependent.push_back(static_cast<std::size_t>(i));
  }
  std::ranges::stable_sort(dependent, std::ranges::greater{},
                           [&](std::size_t i) { return std::abs(y[static_cast<Eigen::Index>(i)]); });
  return dependent;
}

}  // namespace dmocbench
