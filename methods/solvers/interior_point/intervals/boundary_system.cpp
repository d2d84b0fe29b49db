#include "methods/solvers/interior_point/intervals/boundary_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <lapacke.h>

#include "methods/error.hpp"

namespace dmocbench::interior_point {

namespace {

double value_at(const Eigen::VectorXd& vector, std::size_t i) { return vector[static_cast<Eigen::Index>(i)]; }

/// Factors that bring the largest entries of rows and columns near 1.
Eigen::VectorXd equilibration(const Eigen::MatrixXd& lower) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(lower.rows());
  for (Eigen::Index j = 0; j < lower.cols(); ++j) {
    for (Eigen::Index i = j; i < lower.rows(); ++i) {
      largest[i] = std::max(largest[i], std::abs(lower(i, j)));
      largest[j] = std::max(largest[j], std::abs(lower(i, j)));
    }
  }
  return largest.unaryExpr([](double size) { return size > 0.0 ? 1.0 / std::sqrt(size) : 1.0; });
}

/// Smallest magnitude of the eigenvalues of a symmetric block (a, b; b, c).
double smallest_eigenvalue(double a, double b, double c) {
  const double largest = 0.5 * (std::abs(a + c) + std::hypot(a - c, 2.0 * b));
  return largest > 0.0 ? std::abs(a * c - b * b) / largest : 0.0;
}

/// From the blocks of one or two rows of D; a block of two has one eigenvalue of either sign.
DenseInertia inertia_of(const Eigen::MatrixXd& factors, const std::vector<lapack_int>& pivots) {
  const Eigen::Index n = factors.rows();
  constexpr double far_from_zero = 1e-11;  // hundreds of times what rounding leaves of dependent rows
  // What elimination leaves of dependent rows is rounding, a few units of it per row.
  const double rounding = 10.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
  DenseInertia inertia;
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (pivots[static_cast<std::size_t>(i)] < 0) {
      smallest = std::min(smallest, smallest_eigenvalue(factors(i, i), factors(i + 1, i), factors(i + 1, i + 1)));
      ++inertia.negative;
      ++i;
    } else {
      smallest = std::min(smallest, std::abs(factors(i, i)));
      if (factors(i, i) < 0.0) ++inertia.negative;
    }
  }
  inertia.is_singular = !(smallest > rounding);
  inertia.is_certain = smallest > far_from_zero;
  return inertia;
}

}  // namespace

DenseInertia solve_symmetric(Eigen::MatrixXd& matrix, Eigen::VectorXd& right_hand_side) {
  const Eigen::Index n = matrix.rows();
  if (n == 0) return {.is_certain = true};
  if (!matrix.allFinite() || !right_hand_side.allFinite()) return {.is_singular = true};
  const Eigen::VectorXd scale = equilibration(matrix);
  matrix = (scale.asDiagonal() * matrix * scale.asDiagonal()).eval();
  right_hand_side.array() *= scale.array();
  std::vector<lapack_int> pivots(static_cast<std::size_t>(n));
  const auto order = static_cast<lapack_int>(n);
  const lapack_int info = LAPACKE_dsytrf(LAPACK_COL_MAJOR, 'L', order, matrix.data(), order, pivots.data());
  if (info != 0) return {.is_singular = true};
  LAPACKE_dsytrs(LAPACK_COL_MAJOR, 'L', order, 1, matrix.data(), order, pivots.data(), right_hand_side.data(), order);
  right_hand_side.array() *= scale.array();
  return inertia_of(matrix, pivots);
}

BoundarySystem::BoundarySystem(const NonlinearProgram& program, const IntervalEntries& entries)
    : state_size_(state_size(entries.shape)), node_(entries.shape.node), node_sums_(entries.shape.node_sums) {
  number_unknowns(entries);
  number_rows(entries);
  place(entries);
  drop_what_is_fixed(program);
  matrix_.resize(size_, size_);
  right_hand_side_.resize(size_);
  const auto kept = static_cast<Eigen::Index>(kept_.size());
  reduced_.resize(kept, kept);
}

void BoundarySystem::number_unknowns(const IntervalEntries& entries) {
  const auto single = [&](std::size_t end) {
    for (const std::size_t unknown : entries.single_unknowns[end]) unknowns_.push_back({unknown, size_++});
  };
  for (int i = 0; i < node_; ++i) unknowns_.push_back({entries.node_unknowns[static_cast<std::size_t>(i)], i});
  for (std::size_t i = 0; i < entries.shared_unknowns.size(); ++i) {
    unknowns_.push_back({entries.shared_unknowns[i], node_ + node_sums_ + static_cast<Eigen::Index>(i)});
  }
  size_ = state_size_;
  single(0);
  last_state_ = size_;
  for (int i = 0; i < node_; ++i) {
    last_unknowns_.push_back({entries.node_unknowns[static_cast<std::size_t>(i)] + entries.intervals, last_state_ + i});
  }
  size_ += state_size_;
  single(1);
}

void BoundarySystem::number_rows(const IntervalEntries& entries) {
  first_row_ = size_;
  multiplier_at_ = size_;
  carry_at_ = multiplier_at_ + state_size_;
  last_rows_ = carry_at_ + node_sums_;
  size_ = last_rows_ + node_sums_;
  for (int i = 0; i < node_sums_; ++i) {
    const std::size_t first = entries.node_rows[static_cast<std::size_t>(i)];
    first_rows_.push_back({first, carry_at_ + i});
    rows_.push_back({first + entries.intervals, last_rows_ + i});
  }
  for (const std::size_t row : entries.single_rows) rows_.push_back({row, size_++});
}

