#include "methods/solvers/interior_point/newton_residual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "methods/runtime/long_vectors.hpp"
#include "methods/solvers/interior_point/bound_list.hpp"

namespace dmocbench::interior_point {

namespace {

/// Where the right-hand side is next to nothing, its share says nothing: then this share of the largest terms does.
constexpr double share_of_terms = 1e-6;

double largest_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() > 0 ? a.cwiseProduct(b).lpNorm<Eigen::Infinity>() : 0.0;
}

}  // namespace

NewtonResidual::NewtonResidual(const NonlinearProgram& program, const ProgramRuns& runs)
    : hessian_(MatrixProduct::symmetric(runs.hessian)),
      jacobian_(MatrixProduct::plain(runs.jacobian)),
      transposed_jacobian_(MatrixProduct::transposed(runs.jacobian)),
      floor_(program.rounding_floor()),
      fixed_(fixed_entries(program.variable_lower(), program.variable_upper())) {}

void NewtonResidual::compute(const KktMatrix& matrix, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                             const Eigen::VectorXd& primal_step, const Eigen::VectorXd& multiplier_step) {
  largest_slope_ = largest_of(slope);
  largest_row_ = largest_of(rows);
  resize_unwritten(slope_, slope.size());
  for_stretches(slope.size(), [&](std::size_t, Eigen::Index begin, Eigen::Index length) {
    slope_.segment(begin, length) =
        slope.segment(begin, length) +
        matrix.diagonal.segment(begin, length).cwiseProduct(primal_step.segment(begin, length));
  });
  hessian_.add(matrix.hessian, primal_step, slope_);
  transposed_jacobian_.add(matrix.jacobian, multiplier_step, slope_);
  for (const Eigen::Index i : fixed_) slope_[i] = 0.0;
  copy_to(rows_, rows);
  if (matrix.compliance.size() > 0) rows_ -= matrix.compliance.cwiseProduct(multiplier_step);
  jacobian_.add(matrix.jacobian, primal_step, rows_);
}

double NewtonResidual::excess(const KktMatrix& matrix, const Eigen::VectorXd& primal_step,
                              const Eigen::VectorXd& multiplier_step, double accuracy) const {
  const double slope = largest_of(slope_);
  const double row = largest_of(rows_);
  if (!is_finite(slope_) || !is_finite(rows_)) return std::numeric_limits<double>::infinity();
  // Usually the right-hand side allows more than is left, and the rest need not be computed.
  if (slope <= accuracy * largest_slope_ && row <= accuracy * largest_row_) {
    const double of_slope = slope > 0.0 ? slope / (accuracy * largest_slope_) : 0.0;
    const double of_row = row > 0.0 ? row / (accuracy * largest_row_) : 0.0;
    return std::max(of_slope, of_row);
  }
  const double rounding = 20.0 * std::numeric_limits<double>::epsilon() + share_of_terms * accuracy;
  const double step = largest_of(primal_step);
  const double jacobian = largest_of(matrix.jacobian);
  const double allowed_slope = floor_ * std::max(1.0, largest_of(multiplier_step)) + accuracy * largest_slope_ +
                               rounding * (largest_product(matrix.diagonal, primal_step) +
                                           largest_of(matrix.hessian) * step + jacobian * largest_of(multiplier_step));
  const double of_compliance = matrix.compliance.size() > 0 ? largest_product(matrix.compliance, multiplier_step) : 0.0;
  const double allowed_row = floor_ + accuracy * largest_row_ + rounding * (of_compliance + jacobian * step);
  return std::max(slope > 0.0 ? slope / allowed_slope : 0.0, row > 0.0 ? row / allowed_row : 0.0);
}

}  // namespace dmocbench::interior_point
