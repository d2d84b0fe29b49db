#include "methods/expression/vectors.hpp"

#include "methods/error.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench::detail {

void require_factors(Eigen::Index rows, Eigen::Index columns, Eigen::Index other_rows, Eigen::Index other_columns) {
  if (columns == other_rows) return;
  throw Error(
      "cannot multiply a {} x {} matrix by a {} x {} matrix: the number of columns of the left factor must "
      "equal the number of rows of the right factor",
      rows, columns, other_rows, other_columns);
}

void throw_no_entry(char name, Eigen::Index entry, Eigen::Index size) {
  if (size == 0) throw Error("a formula reads {}[{}], but {} has no entries", name, entry, name);
  throw Error("a formula reads {}[{}], but {} has {}, the last of which is {}[{}]", name, entry, name,
              counted(size, "entry", "entries"), name, size - 1);
}

}  // namespace dmocbench::detail

namespace dmocbench {

ExpressionVector stacked(const std::vector<ExpressionVector>& parts) {
  Eigen::Index size = 0;
  for (const ExpressionVector& part : parts) size += part.size();
  ExpressionVector all(size);
  Eigen::Index next = 0;
  for (const ExpressionVector& part : parts) {
    all.segment(next, part.size()) = part;
    next += part.size();
  }
  return all;
}

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
