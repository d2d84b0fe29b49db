#include "methods/kkt/sparse_kkt.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "methods/kkt/linearisation.hpp"
#include "methods/runtime/long_vectors.hpp"

namespace dmocbench::kkt {

namespace {

/// Puts the places `begin` .. `end` - 1 into their order of elimination: 2 k is node k, 2 k + 1 interval k.
void dissect(std::size_t begin, std::size_t end, std::size_t& next, std::vector<std::size_t>& ranks) {
  // Ten intervals and their nodes. Of 5 to 40 intervals none is faster by more than the noise (robot_arm, hang_glider).
  constexpr std::size_t most_together = 20;
  if (end - begin <= most_together) {
    for (std::size_t place = begin; place < end; ++place) ranks[place] = next++;
    return;
  }
  const std::size_t middle = (begin + end) / 4 * 2;
  dissect(begin, middle, next, ranks);
  dissect(middle + 1, end, next, ranks);
  ranks[middle] = next++;
}

}  // namespace

std::vector<int> dissection_order(const NonlinearProgram& program) {
  const IntervalStructure* const structure = program.interval_structure();
  if (structure == nullptr) return {};
  std::vector<std::size_t> ranks(2 * structure->intervals + 1);
  std::size_t next = 0;
  dissect(0, ranks.size(), next, ranks);

  std::vector<std::pair<std::size_t, int>> keys;  // of the lines
  const auto append = [&](const Place& place, bool is_row) {
    const bool of_node = place.kind == Place::Kind::node;
    const std::size_t rank = place.kind == Place::Kind::border ? next : ranks[2 * place.index + (of_node ? 0 : 1)];
    // Rows of a node come before its unknowns, rows of an interval after them.
    keys.emplace_back(2 * rank + (is_row == of_node ? 0 : 1), static_cast<int>(keys.size()));
  };
  structure->unknowns.for_each([&](const Place& place) { append(place, false); });
  structure->rows.for_each([&](const Place& place) { append(place, true); });
  std::ranges::sort(keys);
  std::vector<int> positions(keys.size());
  for (int position = 0; const auto& [rank, line] : keys) positions[static_cast<std::size_t>(line)] = position++;
  return positions;
}

SparseKkt::SparseKkt(const NonlinearProgram& program, Order order, Inertia inertia)
    : program_(program),
      inertia_(inertia),
      is_free_(free_variables(program)),
      factorisation_(order == Order::found ? std::vector<int>{} : dissection_order(program)) {}

Eigen::SparseMatrix<double> SparseKkt::lower_triangle(const KktMatrix& matrix) const {
  const auto n = static_cast<Eigen::Index>(program_.variable_count());
  const auto m = static_cast<Eigen::Index>(program_.constraint_count());
  const BlockPattern& hessian = program_.hessian_structure();
  const BlockPattern& jacobian = program_.jacobian_structure();
  const auto is_free = [&](int i) { return is_free_[static_cast<std::size_t>(i)]; };
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(hessian.size() + jacobian.size() + static_cast<std::size_t>(n + m));
  hessian.for_each([&](Eigen::Index e, int row, int column) {
    entries.emplace_back(row, column, is_free(row) && is_free(column) ? matrix.hessian[e] : 0.0);
  });
  jacobian.for_each([&](Eigen::Index e, int row, int column) {
    entries.emplace_back(static_cast<int>(n) + row, column, is_free(column) ? matrix.jacobian[e] : 0.0);
  });
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, is_free(i) ? matrix.diagonal[i] : 1.0);
  for (int i = 0; i < m; ++i) {
    entries.emplace_back(static_cast<int>(n) + i, static_cast<int>(n) + i, -matrix.compliance_of(i));
  }
  Eigen::SparseMatrix<double> lower(n + m, n + m);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

FactorisationStatus SparseKkt::solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                     const KktStep& step) {
  const auto& [gradient, constraints] = right_hand_side;
  if (!is_finite(matrix.hessian) || !is_finite(matrix.jacobian)) return FactorisationStatus::singular;
  if (!factorisation_.factorise(lower_triangle(matrix))) return FactorisationStatus::singular;
  has_minimum_ = factorisation_.negative_eigenvalues() == constraints.size();
  if (!has_minimum_ && inertia_ == Inertia::minimum) return FactorisationStatus::wrong_inertia;
  Eigen::VectorXd negated(gradient.size() + constraints.size());
  negated << -gradient, -constraints;
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    if (!is_free_[static_cast<std::size_t>(i)]) negated[i] = 0.0;
  }
  const Eigen::VectorXd solution = factorisation_.solve(std::move(negated));
  if (!solution.allFinite()) return FactorisationStatus::singular;
  step.primal = solution.head(gradient.size());
  step.multipliers = solution.tail(constraints.size());
  return FactorisationStatus::solved;
}

}  // namespace dmocbench::kkt
