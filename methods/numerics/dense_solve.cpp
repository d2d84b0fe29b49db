#include "methods/numerics/dense_solve.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace dmocbench {

template <class Scalar, int columns>
Eigen::Matrix<Scalar, Eigen::Dynamic, columns> solve_square(
    const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& a,
    const Eigen::Matrix<Scalar, Eigen::Dynamic, columns>& b) {
  return a.partialPivLu().solve(b);
}

template Eigen::MatrixX<double> solve_square(const Eigen::MatrixX<double>&, const Eigen::MatrixX<double>&);
template Eigen::VectorX<double> solve_square(const Eigen::MatrixX<double>&, const Eigen::VectorX<double>&);
template Eigen::MatrixX<long double> solve_square(const Eigen::MatrixX<long double>&,
                                                  const Eigen::MatrixX<long double>&);
template Eigen::VectorX<long double> solve_square(const Eigen::MatrixX<long double>&,
                                                  const Eigen::VectorX<long double>&);

namespace {

template <class Matrix>
std::optional<Eigen::VectorXd> solve_if_invertible_as(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const Eigen::FullPivLU<Matrix> factors(a);
  if (!factors.isInvertible()) return std::nullopt;
  return factors.solve(b);
}

}  // namespace

std::optional<Eigen::VectorXd> solve_if_invertible(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  constexpr int few = 8;  // with this bound nothing comes from the heap, which would take longer than the arithmetic
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, few, few>;
  return a.rows() <= few ? solve_if_invertible_as<Small>(a, b) : solve_if_invertible_as<Eigen::MatrixXd>(a, b);
}

bool is_invertible(const Eigen::MatrixXd& a) { return a.fullPivLu().isInvertible(); }

std::optional<Eigen::VectorXd> solve_if_positive_definite(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const Eigen::LLT<Eigen::MatrixXd> factors(a);
  if (factors.info() != Eigen::Success) return std::nullopt;
  return factors.solve(b);
}

bool is_positive_definite(const Eigen::MatrixXd& a) { return a.llt().info() == Eigen::Success; }

}  // namespace dmocbench
