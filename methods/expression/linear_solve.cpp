#include "methods/expression/linear_solve.hpp"

#include "methods/error.hpp"

namespace dmocbench {

namespace {

void require_pivot(const Expression& pivot, const char* sentence) {
  if (pivot.is_zero()) throw Error(sentence);
}

}  // namespace

ExpressionVector solve_symmetric(const ExpressionMatrix& a, const ExpressionVector& b, const char* singular) {
  const Eigen::Index n = b.size();
  ExpressionMatrix lower(n, n);  // strictly lower part of L
  ExpressionVector pivots(n);
  ExpressionVector x = b;
  for (Eigen::Index j = 0; j < n; ++j) {
    pivots[j] = a(j, j);
    for (Eigen::Index k = 0; k < j; ++k) pivots[j] -= lower(j, k) * lower(j, k) * pivots[k];
    require_pivot(pivots[j], singular);
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

ExpressionVector solve_unsymmetric(const ExpressionMatrix& a, const ExpressionVector& b) {
  const Eigen::Index n = b.size();
  ExpressionMatrix upper = a;
  ExpressionVector x = b;
  for (Eigen::Index j = 0; j < n; ++j) {
    require_pivot(upper(j, j), "a system of linear equations has a pivot that is zero for all values");
    for (Eigen::Index i = j + 1; i < n; ++i) {
      const Expression factor = upper(i, j) / upper(j, j);
      for (Eigen::Index k = j + 1; k < n; ++k) upper(i, k) -= factor * upper(j, k);
      x[i] -= factor * x[j];
    }
  }
  for (Eigen::Index j = n - 1; j >= 0; --j) {
    for (Eigen::Index k = j + 1; k < n; ++k) x[j] -= upper(j, k) * x[k];
    x[j] /= upper(j, j);
  }
  return x;
}

}  // namespace dmocbench
