#include "methods/kkt/linearisation.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "methods/runtime/long_vectors.hpp"

namespace dmocbench {

namespace {

Eigen::SparseMatrix<double> matrix_of(const BlockPattern& pattern, const Eigen::VectorXd& values, Eigen::Index rows,
                                      Eigen::Index columns) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(pattern.size());
  pattern.for_each([&](Eigen::Index e, int row, int column) { entries.emplace_back(row, column, values[e]); });
  Eigen::SparseMatrix<double> matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<bool> where_bounds_are(bool equal, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  std::vector<bool> result;
  result.reserve(static_cast<std::size_t>(lower.size()));
  for (Eigen::Index i = 0; i < lower.size(); ++i) result.push_back((lower[i] == upper[i]) == equal);
  return result;
}

/// The entries whose two bounds are equal, or those whose bounds are not. They are few, and the rest is skipped many at
/// a time.
std::vector<Eigen::Index> where_bounds_agree(bool equal, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  constexpr Eigen::Index at_once = 64;
  std::array<std::vector<Eigen::Index>, most_parts> found;
  for_stretches(lower.size(), [&](std::size_t s, Eigen::Index first, Eigen::Index length) {
    for (Eigen::Index begin = first; begin < first + length; begin += at_once) {
      const Eigen::Index count = std::min(at_once, first + length - begin);
      const Eigen::Index equal_ones =
          (lower.segment(begin, count).array() == upper.segment(begin, count).array()).count();
      if (equal_ones == (equal ? 0 : count)) continue;
      for (Eigen::Index i = begin; i < begin + count; ++i) {
        if ((lower[i] == upper[i]) == equal) found[s].push_back(i);
      }
    }
  });
  std::vector<Eigen::Index> all = std::move(found[0]);
  for (std::size_t s = 1; s < found.size(); ++s) all.insert(all.end(), found[s].begin(), found[s].end());
  return all;
}

}  // namespace

std::vector<bool> free_variables(const NonlinearProgram& program) {
  return where_bounds_are(false, program.variable_lower(), program.variable_upper());
}

std::vector<Eigen::Index> fixed_variables(const NonlinearProgram& program) {
  return where_bounds_agree(true, program.variable_lower(), program.variable_upper());
}

std::vector<Eigen::Index> inequalities_of(const NonlinearProgram& program) {
  return where_bounds_agree(false, program.constraint_lower(), program.constraint_upper());
}

std::vector<bool> equalities_of(const NonlinearProgram& program) {
  return where_bounds_are(true, program.constraint_lower(), program.constraint_upper());
}

Linearisation values_at(NonlinearProgram& program, const Eigen::VectorXd& point) {
  Linearisation result;
  result.point = point;
  result.constraints.resize(static_cast<Eigen::Index>(program.constraint_count()));
  result.objective = program.objective(point);
  program.constraints(point, result.constraints);
  return result;
}

void differentiate(NonlinearProgram& program, Linearisation& at) {
  at.gradient.resize(at.point.size());
  Eigen::VectorXd values(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  program.gradient(at.point, at.gradient);
  program.jacobian(at.point, values);
  at.jacobian = matrix_of(program.jacobian_structure(), values, at.constraints.size(), at.point.size());
}

Eigen::SparseMatrix<double> hessian_at(NonlinearProgram& program, const Eigen::VectorXd& point,
                                       const Eigen::VectorXd& multipliers) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(program.hessian_structure().size()));
  program.hessian(point, 1.0, multipliers, values);
  return matrix_of(program.hessian_structure(), values, point.size(), point.size());
}

Eigen::VectorXd violations(const NonlinearProgram& program, const Eigen::VectorXd& constraints) {
  const Eigen::VectorXd above = (constraints - program.constraint_upper()).cwiseMax(0.0);
  const Eigen::VectorXd below = (program.constraint_lower() - constraints).cwiseMax(0.0);
  return above - below;
}

Eigen::SparseMatrix<double> kkt_matrix(const Eigen::SparseMatrix<double>& hessian, double shift,
                                       const Eigen::SparseMatrix<double>& jacobian, const std::vector<bool>& free,
                                       const std::vector<bool>& counts) {
  const Eigen::Index n = jacobian.cols();
  const Eigen::Index m = jacobian.rows();
  const auto is_in = [](const std::vector<bool>& set, Eigen::Index i) {
    return bool{set[static_cast<std::size_t>(i)]};
  };
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Eigen::Index i, Eigen::Index j, double value) {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    add(j, j, is_in(free, j) ? shift : 1.0);
    for (Eigen::SparseMatrix<double>::InnerIterator entry(hessian, j); entry; ++entry) {
      add(entry.row(), j, is_in(free, j) && is_in(free, entry.row()) ? entry.value() : 0.0);
    }
    for (Eigen::SparseMatrix<double>::InnerIterator entry(jacobian, j); entry; ++entry) {
      add(n + entry.row(), j, is_in(free, j) && is_in(counts, entry.row()) ? entry.value() : 0.0);
    }
  }
  for (Eigen::Index i = 0; i < m; ++i) add(n + i, n + i, is_in(counts, i) ? 0.0 : -1.0);
  Eigen::SparseMatrix<double> matrix(n + m, n + m);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace dmocbench
