#include "methods/judgement/hidden_violation.hpp"

#include <algorithm>
#include <cmath>

namespace dmocbench {

namespace {

/// The size below which unknowns count as at rest.
double size_at_rest(const Eigen::VectorXd& primal) {
  constexpr double share = 1e-6;
  return share * std::max(1.0, primal.size() > 0 ? primal.lpNorm<Eigen::Infinity>() : 0.0);
}

}  // namespace

void ConstraintSizes::measure_unknowns(const NonlinearProgram& program, const Eigen::VectorXd& primal) {
  const double largest = primal.size() > 0 ? primal.lpNorm<Eigen::Infinity>() : 0.0;
  const double least = size_at_rest(primal);
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

/// Twice, since an unknown may be limited by another one at rest.
void ConstraintSizes::limit_those_at_rest(const NonlinearProgram& program, const Eigen::VectorXd& primal,
                                          const KktMemory& memory) {
  const IntervalStructure* const structure = program.interval_structure();
  if (structure == nullptr) return;
  const BlockPattern& pattern = program.jacobian_structure();
  const double least = size_at_rest(primal);
  const auto limit = [&](const PlaceRun& run) {
    const auto first = static_cast<Eigen::Index>(run.first);
    const auto count = static_cast<Eigen::Index>(run.count);
    if (count == 0 || primal.segment(first, count).lpNorm<Eigen::Infinity>() > least) return;
    const auto is_member = [&](int column) { return column >= first && column < first + count; };
    of_rows_.setZero(memory.constraints.size());
    pattern.for_each([&](Eigen::Index e, int row, int column) {
      if (!is_member(column)) of_rows_[row] += std::abs(memory.jacobian[e]) * of_unknowns_[column];
    });
    of_sums_.setConstant(of_unknowns_.size(), 1.0);
    pattern.for_each([&](Eigen::Index e, int row, int column) {
      const double by_member = std::abs(memory.jacobian[e]);
      const bool is_equation = program.constraint_lower()[row] == program.constraint_upper()[row];
      if (!is_member(column) || !is_equation || by_member == 0.0 || of_rows_[row] == 0.0) return;
      of_sums_[column] = std::min(of_sums_[column], of_rows_[row] / by_member);
    });
    of_unknowns_.segment(first, count).setConstant(of_sums_.segment(first, count).maxCoeff());
  };
  for (int sweep = 0; sweep < 2; ++sweep) {
    for (const PlaceRun& run : structure->unknowns.runs()) limit(run);
  }
}

void ConstraintSizes::measure_sums(const NonlinearProgram& program, const KktMemory& memory) {
  const IntervalStructure* const structure = program.interval_structure();
  const BlockPattern& pattern = program.jacobian_structure();
  adds_.setConstant(of_unknowns_.size(), structure == nullptr ? 0.0 : 1.0);
  pattern.for_each([&](Eigen::Index e, int /*row*/, int column) {
    if (std::abs(memory.jacobian[e]) != 1.0) adds_[column] = 0.0;
  });
  if (adds_.isZero(0.0)) return;
  of_rows_.setZero(memory.constraints.size());
  pattern.for_each([&](Eigen::Index e, int row, int column) {
    if (adds_[column] == 0.0) of_rows_[row] += std::abs(memory.jacobian[e]) * of_unknowns_[column];
  });
  of_sums_.setZero(of_unknowns_.size());
  pattern.for_each(
      [&](Eigen::Index /*e*/, int row, int column) { of_sums_[column] = std::max(of_sums_[column], of_rows_[row]); });
  for (const PlaceRun& run : structure->unknowns.runs()) {
    if (run.count == 0) continue;
    const auto members = Eigen::seqN(static_cast<Eigen::Index>(run.first), static_cast<Eigen::Index>(run.count));
    const double added = of_sums_(members).maxCoeff();
    const bool adds = run.kind == Place::Kind::node && run.count > 1 && adds_(members).minCoeff() > 0.0 && added > 0.0;
    adds_(members).setConstant(adds ? 1.0 : 0.0);
    if (adds) of_unknowns_(members).setConstant(added);
  }
}

template <class Compare>
void ConstraintSizes::compare_sums(const NonlinearProgram& program, const Eigen::VectorXd& primal,
                                   const KktMemory& memory, const Compare& compare) {
  if (adds_.isZero(0.0)) return;
  of_sums_.setZero(of_unknowns_.size());
  program.jacobian_structure().for_each([&](Eigen::Index e, int row, int column) {
    const double value = program.constraint_lower()[row];
    if (adds_[column] == 0.0 || memory.jacobian[e] < 0.0 || value != program.constraint_upper()[row]) return;
    of_sums_[column] += memory.constraints[row] - value;
  });
  for (const PlaceRun& run : program.interval_structure()->unknowns.runs()) {
    const auto members = Eigen::seqN(static_cast<Eigen::Index>(run.first), static_cast<Eigen::Index>(run.count));
    if (run.count == 0 || adds_[members.first()] == 0.0) continue;
    const double size = std::max(primal(members).lpNorm<Eigen::Infinity>(), of_unknowns_[members.first()]);
    compare(true, members.first() + members.size() - 1, std::abs(of_sums_(members).sum()), size);
  }
}

std::optional<HiddenViolation> ConstraintSizes::hidden_violation(const NonlinearProgram& program,
                                                                 const Eigen::VectorXd& primal,
                                                                 const KktMemory& memory) {
  measure_unknowns(program, primal);
  measure_sums(program, memory);
  std::optional<HiddenViolation> worst;
  const auto compare = [&](bool is_of_bound, Eigen::Index i, double violation, double size) {
    if (!(violation > std::max(largest_share, worst ? worst->share : 0.0) * size) || size == 0.0) return;
    worst = HiddenViolation{.is_of_bound = is_of_bound, .number = i, .size = size, .share = violation / size};
  };
  for (Eigen::Index j = 0; j < primal.size(); ++j) {
    compare(true, j, std::max(program.variable_lower()[j] - primal[j], primal[j] - program.variable_upper()[j]),
            of_unknowns_[j]);
  }
  compare_sums(program, primal, memory, compare);
  limit_those_at_rest(program, primal, memory);
  of_rows_.setZero(memory.constraints.size());
  program.jacobian_structure().for_each([&](Eigen::Index e, int row, int column) {
    of_rows_[row] += std::abs(memory.jacobian[e]) * of_unknowns_[column];
  });
  for (Eigen::Index i = 0; i < of_rows_.size(); ++i) {
    const double violation = std::max({0.0, program.constraint_lower()[i] - memory.constraints[i],
                                       memory.constraints[i] - program.constraint_upper()[i]});
    const bool is_flat = of_rows_[i] == 0.0;
    if (is_flat && violation <= program.rounding_floors().of_constraint(i)) continue;
    compare(false, i, violation, is_flat ? std::abs(memory.constraints[i]) : of_rows_[i]);
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
