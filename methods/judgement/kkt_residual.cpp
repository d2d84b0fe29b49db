#include "methods/judgement/kkt_residual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/SparseCore>
#include <Eigen/SparseQR>

#include "methods/error.hpp"
#include "methods/runtime/long_vectors.hpp"

namespace dmocbench {

namespace {

void require_size(Eigen::Index actual, std::size_t wanted, const char* entries) {
  if (static_cast<std::size_t>(actual) == wanted) return;
  throw Error("a point of this program has {} {}, got {}", wanted, entries, actual);
}

/// A vector of `size` entries that `evaluate` writes.
template <class Evaluate>
Eigen::VectorXd evaluated(std::size_t size, const Evaluate& evaluate) {
  Eigen::VectorXd values;
  resize_unwritten(values, static_cast<Eigen::Index>(size));
  evaluate(values);
  return values;
}

Eigen::VectorXd constraints_at(NonlinearProgram& program, const Eigen::VectorXd& primal) {
  return evaluated(program.constraint_count(), [&](Eigen::VectorXd& values) { program.constraints(primal, values); });
}

Eigen::VectorXd gradient_at(NonlinearProgram& program, const Eigen::VectorXd& primal) {
  return evaluated(program.variable_count(), [&](Eigen::VectorXd& values) { program.gradient(primal, values); });
}

Eigen::VectorXd jacobian_at(NonlinearProgram& program, const Eigen::VectorXd& primal) {
  return evaluated(program.jacobian_structure().size(),
                   [&](Eigen::VectorXd& values) { program.jacobian(primal, values); });
}

/// The larger of both; NaN if one is NaN.
double largest(double a, double b) { return std::isnan(b) ? b : std::max(a, b); }

/// The distance of a value from its bounds; NaN if the value is NaN.
double outside(double x, double lower, double upper) {
  return std::isnan(x) ? x : std::max({0.0, lower - x, x - upper});
}

double largest_outside(const Eigen::VectorXd& x, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  double worst = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    worst = largest(worst, outside(x[i], lower[i], upper[i]));
    if (std::isnan(worst)) return worst;
  }
  return worst;
}

/// The part of an entry of a gradient that its bounds cannot take up; nothing of a fixed one. A bound at the distance
/// d, on the side where the objective falls, may take up an entry g with its multiplier: without the multiplier |g| of
/// stationarity are left, with it |g| d of complementarity. Without a bound there it is |g|, at the bound 0.
double stationarity(double gradient, double x, double lower, double upper) {
  if (lower == upper) return 0.0;
  const double inside = std::clamp(x, lower, upper);
  const double distance = gradient > 0.0 ? inside - lower : upper - inside;
  return std::abs(gradient) * std::min(1.0, distance);
}

double largest_stationarity(double sign, const Eigen::VectorXd& gradient, const Eigen::VectorXd& x,
                            const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  double worst = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    worst = largest(worst, stationarity(sign * gradient[i], x[i], lower[i], upper[i]));
  }
  return worst;
}

double violation_of(const NonlinearProgram& program, const Eigen::VectorXd& primal,
                    const Eigen::VectorXd& constraints) {
  return largest(largest_outside(constraints, program.constraint_lower(), program.constraint_upper()),
                 largest_outside(primal, program.variable_lower(), program.variable_upper()));
}

/// Numbers the entries that are chosen 0, 1, ...
struct ChosenEntries {
  std::vector<int> numbers;  // -1 of the others
  int count = 0;
  void append(bool chosen) { numbers.push_back(chosen ? count++ : -1); }
  [[nodiscard]] int number_of(Eigen::Index i) const { return numbers[static_cast<std::size_t>(i)]; }
  [[nodiscard]] bool contains(Eigen::Index i) const { return number_of(i) >= 0; }
};

bool is_at(double value, double bound, double activity) {
  return std::isfinite(bound) && std::abs(value - bound) <= activity * std::max(1.0, std::abs(bound));
}

bool is_outside_or_at(double value, double lower, double upper, double activity) {
  return is_at(value, lower, activity) || is_at(value, upper, activity) || value < lower || value > upper;
}

