#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// Rows of a program in the form of solvers that know c(x) = 0 or c(x) <= 0 only, with a dense Jacobian over the free
/// variables. A row with two bounds that differ stands twice, with no bound not at all.
class OneSidedRows {
 public:
  enum class Kind { equalities, inequalities };

  /// `numbers`: of each variable its number among the free ones, -1 of a fixed one.
  OneSidedRows(const NonlinearProgram& program, Kind kind, const std::vector<Eigen::Index>& numbers,
               std::size_t free_count);

  [[nodiscard]] std::size_t size() const noexcept { return sides_.size(); }
  [[nodiscard]] bool empty() const noexcept { return sides_.empty(); }

  /// c, size() entries, from the program's rows a.
  void values(const Eigen::VectorXd& rows, double* result) const;
  /// ∂c/∂x row by row, size() × free_count entries, from the values of the program's jacobian_structure().
  void jacobian(const Eigen::VectorXd& nonzeros, double* result) const;

 private:
  /// c = sign · (a - bound).
  struct Side {
    Eigen::Index row;
    double sign;
    double bound;
  };
  struct Entry {
    Eigen::Index nonzero;
    std::size_t position;
    double sign;
  };
  std::size_t free_count_;
  std::vector<Side> sides_;
  std::vector<Entry> entries_;
};

}  // namespace dmocbench
