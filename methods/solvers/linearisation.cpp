#include "methods/solvers/linearisation.hpp"

#include <chrono>
#include <cstddef>
#include <vector>

namespace dmocbench {

namespace {

Eigen::SparseMatrix<double> matrix_of(const SparsityPattern& pattern, const Eigen::VectorXd& values, Eigen::Index rows,
                                      Eigen::Index columns) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(pattern.size());
  for (std::size_t e = 0; e < pattern.size(); ++e) {
    entries.emplace_back(pattern.rows[e], pattern.columns[e], values[static_cast<Eigen::Index>(e)]);
  }
  Eigen::SparseMatrix<double> matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<bool> where_bounds_are(bool equal, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  std::vector<bool> result;
  for (Eigen::Index i = 0; i < lower.size(); ++i) result.push_back((lower[i] == upper[i]) == equal);
  return result;
}

}  // namespace

std::vector<bool> free_variables(const NonlinearProgram& program) {
  return where_bounds_are(false, program.variable_lower(), program.variable_upper());
}

std::vector<bool> equality_rows(const NonlinearProgram& program) {
  return where_bounds_are(true, program.constraint_lower(), program.constraint_upper());
}

template <class Evaluation>
void Evaluator::timed(const Evaluation& evaluation) {
  const auto start = std::chrono::steady_clock::now();
  evaluation();
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ++count_;
}

Linearisation Evaluator::values_at(const Eigen::VectorXd& point) {
  Linearisation result;
  result.point = point;
  result.constraints.resize(static_cast<Eigen::Index>(program_.constraint_count()));
  timed([&] { result.objective = program_.objective(point); });
  timed([&] { program_.constraints(point, result.constraints); });
  return result;
}

void Evaluator::differentiate(Linearisation& at) {
  at.gradient.resize(at.point.size());
  Eigen::VectorXd values(static_cast<Eigen::Index>(program_.jacobian_structure().size()));
  timed([&] { program_.gradient(at.point, at.gradient); });
  timed([&] { program_.jacobian(at.point, values); });
  at.jacobian = matrix_of(program_.jacobian_structure(), values, at.constraints.size(), at.point.size());
}

Eigen::SparseMatrix<double> Evaluator::hessian_at(const Eigen::VectorXd& point, const Eigen::VectorXd& multipliers) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(program_.hessian_structure().size()));
  timed([&] { program_.hessian(point, 1.0, multipliers, values); });
  return matrix_of(program_.hessian_structure(), values, point.size(), point.size());
}

Eigen::VectorXd Evaluator::violations(const Eigen::VectorXd& constraints) const {
  const Eigen::VectorXd above = (constraints - program_.constraint_upper()).cwiseMax(0.0);
  const Eigen::VectorXd below = (program_.constraint_lower() - constraints).cwiseMax(0.0);
  return above - below;
}

double Evaluator::violation(const Eigen::VectorXd& constraints) const {
  return constraints.size() > 0 ? violations(constraints).lpNorm<Eigen::Infinity>() : 0.0;
}

}  // namespace dmocbench
