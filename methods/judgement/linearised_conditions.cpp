#include "methods/judgement/linearised_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/kkt/linearisation.hpp"
#include "methods/kkt/newton_residual.hpp"
#include "methods/kkt/sparse_kkt.hpp"
#include "methods/kkt/symmetric_factorisation.hpp"
#include "methods/runtime/long_vectors.hpp"

namespace dmocbench {

namespace {

/// The least distance to a bound by which a multiplier is divided.
constexpr double at_bound = 1e-10;

/// The distance from x to the bound that a gradient of this sign presses it against.
double distance_to_bound(double gradient, double x, double lower, double upper) {
  return gradient > 0.0 ? x - lower : upper - x;
}

}  // namespace

LinearisedConditions::LinearisedConditions(NonlinearProgram& program, const Eigen::VectorXd& primal,
                                           const Eigen::VectorXd& multipliers) {
  KktMemory memory;
  evaluate_kkt(program, primal, multipliers, memory);
  compute(program, primal, multipliers, memory);
}

void LinearisedConditions::compute(NonlinearProgram& program, const Eigen::VectorXd& primal,
                                   const Eigen::VectorXd& multipliers, const KktMemory& memory) {
  hessian.resize(static_cast<Eigen::Index>(program.hessian_structure().size()));
  program.hessian(primal, 1.0, multipliers, hessian);
  jacobian = memory.jacobian;
  gradient_of_cost = memory.gradient_of_cost;
  gradient_of_lagrangian = memory.gradient;
  gradient = memory.gradient;
  constraints = memory.constraints;
  diagonal.setZero(primal.size());
  compliance.setZero(multipliers.size());
  for (Eigen::Index j = 0; j < primal.size(); ++j) {
    linearise_bound(j, primal[j], program.variable_lower()[j], program.variable_upper()[j]);
  }
  for (Eigen::Index i = 0; i < constraints.size(); ++i) {
    linearise_constraint(i, multipliers[i], program.constraint_lower()[i], program.constraint_upper()[i]);
  }
}

bool LinearisedConditions::is_finite() const {
  return dmocbench::is_finite(hessian) && dmocbench::is_finite(jacobian) && dmocbench::is_finite(gradient);
}

void LinearisedConditions::linearise_bound(Eigen::Index j, double x, double lower, double upper) {
  const double distance = distance_to_bound(gradient[j], x, lower, upper);
  if (!std::isfinite(distance)) return;
  const double counted = std::max(distance, at_bound);
  diagonal[j] = std::abs(gradient[j]) / counted;
  gradient[j] *= distance / counted;
}

void LinearisedConditions::linearise_constraint(Eigen::Index i, double multiplier, double lower, double upper) {
  const double value = constraints[i];
  constraints[i] = value - (multiplier < 0.0 ? lower : upper);
  if (lower == upper) return;
  const double distance = std::max(distance_to_bound(-multiplier, value, lower, upper), at_bound);
  compliance[i] = std::min(distance / std::abs(multiplier), no_part);
  if (!(compliance[i] < no_part)) compliance[i] = no_part;  // also where the multiplier is 0
  if (compliance[i] == no_part) constraints[i] = 0.0;
}

std::unique_ptr<kkt::KktSystem> kkt_system_by_intervals(const NonlinearProgram& program) {
  if (auto by_intervals = kkt::IntervalKkt::make(program)) return std::move(*by_intervals);
  return nullptr;
}

std::unique_ptr<kkt::SparseKkt> kkt_system_of_any_point(const NonlinearProgram& program) {
  return std::make_unique<kkt::SparseKkt>(program, kkt::SparseKkt::Order::found, kkt::SparseKkt::Inertia::any);
}

namespace {

/// The equalities, and the inequalities that are at a bound.
std::vector<bool> held_rows(const NonlinearProgram& program, const Eigen::VectorXd& constraints) {
  std::vector<bool> held = equalities_of(program);
  for (const Eigen::Index i : inequalities_of(program)) {
    held[static_cast<std::size_t>(i)] = is_held(constraints[i], program.constraint_lower()[i]) ||
                                        is_held(constraints[i], program.constraint_upper()[i]);
  }
  return held;
}

/// The Jacobian of the held rows by the free variables, each row of length 1, or 0 if its derivatives vanish.
Eigen::SparseMatrix<double> normalised(const Eigen::SparseMatrix<double>& jacobian, const std::vector<bool>& held,
                                       const std::vector<bool>& is_free) {
  Eigen::SparseMatrix<double> result = jacobian;
  result.prune([&](Eigen::Index row, Eigen::Index column, double value) {
    return held[static_cast<std::size_t>(row)] && is_free[static_cast<std::size_t>(column)] && value != 0.0;
  });
  const Eigen::VectorXd lengths = (result.cwiseProduct(result) * Eigen::VectorXd::Ones(result.cols())).cwiseSqrt();
  return lengths.unaryExpr([](double length) { return length > 0.0 ? 1.0 / length : 0.0; }).asDiagonal() * result;
}

/// Any numbers for the held rows, with a part in every direction; 0 for the others.
Eigen::VectorXd any_sides(const std::vector<bool>& held) {
  Eigen::VectorXd sides(static_cast<Eigen::Index>(held.size()));
  for (Eigen::Index i = 0; i < sides.size(); ++i) {
    sides[i] = held[static_cast<std::size_t>(i)] ? std::cos(static_cast<double>(i) + 1.0) : 0.0;
  }
  return sides;
}

/// True where elimination by intervals shows that the rows R of `normalised` do not depend on each other: of the
/// shortest x with R x = any sides, x = Rᵀλ, the multipliers are not far larger than x. False where that stays unknown.
bool shows_independence(NonlinearProgram& program, const Eigen::VectorXd& point, const std::vector<bool>& held) {
  constexpr double small_share = 1e-7;
  constexpr double accuracy = 1e-4;
  const auto by_intervals = kkt_system_by_intervals(program);
  if (!by_intervals) return false;
  Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  program.jacobian(point, jacobian);
  Eigen::VectorXd lengths = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(held.size()));
  program.jacobian_structure().for_each([&](Eigen::Index e, int row, int column) {
    if (!is_fixed(program, column)) lengths[row] += jacobian[e] * jacobian[e];
  });
  lengths = lengths.cwiseSqrt();
  Eigen::VectorXd compliance = Eigen::VectorXd::Zero(lengths.size());
  for (const Eigen::Index i : inequalities_of(program)) {
    compliance[i] = held[static_cast<std::size_t>(i)] ? at_bound : LinearisedConditions::no_part;
  }
  for (Eigen::Index i = 0; i < lengths.size(); ++i) {
    if (!held[static_cast<std::size_t>(i)]) {
      lengths[i] = 0.0;
    } else if (!(lengths[i] > 0.0)) {
      return false;
    }
  }
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(point.size());
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(point.size());
  const Eigen::VectorXd no_hessian =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.hessian_structure().size()));
  const Eigen::VectorXd sides = lengths.cwiseProduct(any_sides(held));
  Eigen::VectorXd x = nothing;
  Eigen::VectorXd multipliers = sides;
  const kkt::KktMatrix matrix{no_hessian, jacobian, ones, compliance};
  const kkt::KktStep step{x, multipliers};
  if (by_intervals->solve(matrix, {nothing, sides}, step) != kkt::FactorisationStatus::solved) return false;
  kkt::NewtonResidual residual(program);
  residual.compute(matrix, {nothing, sides}, step);
  return residual.excess(matrix, step, accuracy) <= 1.0 &&
         x.norm() > small_share * lengths.cwiseProduct(multipliers).norm();
}

}  // namespace

