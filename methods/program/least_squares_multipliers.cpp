#include "methods/program/least_squares_multipliers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/SparseCore>
#include <Eigen/SparseQR>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// Numbers the entries that are chosen 0, 1, ...; the others get -1.
struct Selection {
  std::vector<int> number;
  int count = 0;
  void append(bool chosen) { number.push_back(chosen ? count++ : -1); }
};

bool is_at(double value, double bound) {
  return std::isfinite(bound) && std::abs(value - bound) <= activity_tolerance * std::max(1.0, std::abs(bound));
}

bool is_outside_or_at(double value, double lower, double upper) {
  return is_at(value, lower) || is_at(value, upper) || value < lower || value > upper;
}

Selection interior_variables(const NonlinearProgram& program, const Eigen::VectorXd& primal) {
  Selection selection;
  for (Eigen::Index i = 0; i < primal.size(); ++i) {
    selection.append(!is_outside_or_at(primal[i], program.variable_lower()[i], program.variable_upper()[i]));
  }
  return selection;
}

Selection active_rows(const NonlinearProgram& program, const Eigen::VectorXd& rows) {
  Selection selection;
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const double lower = program.constraint_lower()[i];
    const double upper = program.constraint_upper()[i];
    selection.append(lower == upper || is_outside_or_at(rows[i], lower, upper));
  }
  return selection;
}

/// (∂a/∂ξ)ᵀ of the chosen rows and variables.
Eigen::SparseMatrix<double> transposed(const BlockPattern& pattern, const Eigen::VectorXd& values,
                                       const Selection& rows, const Selection& variables) {
  std::vector<Eigen::Triplet<double>> entries;
  pattern.for_each([&](Eigen::Index e, int i, int j) {
    const int row = rows.number[static_cast<std::size_t>(i)];
    const int variable = variables.number[static_cast<std::size_t>(j)];
    if (row >= 0 && variable >= 0) entries.emplace_back(variable, row, values[e]);
  });
  // Eigen's sparse QR wants at least as many rows as columns; rows of zeros change no least-squares solution.
  Eigen::SparseMatrix<double> matrix(std::max(variables.count, rows.count), rows.count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  matrix.makeCompressed();
  return matrix;
}

}  // namespace

Eigen::VectorXd least_squares_multipliers(NonlinearProgram& program, const Eigen::VectorXd& primal) {
  if (static_cast<std::size_t>(primal.size()) != program.variable_count()) {
    throw Error("multipliers are estimated at a point of " + std::to_string(program.variable_count()) +
                " variables, got " + std::to_string(primal.size()));
  }
  const auto row_count = static_cast<Eigen::Index>(program.constraint_count());
  const BlockPattern& pattern = program.jacobian_structure();
  Eigen::VectorXd gradient(primal.size());
  Eigen::VectorXd values(row_count);
  Eigen::VectorXd jacobian(static_cast<Eigen::Index>(pattern.size()));
  program.gradient(primal, gradient);
  program.constraints(primal, values);
  program.jacobian(primal, jacobian);
  if (!primal.allFinite() || !gradient.allFinite() || !values.allFinite() || !jacobian.allFinite()) {
    return Eigen::VectorXd::Constant(row_count, std::numeric_limits<double>::quiet_NaN());
  }

  const Selection variables = interior_variables(program, primal);
  const Selection rows = active_rows(program, values);
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(row_count);
  if (rows.count == 0 || variables.count == 0) return multipliers;

  const Eigen::SparseMatrix<double> matrix = transposed(pattern, jacobian, rows, variables);
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(matrix.rows());
  for (std::size_t i = 0; i < variables.number.size(); ++i) {
    if (variables.number[i] >= 0) slope[variables.number[i]] = gradient[static_cast<Eigen::Index>(i)];
  }
  const Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> factorization(matrix);
  const Eigen::VectorXd chosen = factorization.solve(-slope);
  for (std::size_t i = 0; i < rows.number.size(); ++i) {
    if (rows.number[i] >= 0) multipliers[static_cast<Eigen::Index>(i)] = chosen[rows.number[i]];
  }
  return multipliers;
}

}  // namespace dmocbench
