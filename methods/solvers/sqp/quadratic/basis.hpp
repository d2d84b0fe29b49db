#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseLU>

#include "methods/solvers/sqp/quadratic/quadratic_program.hpp"

namespace dmocbench::sqp {

/// Sparse LU factors of the basis matrix B, kept up to date in product form while columns are exchanged.
class BasisFactorisation {
 public:
  /// Factorises the columns `basics` of (A, -I) afresh. False if they are singular.
  [[nodiscard]] bool factorise(const QuadraticProgram& program, const std::vector<Eigen::Index>& basics);

  /// The column at `position` of B becomes the one with `solved` = B⁻¹ (new column); solved[position] must not be 0.
  void replace(Eigen::Index position, const Eigen::VectorXd& solved);

  /// True if enough columns have been replaced that new factors are cheaper and more accurate.
  [[nodiscard]] bool needs_refactorisation() const noexcept { return replacements_.size() >= most_replacements; }

  /// B⁻¹ y.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& y) const;
  /// B⁻ᵀ y.
  [[nodiscard]] Eigen::VectorXd solve_transposed(const Eigen::VectorXd& y) const;

 private:
  static constexpr std::size_t most_replacements = 50;

  /// B_new = B E with E the identity except for one column.
  struct Replacement {
    Eigen::Index position = 0;
    double pivot = 1.0;
    std::vector<Eigen::Index> rows = {};  // without the pivot's
    std::vector<double> values = {};
  };

  // Mutable because Eigen's view of the transposed factors is not const; it changes nothing.
  mutable Eigen::SparseLU<Eigen::SparseMatrix<double>> factors_;
  std::vector<Replacement> replacements_;
};

/// A basis chosen among many columns, with the others expressed in it.
struct BasisChoice {
  std::vector<Eigen::Index> basics;  ///< by position
  std::vector<Eigen::Index> others;
  Eigen::MatrixXd table = {};  ///< B⁻¹ (columns `others`): m x others
};

/// Starts from `basics` and exchanges them for `others` until no entry of the table exceeds a small bound. Then
/// Z = (-table; I) is well conditioned for any first basis: a rank-revealing factorisation of both lists
/// together. Where `basics` are singular it starts from the slack basis; a slack that cannot be replaced stays. The
/// exchanges are not minor iterations, since no point moves.
[[nodiscard]] BasisChoice choose_basis(const QuadraticProgram& program, std::vector<Eigen::Index> basics,
                                       std::vector<Eigen::Index> others);

/// The same from the slack basis and all columns that may move: a basis for free ("crash").
[[nodiscard]] BasisChoice crash_basis(const QuadraticProgram& program);

}  // namespace dmocbench::sqp
