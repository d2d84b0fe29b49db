#include "methods/kkt/matrix_product.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "methods/runtime/long_vectors.hpp"

namespace dmocbench::kkt {

namespace {

/// Entries of the result that stay in the first cache.
constexpr Eigen::Index at_once = 512;

PatternRun transpose_of(const PatternRun& run) {
  return {run.entry, run.column, run.row, run.column_step, run.row_step, run.length};
}

/// Adds the product of a run to the entries `begin` .. `end` - 1 of the result.
void add_part(const PatternRun& run, Eigen::Index begin, Eigen::Index end, const Eigen::VectorXd& values,
              const Eigen::VectorXd& vector, Eigen::VectorXd& result) {
  const Eigen::Index first = std::max(begin, run.row);
  const Eigen::Index length = std::min(end, run.row + run.length) - first;
  if (length <= 0) return;
  const Eigen::Index skipped = first - run.row;
  double* const sum = result.data() + first;
  const double* const entries = values.data() + run.entry + skipped;
  if (run.column_step == 0) {
    vector_loops().set_to_sum(sum, sum, vector[run.column], entries, length);
  } else {
    vector_loops().add_products(sum, entries, vector.data() + run.column + skipped, length);
  }
}

double sum_of_run(const PatternRun& run, const Eigen::VectorXd& values, const Eigen::VectorXd& vector) {
  const auto entries = values.segment(run.entry, run.length);
  if (run.column_step == 0) return entries.sum() * vector[run.column];
  return sum_of_stretches(run.length, [&](Eigen::Index begin, Eigen::Index length) {
    return vector_loops().dot(entries.data() + begin, vector.data() + run.column + begin, length);
  });
}

}  // namespace

MatrixProduct::MatrixProduct(const std::vector<PatternRun>& terms) {
  for (const PatternRun& run : terms) (run.row_step == 1 ? along_ : into_).push_back(run);
}

MatrixProduct MatrixProduct::transposed(const BlockPattern& jacobian) {
  std::vector<PatternRun> terms;
  std::ranges::transform(jacobian.runs(), std::back_inserter(terms), transpose_of);
  return MatrixProduct(terms);
}

MatrixProduct MatrixProduct::symmetric(const BlockPattern& lower_triangle) {
  std::vector<PatternRun> terms;
  for (const PatternRun& run : lower_triangle.runs()) {
    terms.push_back(run);
    const bool is_on_diagonal = run.row == run.column;
    if (!is_on_diagonal) terms.push_back(transpose_of(run));
  }
  return MatrixProduct(terms);
}

MatrixProduct MatrixProduct::diagonal(Eigen::Index size) {
  return MatrixProduct({{.row_step = 1, .column_step = 1, .length = size}});
}

bool set_to_sum_of_products(Eigen::VectorXd& result, const Eigen::VectorXd& start,
                            std::initializer_list<MatrixTerm> terms) {
  resize_unwritten(result, start.size());
  const double zeros = sum_of_stretches(result.size(), [&](Eigen::Index begin, Eigen::Index length) {
    double zeros_of_stretch = 0.0;
    for (Eigen::Index from = begin; from < begin + length; from += at_once) {
      const Eigen::Index to = std::min(from + at_once, begin + length);
      if (&start != &result) std::copy_n(start.data() + from, to - from, result.data() + from);
      for (const MatrixTerm& term : terms) {
        for (const PatternRun& run : term.matrix.along_) add_part(run, from, to, term.values, term.vector, result);
      }
      zeros_of_stretch += vector_loops().sum_of_zeros(result.data() + from, to - from);
    }
    return zeros_of_stretch;
  });
  bool is_finite = zeros == 0.0;
  for (const MatrixTerm& term : terms) {
    for (const PatternRun& run : term.matrix.into_) {
      result[run.row] += sum_of_run(run, term.values, term.vector);
      is_finite = is_finite && std::isfinite(result[run.row]);
    }
  }
  return is_finite;
}

}  // namespace dmocbench::kkt
