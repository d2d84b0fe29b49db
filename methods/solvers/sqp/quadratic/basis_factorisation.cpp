#include "methods/solvers/sqp/quadratic/basis_factorisation.hpp"

#include <cmath>
#include <ranges>

namespace dmocbench::sqp {

bool BasisFactorisation::factorise(const QuadraticProgram& program, const std::vector<Eigen::Index>& basics) {
  replacements_.clear();
  if (basics.empty()) return true;  // SparseLU divides by the size
  const Eigen::Index variables = program.variable_count();
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t position = 0; position < basics.size(); ++position) {
    const auto to = static_cast<int>(position);
    if (basics[position] >= variables) {
      entries.emplace_back(static_cast<int>(basics[position] - variables), to, -1.0);
      continue;
    }
    for (Eigen::SparseMatrix<double>::InnerIterator entry(program.rows, basics[position]); entry; ++entry) {
      entries.emplace_back(static_cast<int>(entry.row()), to, entry.value());
    }
  }
  Eigen::SparseMatrix<double> basis(program.row_count(), program.row_count());
  basis.setFromTriplets(entries.begin(), entries.end());
  basis.makeCompressed();
  factors_.compute(basis);
  if (factors_.info() != Eigen::Success) return false;
  // A basis that is singular up to rounding may still have factors; they do not give back a solution.
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(program.row_count());
  const Eigen::VectorXd product = basis * ones;
  constexpr double backward = 1e-3;
  return (factors_.solve(product) - ones).lpNorm<Eigen::Infinity>() < backward;
}

void BasisFactorisation::replace(Eigen::Index position, const Eigen::VectorXd& solved) {
  Replacement replacement{.position = position, .pivot = solved[position], .rows = {}, .values = {}};
  for (Eigen::Index i = 0; i < solved.size(); ++i) {
    if (i == position || solved[i] == 0.0) continue;
    replacement.rows.push_back(i);
    replacement.values.push_back(solved[i]);
  }
  replacements_.push_back(std::move(replacement));
}

Eigen::VectorXd BasisFactorisation::solve(const Eigen::VectorXd& y) const {
  if (y.size() == 0) return y;
  Eigen::VectorXd x = factors_.solve(y);
  for (const Replacement& replacement : replacements_) {
    const double value = x[replacement.position] / replacement.pivot;
    x[replacement.position] = value;
    for (std::size_t e = 0; e < replacement.rows.size(); ++e) x[replacement.rows[e]] -= replacement.values[e] * value;
  }
  return x;
}

Eigen::VectorXd BasisFactorisation::solve_transposed(const Eigen::VectorXd& y) const {
  if (y.size() == 0) return y;
  Eigen::VectorXd x = y;
  for (const Replacement& replacement : std::views::reverse(replacements_)) {
    double sum = x[replacement.position];
    for (std::size_t e = 0; e < replacement.rows.size(); ++e) sum -= replacement.values[e] * x[replacement.rows[e]];
    x[replacement.position] = sum / replacement.pivot;
  }
  return factors_.transpose().solve(x);
}

}  // namespace dmocbench::sqp
