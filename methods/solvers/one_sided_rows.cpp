#include "methods/solvers/one_sided_rows.hpp"

#include <algorithm>
#include <cmath>

namespace dmocbench {

OneSidedRows::OneSidedRows(const NonlinearProgram& program, Kind kind, const std::vector<Eigen::Index>& numbers,
                           std::size_t free_count)
    : free_count_(free_count) {
  std::vector<std::vector<std::size_t>> sides_of(program.constraint_count());
  const auto append = [&](Eigen::Index row, double sign, double bound) {
    if (!std::isfinite(bound)) return;
    sides_of[static_cast<std::size_t>(row)].push_back(sides_.size());
    sides_.push_back({row, sign, bound});
  };
  for (Eigen::Index i = 0; i < program.constraint_lower().size(); ++i) {
    const double lower = program.constraint_lower()[i];
    const double upper = program.constraint_upper()[i];
    if ((lower == upper) != (kind == Kind::equalities)) continue;
    append(i, 1.0, upper);
    if (kind == Kind::inequalities) append(i, -1.0, lower);
  }
  program.jacobian_structure().for_each([&](Eigen::Index e, int row, int column) {
    const Eigen::Index number = numbers[static_cast<std::size_t>(column)];
    if (number < 0) return;
    for (const std::size_t side : sides_of[static_cast<std::size_t>(row)]) {
      entries_.push_back({e, side * free_count + static_cast<std::size_t>(number), sides_[side].sign});
    }
  });
}

void OneSidedRows::values(const Eigen::VectorXd& rows, double* result) const {
  for (const Side& side : sides_) *result++ = side.sign * (rows[side.row] - side.bound);
}

void OneSidedRows::jacobian(const Eigen::VectorXd& nonzeros, double* result) const {
  std::fill_n(result, sides_.size() * free_count_, 0.0);
  for (const Entry& entry : entries_) result[entry.position] = entry.sign * nonzeros[entry.nonzero];
}

}  // namespace dmocbench
