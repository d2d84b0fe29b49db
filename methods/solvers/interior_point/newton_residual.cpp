#include "methods/solvers/interior_point/newton_residual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmocbench::interior_point {

namespace {

double largest_of(const Eigen::VectorXd& vector) { return vector.size() > 0 ? vector.lpNorm<Eigen::Infinity>() : 0.0; }

}  // namespace

NewtonResidual::NewtonResidual(const NonlinearProgram& program)
    : hessian_runs_(cut_at_diagonal(pattern_runs(program.hessian_structure()))),
      jacobian_runs_(pattern_runs(program.jacobian_structure())) {
  for (Eigen::Index i = 0; i < program.variable_lower().size(); ++i) {
    if (program.variable_lower()[i] == program.variable_upper()[i]) fixed_.push_back(i);
  }
}

void NewtonResidual::compute(const KktMatrix& matrix, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                             const Eigen::VectorXd& primal_step, const Eigen::VectorXd& multiplier_step) {
  slope_ = matrix.diagonal.cwiseProduct(primal_step);
  const double from_diagonal = largest_of(slope_);
  slope_ += slope;
  add_symmetric_product(hessian_runs_, matrix.hessian, primal_step, slope_);
  add_transposed_product(jacobian_runs_, matrix.jacobian, multiplier_step, slope_);
  largest_slope_ = largest_of(slope);
  for (const Eigen::Index i : fixed_) slope_[i] = 0.0;
  rows_ = rows - matrix.softness.cwiseProduct(multiplier_step);
  const double from_softness = largest_of(rows_ - rows);
  add_product(jacobian_runs_, matrix.jacobian, primal_step, rows_);
  largest_row_ = largest_of(rows);
  constexpr double rounding = 20.0 * std::numeric_limits<double>::epsilon();
  const double step = largest_of(primal_step);
  const double jacobian = largest_of(matrix.jacobian);
  rounding_of_slope_ =
      rounding * (from_diagonal + largest_of(matrix.hessian) * step + jacobian * largest_of(multiplier_step));
  rounding_of_rows_ = rounding * (from_softness + jacobian * step);
}

double NewtonResidual::excess(double accuracy) const {
  const auto part = [accuracy](const Eigen::VectorXd& left, double right_hand_side, double rounding) {
    const double largest = largest_of(left);
    const double allowed = accuracy * right_hand_side + rounding;
    if (!std::isfinite(left.sum())) return std::numeric_limits<double>::infinity();
    return largest > 0.0 ? largest / allowed : 0.0;
  };
  return std::max(part(slope_, largest_slope_, rounding_of_slope_), part(rows_, largest_row_, rounding_of_rows_));
}

}  // namespace dmocbench::interior_point
