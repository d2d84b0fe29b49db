#include "methods/kkt/newton_residual.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "methods/kkt/linearisation.hpp"
#include "methods/runtime/long_vectors.hpp"

namespace dmocbench::kkt {

namespace {

/// A right-hand side that is nearly zero allows nothing; then this share of the largest terms, times the accuracy, is
/// allowed.
constexpr double share_of_terms = 1e-6;

double largest_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  if (a.size() == 0) return 0.0;
  std::array<double, most_parts> largest{};
  for_stretches(a.size(), [&](std::size_t s, Eigen::Index begin, Eigen::Index length) {
    largest[s] = a.segment(begin, length).cwiseProduct(b.segment(begin, length)).lpNorm<Eigen::Infinity>();
  });
  return *std::ranges::max_element(largest);
}

double ratio(double left, double allowed) { return left > 0.0 ? left / allowed : 0.0; }

}  // namespace

NewtonResidual::NewtonResidual(const NonlinearProgram& program)
    : diagonal_(MatrixProduct::diagonal(static_cast<Eigen::Index>(program.variable_count()))),
      hessian_(MatrixProduct::symmetric(program.hessian_structure())),
      jacobian_(MatrixProduct::plain(program.jacobian_structure())),
      transposed_jacobian_(MatrixProduct::transposed(program.jacobian_structure())),
      floors_(program.rounding_floors()),
      fixed_(fixed_variables(program)) {}

void NewtonResidual::compute(const KktMatrix& matrix, const KktRightHandSide& right_hand_side, const KktStep& step) {
  const Eigen::VectorXd& gradient = right_hand_side.gradient;
  largest_gradient_ = largest_of(gradient);
  largest_constraint_ = largest_of(right_hand_side.constraints);
  is_finite_ = set_to_sum_of_products(gradient_, gradient,
                                      {{diagonal_, matrix.diagonal, step.primal},
                                       {hessian_, matrix.hessian, step.primal},
                                       {transposed_jacobian_, matrix.jacobian, step.multipliers}});
  for (const Eigen::Index i : fixed_) gradient_[i] = 0.0;
  const MatrixTerm along{jacobian_, matrix.jacobian, step.primal};
  if (matrix.compliance.size() == 0) {
    is_finite_ = set_to_sum_of_products(constraints_, right_hand_side.constraints, {along}) && is_finite_;
    return;
  }
  resize_unwritten(constraints_, step.multipliers.size());
  for_stretches(constraints_.size(), [&](std::size_t, Eigen::Index begin, Eigen::Index length) {
    constraints_.segment(begin, length) =
        right_hand_side.constraints.segment(begin, length) -
        matrix.compliance.segment(begin, length).cwiseProduct(step.multipliers.segment(begin, length));
  });
  is_finite_ = set_to_sum_of_products(constraints_, constraints_, {along}) && is_finite_;
}

double NewtonResidual::excess(const KktMatrix& matrix, const KktStep& step, double accuracy) const {
  const double gradient = largest_of(gradient_);
  const double constraint = largest_of(constraints_);
  if (!is_finite_) return std::numeric_limits<double>::infinity();
  const double of_gradient = accuracy * largest_gradient_;
  const double of_constraint = accuracy * largest_constraint_;
  // The right-hand side usually allows more than is left; then the other limits need no pass over the matrix.
  if (gradient <= of_gradient && constraint <= of_constraint) {
    return std::max(ratio(gradient, of_gradient), ratio(constraint, of_constraint));
  }
  const double rounding = 20.0 * std::numeric_limits<double>::epsilon() + share_of_terms * accuracy;
  const double primal = largest_of(step.primal);
  const double multiplier = largest_of(step.multipliers);
  const double jacobian = largest_of(matrix.jacobian);
  const double allowed_gradient = floors_.largest * std::max(1.0, multiplier) + of_gradient +
                                  rounding * (largest_product(matrix.diagonal, step.primal) +
                                              largest_of(matrix.hessian) * primal + jacobian * multiplier);
  const double allowed_constraint =
      floors_.largest + of_constraint +
      rounding * (largest_product(matrix.compliance, step.multipliers) + jacobian * primal);
  return std::max(ratio(gradient, allowed_gradient), ratio(constraint, allowed_constraint));
}

}  // namespace dmocbench::kkt