/// The values that are at, or outside, a bound, or those that are not; an equality is always the former.
ChosenEntries selected(bool at_bound, const Eigen::VectorXd& values, const Eigen::VectorXd& lower,
                       const Eigen::VectorXd& upper, double activity) {
  ChosenEntries chosen_entries;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    chosen_entries.append(is_outside_or_at(values[i], lower[i], upper[i], activity) == at_bound);
  }
  return chosen_entries;
}

/// (∂a/∂ξ)ᵀ of the chosen rows and variables.
Eigen::SparseMatrix<double> transposed(const BlockPattern& pattern, const Eigen::VectorXd& values,
                                       const ChosenEntries& rows, const ChosenEntries& variables) {
  std::vector<Eigen::Triplet<double>> entries;
  pattern.for_each([&](Eigen::Index e, int i, int j) {
    if (!rows.contains(i) || !variables.contains(j)) return;
    entries.emplace_back(variables.number_of(j), rows.number_of(i), values[e]);
  });
  // Eigen's sparse QR needs at least as many rows as columns; rows of zeros change no least-squares solution.
  Eigen::SparseMatrix<double> matrix(std::max(variables.count, rows.count), rows.count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  matrix.makeCompressed();
  return matrix;
}

constexpr double unknown_multiplier = std::numeric_limits<double>::quiet_NaN();

/// The multipliers that are NaN in `known`, by least squares (`complete_multipliers`, whatever their signs).
Eigen::VectorXd found_multipliers(NonlinearProgram& program, const Eigen::VectorXd& primal,
                                  const Eigen::VectorXd& known, double activity) {
  Eigen::VectorXd gradient = gradient_at(program, primal);
  const Eigen::VectorXd constraints = constraints_at(program, primal);
  const Eigen::VectorXd jacobian = jacobian_at(program, primal);
  if (!primal.allFinite() || !gradient.allFinite() || !constraints.allFinite() || !jacobian.allFinite()) {
    return Eigen::VectorXd::Constant(constraints.size(), std::numeric_limits<double>::quiet_NaN());
  }
  Eigen::VectorXd multipliers = known.array().isNaN().select(0.0, known);
  program.jacobian_structure().for_each(
      [&](Eigen::Index e, int row, int column) { gradient[column] += jacobian[e] * multipliers[row]; });

  const ChosenEntries variables = selected(false, primal, program.variable_lower(), program.variable_upper(), activity);
  const ChosenEntries active =
      selected(true, constraints, program.constraint_lower(), program.constraint_upper(), activity);
  ChosenEntries wanted;
  for (Eigen::Index i = 0; i < constraints.size(); ++i) wanted.append(active.contains(i) && std::isnan(known[i]));
  if (wanted.count == 0 || variables.count == 0) return multipliers;

  const Eigen::SparseMatrix<double> matrix = transposed(program.jacobian_structure(), jacobian, wanted, variables);
  Eigen::VectorXd chosen_gradient = Eigen::VectorXd::Zero(matrix.rows());
  for (Eigen::Index i = 0; i < primal.size(); ++i) {
    if (variables.contains(i)) chosen_gradient[variables.number_of(i)] = gradient[i];
  }
  const Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> factorisation(matrix);
  const Eigen::VectorXd chosen_multipliers = factorisation.solve(-chosen_gradient);
  for (Eigen::Index i = 0; i < constraints.size(); ++i) {
    if (wanted.contains(i)) multipliers[i] = chosen_multipliers[wanted.number_of(i)];
  }
  return multipliers;
}

}  // namespace

void evaluate_kkt(NonlinearProgram& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers,
                  KktMemory& memory) {
  require_size(primal.size(), program.variable_count(), "variables");
  require_size(multipliers.size(), program.constraint_count(), "multipliers");
  resize_unwritten(memory.constraints, multipliers.size());
  resize_unwritten(memory.gradient_of_cost, primal.size());
  resize_unwritten(memory.jacobian, static_cast<Eigen::Index>(program.jacobian_structure().size()));
  program.constraints(primal, memory.constraints);
  program.gradient(primal, memory.gradient_of_cost);
  program.jacobian(primal, memory.jacobian);
  copy_to(memory.gradient, memory.gradient_of_cost);
  program.jacobian_structure().for_each(
      [&](Eigen::Index e, int row, int column) { memory.gradient[column] += memory.jacobian[e] * multipliers[row]; });
}

