#include "methods/diagnostics/kkt_fill.hpp"

#include <algorithm>
#include <vector>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace dmocbench {

namespace {

/// Position of every free variable in the matrix; -1 for fixed ones.
std::vector<int> positions_of(const Transcription& transcription) {
  std::vector<int> positions;
  int next = 0;
  for (std::size_t j = 0; j < transcription.variable_count(); ++j) {
    positions.push_back(is_fixed(transcription, static_cast<Eigen::Index>(j)) ? -1 : next++);
  }
  return positions;
}

}  // namespace

KktFill kkt_fill(const Transcription& transcription) {
  const std::vector<int> positions = positions_of(transcription);
  const auto position = [&](int j) { return positions[static_cast<std::size_t>(j)]; };
  const auto free = static_cast<int>(free_variable_count(transcription));
  const auto size = free + static_cast<int>(transcription.constraint_count());

  // Only the pattern matters. These numbers make the matrix diagonally dominant, so that it has a Cholesky factor.
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(size) + transcription.hessian_structure().size() +
                  transcription.jacobian_structure().size());
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, static_cast<double>(size));
  transcription.hessian_structure().for_each([&](Eigen::Index /*entry*/, int i, int j) {
    const int row = position(i);
    const int column = position(j);
    if (row >= 0 && column >= 0 && row != column) {
      entries.emplace_back(std::max(row, column), std::min(row, column), -0.5);
    }
  });
  transcription.jacobian_structure().for_each([&](Eigen::Index /*entry*/, int row, int j) {
    const int column = position(j);
    if (column >= 0) entries.emplace_back(free + row, column, -0.5);
  });
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>> factor(matrix);
  return {.nonzeros = static_cast<std::size_t>(matrix.nonZeros()),
          .factor_nonzeros = static_cast<std::size_t>(factor.matrixL().nestedExpression().nonZeros())};
}

}  // namespace dmocbench
