#include "methods/solvers/least_violation.hpp"

#include <algorithm>
#include <cmath>

namespace dmocbench {

bool is_point_of_least_violation(NonlinearProgram& program, const Eigen::VectorXd& primal) {
  const BlockPattern& pattern = program.jacobian_structure();
  Eigen::VectorXd rows(static_cast<Eigen::Index>(program.constraint_count()));
  Eigen::VectorXd jacobian(static_cast<Eigen::Index>(pattern.size()));
  program.constraints(primal, rows);
  program.jacobian(primal, jacobian);
  if (!primal.allFinite() || !rows.allFinite() || !jacobian.allFinite()) return false;

  const Eigen::VectorXd outside = rows - rows.cwiseMax(program.constraint_lower()).cwiseMin(program.constraint_upper());
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(primal.size());
  pattern.for_each([&](Eigen::Index e, int row, int column) { slope[column] += jacobian[e] * outside[row]; });
  double steepest = 0.0;
  for (Eigen::Index i = 0; i < primal.size(); ++i) {
    const bool is_held = (slope[i] > 0.0 && primal[i] <= program.variable_lower()[i]) ||
                         (slope[i] < 0.0 && primal[i] >= program.variable_upper()[i]);
    if (!is_held) steepest = std::max(steepest, std::abs(slope[i]) * std::max(1.0, std::abs(primal[i])));
  }
  return outside.squaredNorm() > 0.0 && steepest <= least_violation_share * outside.squaredNorm();
}

}  // namespace dmocbench
