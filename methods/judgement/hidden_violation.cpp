#include "methods/judgement/hidden_violation.hpp"

#include <algorithm>
#include <cmath>

namespace dmocbench {

void ConstraintSizes::measure_unknowns(const NonlinearProgram& program, const Eigen::VectorXd& primal) {
  constexpr double at_rest = 1e-6;
  const double largest = primal.size() > 0 ? primal.lpNorm<Eigen::Infinity>() : 0.0;
  const double least = at_rest * std::max(1.0, largest);
  of_unknowns_.setConstant(primal.size(), largest > least ? largest : 1.0);
  const IntervalStructure* const structure = program.interval_structure();
  if (structure == nullptr) return;
  for (const PlaceRun& run : structure->unknowns.runs()) {
    const auto first = static_cast<Eigen::Index>(run.first);
    const auto count = static_cast<Eigen::Index>(run.count);
    if (count == 0) continue;
    const double size = primal.segment(first, count).lpNorm<Eigen::Infinity>();
    of_unknowns_.segment(first, count).setConstant(size > least ? size : 1.0);
  }
}

std::optional<HiddenViolation> ConstraintSizes::hidden_violation(const NonlinearProgram& program,
                                                                 const Eigen::VectorXd& primal,
                                                                 const KktMemory& memory) {
  measure_unknowns(program, primal);
  of_rows_.setZero(memory.constraints.size());
  program.jacobian_structure().for_each([&](Eigen::Index e, int row, int column) {
    of_rows_[row] += std::abs(memory.jacobian[e]) * of_unknowns_[column];
  });
  std::optional<HiddenViolation> worst;
  for (Eigen::Index i = 0; i < of_rows_.size(); ++i) {
    const double violation = std::max({0.0, program.constraint_lower()[i] - memory.constraints[i],
                                       memory.constraints[i] - program.constraint_upper()[i]});
    const bool is_flat = of_rows_[i] == 0.0;
    const double size = is_flat ? std::abs(memory.constraints[i]) : of_rows_[i];
    if (is_flat && violation <= program.rounding_floors().of_constraint(i)) continue;
    if (!(violation > std::max(largest_share, worst ? worst->share : 0.0) * size) || size == 0.0) continue;
    worst = HiddenViolation{.row = i, .size = size, .share = violation / size};
  }
  add_distances_from_bounds(program, memory.constraints);
  return worst;
}

void ConstraintSizes::add_distances_from_bounds(const NonlinearProgram& program, const Eigen::VectorXd& constraints) {
  for (Eigen::Index i = 0; i < of_rows_.size(); ++i) {
    const double lower = program.constraint_lower()[i];
    const double upper = program.constraint_upper()[i];
    if (lower == upper) continue;
    const double distance = std::min(std::abs(constraints[i] - lower), std::abs(upper - constraints[i]));
    of_rows_[i] = std::isfinite(distance) ? std::max(of_rows_[i], distance) : 0.0;
  }
}

Eigen::VectorXd ConstraintSizes::factors() const {
  static constexpr int most = 1000;  // a factor stays finite
  Eigen::VectorXd factors = of_rows_.unaryExpr([](double size) {
    if (size == 0.0 || (size >= smallest_size && size <= 1.0 / smallest_size)) return 1.0;
    return std::ldexp(1.0, std::clamp(-std::ilogb(size), -most, most));
  });
  if ((factors.array() == 1.0).all()) return {};
  return factors;
}

bool ConstraintSizes::has_small_inequality(const NonlinearProgram& program) const {
  const auto is_inequality = program.constraint_lower().array() < program.constraint_upper().array();
  return (is_inequality && of_rows_.array() > 0.0 && of_rows_.array() < smallest_size).any();
}

}  // namespace dmocbench
