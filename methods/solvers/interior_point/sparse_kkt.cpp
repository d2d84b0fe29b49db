#include "methods/solvers/interior_point/sparse_kkt.hpp"

#include "methods/runtime/long_vectors.hpp"
#include "methods/solvers/interior_point/dissection_order.hpp"
#include "methods/solvers/linearisation.hpp"

namespace dmocbench::interior_point {

SparseKkt::SparseKkt(const NonlinearProgram& program, Order order, Inertia inertia)
    : program_(program),
      inertia_(inertia),
      is_free_(free_variables(program)),
      factorisation_(order == Order::found ? std::vector<int>{} : dissection_order(program)) {}

Eigen::SparseMatrix<double> SparseKkt::lower_triangle(const KktMatrix& matrix) const {
  const auto n = static_cast<Eigen::Index>(program_.variable_count());
  const auto m = static_cast<Eigen::Index>(program_.constraint_count());
  const BlockPattern& hessian = program_.hessian_structure();
  const BlockPattern& jacobian = program_.jacobian_structure();
  const auto is_free = [&](int i) { return is_free_[static_cast<std::size_t>(i)]; };
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(hessian.size() + jacobian.size() + static_cast<std::size_t>(n + m));
  hessian.for_each([&](Eigen::Index e, int row, int column) {
    entries.emplace_back(row, column, is_free(row) && is_free(column) ? matrix.hessian[e] : 0.0);
  });
  jacobian.for_each([&](Eigen::Index e, int row, int column) {
    entries.emplace_back(static_cast<int>(n) + row, column, is_free(column) ? matrix.jacobian[e] : 0.0);
  });
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, is_free(i) ? matrix.diagonal[i] : 1.0);
  for (int i = 0; i < m; ++i) {
    entries.emplace_back(static_cast<int>(n) + i, static_cast<int>(n) + i, -matrix.compliance_of(i));
  }
  Eigen::SparseMatrix<double> lower(n + m, n + m);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

FactorisationStatus SparseKkt::solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                     const KktStep& step) {
  const auto& [slope, rows] = right_hand_side;
  const auto& [primal_step, multiplier_step] = step;
  if (!is_finite(matrix.hessian) || !is_finite(matrix.jacobian)) return FactorisationStatus::singular;
  if (!factorisation_.factorise(lower_triangle(matrix))) return FactorisationStatus::singular;
  const bool is_minimum = factorisation_.negative_eigenvalues() == rows.size();
  if (!is_minimum && inertia_ == Inertia::minimum) return FactorisationStatus::wrong_inertia;
  Eigen::VectorXd negated(slope.size() + rows.size());
  negated << -slope, -rows;
  for (Eigen::Index i = 0; i < slope.size(); ++i) {
    if (!is_free_[static_cast<std::size_t>(i)]) negated[i] = 0.0;
  }
  const Eigen::VectorXd solution = factorisation_.solve(std::move(negated));
  if (!solution.allFinite()) return FactorisationStatus::singular;
  primal_step = solution.head(slope.size());
  multiplier_step = solution.tail(rows.size());
  return FactorisationStatus::solved;
}

}  // namespace dmocbench::interior_point
