#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// Constraints of a program as c(x) = 0 or c(x) <= 0, for solvers that take no others. A constraint with two different
/// bounds appears twice, one without a bound not at all.
class OneSidedConstraints {
 public:
  enum class Kind { equalities, inequalities };
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  OneSidedConstraints(const NonlinearProgram& program, Kind kind) {
    for (Eigen::Index i = 0; i < program.constraint_lower().size(); ++i) {
      const double lower = program.constraint_lower()[i];
      const double upper = program.constraint_upper()[i];
      if ((lower == upper) != (kind == Kind::equalities)) continue;
      if (std::isfinite(upper)) sides_.push_back({i, 1.0, upper});
      if (std::isfinite(lower) && kind == Kind::inequalities) sides_.push_back({i, -1.0, lower});
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return sides_.size(); }

  /// c, size() entries, from the program's constraints a.
  void values(const Eigen::VectorXd& constraints, double* result) const {
    for (const Side& side : sides_) *result++ = side.sign * (constraints[side.index] - side.bound);
  }
  /// ∂c/∂x row by row, size() rows, from the dense ∂a/∂x.
  void jacobian(const RowMajor& jacobian, double* result) const {
    for (const Side& side : sides_) {
      Eigen::Map<Eigen::RowVectorXd>(result, jacobian.cols()) = side.sign * jacobian.row(side.index);
      result += jacobian.cols();
    }
  }

 private:
  /// c = sign · (a - bound).
  struct Side {
    Eigen::Index index;
    double sign;
    double bound;
  };
  std::vector<Side> sides_;
};

}  // namespace dmocbench
