#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/solvers/sqp/quadratic/quadratic_program.hpp"

namespace dmocbench::sqp {

/// A basis chosen among many columns, with the others expressed in it.
struct BasisChoice {
  std::vector<Eigen::Index> basics;  ///< by position
  std::vector<Eigen::Index> others;
  Eigen::MatrixXd table;  ///< B⁻¹ (columns `others`): m x others
};

/// Starts from `basics` and exchanges them for `others` until no entry of the table is larger than a small bound: then
/// Z = (-table; I) is well conditioned, whatever the basis was before (a rank-revealing factorisation of both lists
/// together). Where `basics` are singular, the start is the slack basis; a slack that cannot be replaced stays. Not
/// counted as minor iterations: no point moves.
[[nodiscard]] BasisChoice choose_basis(const QuadraticProgram& program, std::vector<Eigen::Index> basics,
                                       std::vector<Eigen::Index> others);

/// The same from the slack basis and all columns that may move: a basis for free ("crash").
[[nodiscard]] BasisChoice crash_basis(const QuadraticProgram& program);

}  // namespace dmocbench::sqp