KktResidual kkt_residual(NonlinearProgram& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers,
                         KktMemory& memory) {
  evaluate_kkt(program, primal, multipliers, memory);
  KktResidual residual;
  residual.constraint_violation = violation_of(program, primal, memory.constraints);
  // The multiplier of an inequality is the gradient of its slack except for the sign; an equality's is free.
  residual.stationarity =
      largest(largest_stationarity(1.0, memory.gradient, primal, program.variable_lower(), program.variable_upper()),
              largest_stationarity(-1.0, multipliers, memory.constraints, program.constraint_lower(),
                                   program.constraint_upper()));
  return residual;
}

void kkt_entries(NonlinearProgram& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers,
                 KktMemory& memory, KktEntries& entries) {
  evaluate_kkt(program, primal, multipliers, memory);
  entries.gradient.resize(primal.size());
  entries.multipliers.resize(multipliers.size());
  entries.rows.resize(multipliers.size());
  entries.bounds = largest_outside(primal, program.variable_lower(), program.variable_upper());
  for (Eigen::Index j = 0; j < primal.size(); ++j) {
    entries.gradient[j] =
        stationarity(memory.gradient[j], primal[j], program.variable_lower()[j], program.variable_upper()[j]);
  }
  for (Eigen::Index i = 0; i < multipliers.size(); ++i) {
    const double lower = program.constraint_lower()[i];
    const double upper = program.constraint_upper()[i];
    entries.multipliers[i] = stationarity(-multipliers[i], memory.constraints[i], lower, upper);
    entries.rows[i] = outside(memory.constraints[i], lower, upper);
  }
}

double constraint_violation(NonlinearProgram& program, const Eigen::VectorXd& primal) {
  require_size(primal.size(), program.variable_count(), "variables");
  return violation_of(program, primal, constraints_at(program, primal));
}

Eigen::VectorXd least_squares_multipliers(NonlinearProgram& program, const Eigen::VectorXd& primal) {
  require_size(primal.size(), program.variable_count(), "variables");
  return found_multipliers(
      program, primal,
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(program.constraint_count()), unknown_multiplier),
      activity_tolerance);
}

Eigen::VectorXd complete_multipliers(NonlinearProgram& program, const Eigen::VectorXd& primal,
                                     const Eigen::VectorXd& known) {
  require_size(primal.size(), program.variable_count(), "variables");
  require_size(known.size(), program.constraint_count(), "multipliers");
  if (!known.hasNaN()) return known;
  Eigen::VectorXd multipliers = found_multipliers(program, primal, known, 1e-3);
  const Eigen::VectorXd constraints = constraints_at(program, primal);
  for (Eigen::Index i = 0; i < known.size(); ++i) {
    const double lower = program.constraint_lower()[i];
    const double upper = program.constraint_upper()[i];
    if (!std::isnan(known[i]) || lower == upper) continue;
    const bool is_at_lower = constraints[i] - lower < upper - constraints[i];
    multipliers[i] = is_at_lower ? std::min(multipliers[i], 0.0) : std::max(multipliers[i], 0.0);
  }
  return multipliers;
}

bool is_point_of_least_violation(NonlinearProgram& program, const Eigen::VectorXd& primal) {
  require_size(primal.size(), program.variable_count(), "variables");
  const Eigen::VectorXd constraints = constraints_at(program, primal);
  const Eigen::VectorXd jacobian = jacobian_at(program, primal);
  if (!primal.allFinite() || !constraints.allFinite() || !jacobian.allFinite()) return false;

  const Eigen::VectorXd excess =
      constraints - constraints.cwiseMax(program.constraint_lower()).cwiseMin(program.constraint_upper());
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(primal.size());
  program.jacobian_structure().for_each(
      [&](Eigen::Index e, int row, int column) { gradient[column] += jacobian[e] * excess[row]; });
  double reduction = 0.0;
  for (Eigen::Index i = 0; i < primal.size(); ++i) {
    const double room =
        gradient[i] > 0.0 ? primal[i] - program.variable_lower()[i] : program.variable_upper()[i] - primal[i];
    reduction += std::abs(gradient[i]) * std::clamp(room, 0.0, std::max(1.0, std::abs(primal[i])));
  }
  return excess.squaredNorm() > 0.0 && reduction <= least_violation_share * excess.squaredNorm();
}

}  // namespace dmocbench