double largest_entry(const NonlinearProgram& program, const Eigen::VectorXd& hessian) {
  double largest = 0.0;
  program.hessian_structure().for_each([&](Eigen::Index e, int i, int j) {
    if (!is_fixed(program, i) && !is_fixed(program, j)) largest = std::max(largest, std::abs(hessian[e]));
  });
  return largest;
}

bool is_held(double value, double bound) {
  constexpr double near = 1e-6;
  return std::isfinite(bound) && std::abs(value - bound) <= near * std::max(1.0, std::abs(bound));
}

std::vector<std::size_t> dependent_rows(NonlinearProgram& program, const Eigen::VectorXd& point) {
  constexpr double shift = 1e-13;
  constexpr double rounding = 1e-8;
  constexpr double small_share = 0.1;
  Linearisation at = values_at(program, point);
  const std::vector<bool> held = held_rows(program, at.constraints);
  if (!at.has_finite_values() || shows_independence(program, point, held)) return {};
  differentiate(program, at);
  if (!at.jacobian.coeffs().allFinite()) return {};
  const std::vector<bool> is_free = free_variables(program);
  const Eigen::SparseMatrix<double> rows = normalised(at.jacobian, held, is_free);

  const Eigen::Index n = rows.cols();
  const Eigen::Index m = rows.rows();
  Eigen::SparseMatrix<double> matrix = kkt_matrix(Eigen::SparseMatrix<double>(n, n), 1.0, rows, is_free, held);
  for (Eigen::Index i = 0; i < m; ++i) {
    if (held[static_cast<std::size_t>(i)]) matrix.coeffRef(n + i, n + i) -= shift;
  }
  SymmetricFactorisation factorisation;
  if (!factorisation.factorise(matrix)) return {};
  // (J Jᵀ + shift)⁻¹ y of unit length: it enlarges the part of y without a gradient most.
  const auto enlarge = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
    Eigen::VectorXd right_hand_side = Eigen::VectorXd::Zero(n + m);
    right_hand_side.tail(m) = y;
    return factorisation.solve(std::move(right_hand_side)).tail(m).normalized();
  };
  Eigen::VectorXd y = enlarge(enlarge(any_sides(held)));
  Eigen::Index first = 0;
  y.cwiseAbs().maxCoeff(&first);
  // Among several dependencies, the shortest one with this row.
  y = enlarge(Eigen::VectorXd::Unit(m, first));
  if (!((rows.transpose() * y).norm() <= rounding)) return {};
  std::vector<std::size_t> dependent;
  const double most = y.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < m; ++i) {
    if (std::abs(y[i]) >= small_share * most) dependent.push_back(static_cast<std::size_t>(i));
  }
  std::ranges::stable_sort(dependent, std::ranges::greater{},
                           [&](std::size_t i) { return std::abs(y[static_cast<Eigen::Index>(i)]); });
  return dependent;
}

}  // namespace dmocbench