void BoundarySystem::place(const IntervalEntries& entries) {
  std::map<std::size_t, Eigen::Index> unknown_at;
  std::map<std::size_t, Eigen::Index> row_at;
  for (const auto& list : {unknowns_, last_unknowns_}) {
    for (const Binding& bound : list) unknown_at[bound.number] = bound.at;
  }
  for (const auto& list : {first_rows_, rows_}) {
    for (const Binding& bound : list) row_at[bound.number] = bound.at;
  }
  const auto look_up = [](const std::map<std::size_t, Eigen::Index>& places, std::size_t number) {
    const auto found = places.find(number);
    if (found == places.end()) throw Error("an entry of the ends belongs to neither of them");
    return found->second;
  };
  for (const EndEntry& entry : entries.ends) {
    const bool is_row = entry.source == Source::jacobian;
    const Eigen::Index row = look_up(is_row ? row_at : unknown_at, entry.row);
    const Eigen::Index column = look_up(unknown_at, entry.column);
    const bool defines_carry = is_row && row >= carry_at_ && row < last_rows_;
    placed_.push_back(
        {entry.source, entry.entry, std::max(row, column), std::min(row, column), defines_carry ? -1.0 : 1.0});
  }
}

void BoundarySystem::drop_what_is_fixed(const NonlinearProgram& program) {
  std::vector<bool> moves(static_cast<std::size_t>(size_), true);
  const auto drop = [&](Eigen::Index at) { moves[static_cast<std::size_t>(at)] = false; };
  for (const auto& list : {unknowns_, last_unknowns_}) {
    for (const Binding& bound : list) {
      const auto i = static_cast<Eigen::Index>(bound.number);
      if (program.variable_lower()[i] == program.variable_upper()[i]) drop(bound.at);
    }
  }
  // Where nothing but the first interval is in the rows of the first node, s_0 is zero.
  const bool nothing_carried = std::none_of(placed_.begin(), placed_.end(), [&](const Placed& entry) {
    return entry.row >= carry_at_ && entry.row < last_rows_;
  });
  for (Eigen::Index i = 0; i < node_sums_ && nothing_carried; ++i) {
    drop(node_ + i);
    drop(carry_at_ + i);
  }
  for (Eigen::Index i = 0; i < size_; ++i) {
    if (moves[static_cast<std::size_t>(i)]) kept_.push_back(i);
  }
}

void BoundarySystem::assemble(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                              const Horizon& horizon) {
  const Eigen::Index n = state_size_;
  matrix_.setZero();
  right_hand_side_.setZero();
  matrix_.topLeftCorner(n, n) = horizon.value.P;
  matrix_.block(multiplier_at_, 0, n, n) = horizon.value.Phi.transpose();
  matrix_.block(multiplier_at_, multiplier_at_, n, n) = -horizon.value.Gamma;
  matrix_.block(multiplier_at_, last_state_, n, n) = -Eigen::MatrixXd::Identity(n, n);
  matrix_.block(last_state_, last_state_, n, n).diagonal() = -horizon.terminal_weights;
  matrix_.block(carry_at_, node_, node_sums_, node_sums_).setIdentity();
  matrix_.block(last_rows_, last_state_ + node_, node_sums_, node_sums_).setIdentity();
  matrix_.block(last_rows_, last_state_, node_sums_, node_) += horizon.last_carry;
  right_hand_side_.head(n) = -horizon.value.p;
  right_hand_side_.segment(multiplier_at_, n) = -horizon.value.gamma;
  for (const Placed& entry : placed_) {
    const Eigen::VectorXd& values = entry.source == Source::jacobian ? matrix.jacobian : matrix.hessian;
    matrix_(entry.row, entry.column) += entry.sign * value_at(values, entry.entry);
  }
  for (const Binding& unknown : unknowns_) {
    matrix_(unknown.at, unknown.at) += value_at(matrix.diagonal, unknown.number);
    right_hand_side_[unknown.at] -= value_at(right_hand_side.gradient, unknown.number);
  }
  for (const Binding& row : rows_) {
    matrix_(row.at, row.at) -= matrix.compliance_of(static_cast<Eigen::Index>(row.number));
    right_hand_side_[row.at] -= value_at(right_hand_side.constraints, row.number);
  }
}

FactorisationStatus BoundarySystem::factorise_and_solve() {
  reduced_ = matrix_(kept_, kept_);
  Eigen::VectorXd reduced_solution = right_hand_side_(kept_);
  const DenseInertia inertia = solve_symmetric(reduced_, reduced_solution);
  is_certain_ = inertia.is_certain;
  if (inertia.is_singular) return FactorisationStatus::singular;
  const auto wanted = std::count_if(kept_.begin(), kept_.end(), [&](Eigen::Index at) { return at >= first_row_; });
  if (inertia.negative != wanted) return FactorisationStatus::wrong_inertia;
  solution_.setZero(size_);
  solution_(kept_) = reduced_solution;
  return FactorisationStatus::solved;
}

FactorisationStatus BoundarySystem::solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                          const Horizon& horizon) {
  assemble(matrix, right_hand_side, horizon);
  const FactorisationStatus status = factorise_and_solve();
  if (status != FactorisationStatus::solved) return status;
  state_ = solution_.head(state_size_);
  multiplier_ = solution_.segment(multiplier_at_, state_size_);
  return status;
}

void BoundarySystem::write(const KktStep& step) const {
  for (const auto& list : {unknowns_, last_unknowns_}) {
    for (const Binding& unknown : list) step.primal[static_cast<Eigen::Index>(unknown.number)] = solution_[unknown.at];
  }
  for (const Binding& row : rows_) step.multipliers[static_cast<Eigen::Index>(row.number)] = solution_[row.at];
}

}  // namespace dmocbench::interior_point
