#include "methods/judgement/flat_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "methods/kkt/linearisation.hpp"

namespace dmocbench {

std::vector<FlatRow> flat_rows(NonlinearProgram& program, const Eigen::VectorXd& point) {
  constexpr double rounding = 1e-9;
  constexpr double nearness = 1e-3;
  Linearisation at = values_at(program, point);
  differentiate(program, at);
  if (!at.has_finite_values() || !at.jacobian.coeffs().allFinite()) return {};
  // The curvature of the violated rows, such that a positive one repairs them.
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(at.constraints.size());
  for (const Eigen::Index i : inequalities_of(program)) {
    if (at.constraints[i] < program.constraint_lower()[i]) multipliers[i] = 1.0;
    if (at.constraints[i] > program.constraint_upper()[i]) multipliers[i] = -1.0;
  }
  if (multipliers.isZero(0.0)) return {};
  Eigen::VectorXd values(static_cast<Eigen::Index>(program.hessian_structure().size()));
  program.hessian(point, 0.0, multipliers, values);
  Eigen::VectorXd curvature = Eigen::VectorXd::Zero(point.size());
  program.hessian_structure().for_each([&](Eigen::Index e, int i, int j) {
    if (i == j) curvature[i] += values[e];
  });
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(multipliers.size());
  program.jacobian_structure().for_each([&](Eigen::Index /*e*/, int row, int column) {
    largest[row] = std::max(largest[row], std::abs(at.jacobian.coeff(row, column)));
  });
  // A derivative that is not 0 nearby: the curvature is this row's.
  Linearisation nearby = values_at(program, point.array() + nearness * point.array().abs().max(1.0));
  differentiate(program, nearby);
  std::vector<FlatRow> flat;
  program.jacobian_structure().for_each([&](Eigen::Index /*e*/, int row, int column) {
    if (multipliers[row] == 0.0 || is_fixed(program, column) || !(curvature[column] > 0.0)) return;
    if (std::abs(at.jacobian.coeff(row, column)) > rounding * std::max(1.0, largest[row])) return;
    if (nearby.jacobian.coeff(row, column) == 0.0) return;
    flat.push_back({static_cast<std::size_t>(row), static_cast<std::size_t>(column)});
  });
  return flat;
}

Eigen::VectorXd moved_off_flat_rows(NonlinearProgram& program, const Eigen::VectorXd& point) {
  constexpr double share = 1e-2;
  const IntervalStructure* structure = program.interval_structure();
  if (structure == nullptr) return {};
  const std::vector<PlaceRun>& runs = structure->unknowns.runs();
  std::vector<bool> moves(runs.size());
  for (const FlatRow& flat : flat_rows(program, point)) moves[structure->unknowns.run_of(flat.unknown)] = true;
  double size = 0.0;
  const auto of_run = [](auto& x, const PlaceRun& run) {
    return x.segment(static_cast<Eigen::Index>(run.first), static_cast<Eigen::Index>(run.count));
  };
  for (const PlaceRun& run : runs) {
    if (run.kind == Place::Kind::node) size = std::max(size, of_run(point, run).cwiseAbs().maxCoeff());
  }
  Eigen::VectorXd moved = point;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!moves[r] || runs[r].kind != Place::Kind::node) continue;
    const double step = std::numbers::pi / static_cast<double>(runs[r].count + 1);
    of_run(moved, runs[r]) +=
        share * size *
        Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(runs[r].count), step, std::numbers::pi - step)
            .array()
            .sin()
            .matrix();
  }
  moved = moved.cwiseMax(program.variable_lower()).cwiseMin(program.variable_upper());
  return moved == point ? Eigen::VectorXd() : moved;
}

}  // namespace dmocbench
