#include "methods/expression/linear_solve.hpp"

#include "methods/error.hpp"

namespace dmocbench {

ExpressionVector solve_symmetric(const ExpressionMatrix& a, const ExpressionVector& b, const char* singular) {
  const Eigen::Index n = b.size();
  ExpressionMatrix lower(n, n);  // strictly lower part of L
  ExpressionVector pivots(n);
  ExpressionVector x = b;
  for (Eigen::Index j = 0; j < n; ++j) {
    pivots[j] = a(j, j);
    for (Eigen::Index k = 0; k < j; ++k) pivots[j] -= lower(j, k) * lower(j, k) * pivots[k];
    if (pivots[j].is_zero()) throw Error(singular);
    for (Eigen::Index i = j + 1; i < n; ++i) {
      lower(i, j) = a(i, j);
      for (Eigen::Index k = 0; k < j; ++k) lower(i, j) -= lower(i, k) * lower(j, k) * pivots[k];
      lower(i, j) /= pivots[j];
      x[i] -= lower(i, j) * x[j];
    }
  }
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    x[j] /= pivots[j];
    for (Eigen::Index i = j + 1; i < n; ++i) x[j] -= lower(i, j) * x[i];
  }
  return x;
}

}  // namespace dmocbench
