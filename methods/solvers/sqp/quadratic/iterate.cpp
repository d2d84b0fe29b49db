#include "methods/solvers/sqp/quadratic/iterate.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace dmocbench::sqp {

QuadraticIterate::QuadraticIterate(const QuadraticProgram& program, WorkingSet sets, double tolerance)
    : program_(&program),
      sets_(std::move(sets)),
      tolerance_(tolerance),
      lower_(program.lower),
      upper_(program.upper),
      values_(Eigen::VectorXd::Zero(program.column_count()).cwiseMax(lower_).cwiseMin(upper_)) {
  refactorise();
}

double QuadraticIterate::infeasibility() const {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < values_.size(); ++j) {
    const double distance = std::max(lower_[j] - values_[j], values_[j] - upper_[j]);
    if (distance > tolerance_) sum += distance;
  }
  return sum;
}

double QuadraticIterate::objective() const {
  const Eigen::VectorXd d = variables();
  const Eigen::VectorXd curved = program_->hessian_times(d);
  return program_->gradient.dot(d) + 0.5 * d.dot(curved);
}

Eigen::VectorXd QuadraticIterate::null_space_times(const Eigen::VectorXd& of_superbasics) const {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(program_->column_count());
  change(sets_.superbasics()) = of_superbasics;
  change(sets_.basics()) = -basis_.solve(program_->columns * change);
  return change;
}

Eigen::VectorXd QuadraticIterate::null_space_transposed_times(const Eigen::VectorXd& of_variables) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(program_->column_count());
  all.head(program_->variable_count()) = of_variables;
  const Eigen::VectorXd multipliers = basis_.solve_transposed(all(sets_.basics()));
  return (all - program_->transposed_times(multipliers))(sets_.superbasics());
}

Eigen::MatrixXd QuadraticIterate::reduced_hessian() const {
  const std::vector<Eigen::Index>& superbasics = sets_.superbasics();
  if (superbasics.empty()) return {};  // Eigen's triangular product looks at its first entry
  const Eigen::Index n = program_->variable_count();
  Eigen::MatrixXd directions =
      Eigen::MatrixXd::Zero(program_->column_count(), static_cast<Eigen::Index>(superbasics.size()));
  for (std::size_t place = 0; place < superbasics.size(); ++place) {
    auto direction = directions.col(static_cast<Eigen::Index>(place));
    direction(sets_.basics()) = -basis_.solve(program_->column(superbasics[place]));
    direction[superbasics[place]] = 1.0;
  }
  const Eigen::MatrixXd of_variables = directions.topRows(n);
  const Eigen::MatrixXd curved = program_->hessian_times(of_variables);
  Eigen::MatrixXd result(directions.cols(), directions.cols());
  result.triangularView<Eigen::Lower>() = of_variables.transpose() * curved;
  result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
  return result;
}

void QuadraticIterate::replace_basic(Eigen::Index position, Eigen::Index entering, const Eigen::VectorXd& solved) {
  sets_.replace_basic(position, entering);
  basis_.replace(position, solved);
  if (basis_.needs_refactorisation()) refactorise();
}

void QuadraticIterate::choose_basis_again() {
  BasisChoice choice = choose_basis(*program_, sets_.basics(), sets_.superbasics());
  sets_ = WorkingSet(program_->column_count(), std::move(choice.basics), std::move(choice.others));
  refactorise();
}

void QuadraticIterate::accept_violations() {
  lower_ = lower_.cwiseMin(values_);
  upper_ = upper_.cwiseMax(values_);
}

void QuadraticIterate::refactorise() {
  if (!basis_.factorise(*program_, sets_.basics())) throw Breakdown("the basis is singular");
  Eigen::VectorXd others = values_;
  others(sets_.basics()).setZero();
  values_(sets_.basics()) = -basis_.solve(program_->columns * others);
}

}  // namespace dmocbench::sqp
