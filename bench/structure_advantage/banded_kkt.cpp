#include "bench/structure_advantage/banded_kkt.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <lapacke.h>

#include "methods/runtime/long_vectors.hpp"
#include "methods/solvers/linearisation.hpp"

namespace dmocbench::interior_point {

namespace {

constexpr Eigen::Index the_step = 0;
constexpr Eigen::Index the_tangential_step = 1;
constexpr Eigen::Index steps = 2;

lapack_int lapack(std::size_t number) { return static_cast<lapack_int>(number); }

}  // namespace

BandedKkt::BandedKkt(const NonlinearProgram& program)
    : program_(program),
      order_(node_order(program)),
      hessian_pattern_(program.hessian_structure().expand()),
      jacobian_pattern_(program.jacobian_structure().expand()),
      is_free_(free_variables(program)),
      leading_(3 * order_.half_bandwidth + 1) {
  const auto size = static_cast<Eigen::Index>(order_.band_size);
  const auto border = static_cast<Eigen::Index>(order_.border_size);
  band_.resize(leading_ * order_.band_size);
  exchanged_.resize(order_.band_size);
  border_.resize(size, border);
  corner_.resize(border, border);
  sides_.resize(size, steps + border);
  corner_sides_.resize(border, steps);
  tangential_.resize(static_cast<Eigen::Index>(program.variable_count()));
  tangential_multipliers_.resize(static_cast<Eigen::Index>(program.constraint_count()));
  unknown_products_.resize(tangential_.size());
  row_products_.resize(tangential_multipliers_.size());
  find_targets();
}

/// LAPACK stores entry (i, j) of a band at row kl + ku + i - j of column j; the first kl rows are for what exchanging
/// rows fills in. Null in the lower left: of the border and its mirror image one is kept.
double* BandedKkt::place_of(std::size_t first, std::size_t second) {
  const NodeOrder::Line i = order_.place(first, second);
  const NodeOrder::Line j = order_.place(second, first);
  if (!i.in_border && !j.in_border) return band_entry(i.at, j.at);
  if (i.in_border && !j.in_border) return nullptr;
  Eigen::MatrixXd& block = i.in_border ? corner_ : border_;
  return &block(static_cast<Eigen::Index>(i.at), static_cast<Eigen::Index>(j.at));
}

double* BandedKkt::band_entry(std::size_t row, std::size_t column) {
  return &band_[2 * order_.half_bandwidth + row - column + column * leading_];
}

BandedKkt::Target BandedKkt::target_of(std::size_t entry, std::size_t row, std::size_t column) {
  double* const at = place_of(row, column);
  double* const mirror = row == column ? nullptr : place_of(column, row);
  return at == nullptr ? Target{entry, mirror, nullptr} : Target{entry, at, mirror};
}

void BandedKkt::find_targets() {
  const SparsityPattern& hessian = hessian_pattern_;
  const SparsityPattern& jacobian = jacobian_pattern_;
  const std::size_t unknowns = program_.variable_count();
  const auto is_free = [&](int unknown) { return is_free_[static_cast<std::size_t>(unknown)]; };
  for (std::size_t e = 0; e < hessian.size(); ++e) {
    if (!is_free(hessian.rows[e]) || !is_free(hessian.columns[e])) continue;
    hessian_.push_back(
        target_of(e, static_cast<std::size_t>(hessian.rows[e]), static_cast<std::size_t>(hessian.columns[e])));
  }
  for (std::size_t e = 0; e < jacobian.size(); ++e) {
    if (!is_free(jacobian.columns[e])) continue;
    jacobian_.push_back(target_of(e, unknowns + static_cast<std::size_t>(jacobian.rows[e]),
                                  static_cast<std::size_t>(jacobian.columns[e])));
  }
  for (const NodeOrder::Copies& copies : order_.copies) {
    for (std::size_t k = 0; k < copies.ties.size(); ++k) {
      for (const std::size_t which : {k, k + 1}) {
        const double value = which == k ? -1.0 : 1.0;
        ties_.push_back({band_entry(copies.ties[k], copies.of_intervals[which]), value});
        ties_.push_back({band_entry(copies.of_intervals[which], copies.ties[k]), value});
      }
    }
  }
  for (std::size_t line = 0; line < order_.lines.size(); ++line) diagonal_.push_back(place_of(line, line));
}

void BandedKkt::assemble(const KktMatrix& matrix) {
  std::fill(band_.begin(), band_.end(), 0.0);
  border_.setZero();
  corner_.setZero();
  const auto put = [](const std::vector<Target>& targets, const Eigen::VectorXd& values) {
    for (const Target& target : targets) {
      const double value = values[static_cast<Eigen::Index>(target.entry)];
      *target.at = value;
      if (target.mirror != nullptr) *target.mirror = value;
    }
  };
  put(hessian_, matrix.hessian);
  put(jacobian_, matrix.jacobian);
  for (const Tie& tie : ties_) *tie.at = tie.value;
  const std::size_t unknowns = is_free_.size();
  for (std::size_t i = 0; i < unknowns; ++i) {
    *diagonal_[i] += is_free_[i] ? matrix.diagonal[static_cast<Eigen::Index>(i)] : 1.0;
  }
  for (std::size_t i = unknowns; i < diagonal_.size(); ++i) {
    *diagonal_[i] -= matrix.compliance_of(static_cast<Eigen::Index>(i - unknowns));
  }
}

bool BandedKkt::factorise() {
  const lapack_int size = lapack(order_.band_size);
  const lapack_int width = lapack(order_.half_bandwidth);
  return LAPACKE_dgbtrf_work(LAPACK_COL_MAJOR, size, size, width, width, band_.data(), lapack(leading_),
                             exchanged_.data()) == 0;
}

double BandedKkt::factorisation_operations() const {
  // The loops of dgbtf2: column j is divided by its pivot and subtracted from those up to the last one that a row
  // exchanged so far reaches. dgbtrf does the same by blocks.
  const auto size = static_cast<long long>(order_.band_size);
  const auto width = static_cast<long long>(order_.half_bandwidth);
  long long last_column = 0;
  double count = 0.0;
  for (long long j = 0; j < size; ++j) {
    const long long below = std::min(width, size - 1 - j);
    const long long pivot_row = exchanged_[static_cast<std::size_t>(j)] - 1;  // LAPACK counts from 1
    last_column = std::max(last_column, std::min(pivot_row + width, size - 1));
    count += static_cast<double>(below) * static_cast<double>(1 + last_column - j);
  }
  return count;
}

void BandedKkt::write_right_hand_sides(const Eigen::VectorXd& slope, const Eigen::VectorXd& rows) {
  sides_.leftCols(steps).setZero();
  sides_.rightCols(border_.cols()) = border_;
  const auto put = [&](std::size_t line, Eigen::Index side, double value) {
    const NodeOrder::Line to = order_.lines[line];
    (to.in_border ? corner_sides_ : sides_)(static_cast<Eigen::Index>(to.at), side) = value;
  };
  for (std::size_t i = 0; i < is_free_.size(); ++i) {
    const double value = is_free_[i] ? -slope[static_cast<Eigen::Index>(i)] : 0.0;
    put(i, the_step, value);
    put(i, the_tangential_step, value);
  }
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const std::size_t line = is_free_.size() + static_cast<std::size_t>(i);
    put(line, the_step, -rows[i]);
    put(line, the_tangential_step, 0.0);
  }
}

/// (A, B; Bᵀ, C)(y, z) = (a, c) with the band A factorised: z from the Schur complement of A, then y.
bool BandedKkt::substitute() {
  const lapack_int width = lapack(order_.half_bandwidth);
  const auto sides = static_cast<lapack_int>(sides_.cols());
  const lapack_int failed =
      LAPACKE_dgbtrs_work(LAPACK_COL_MAJOR, 'N', lapack(order_.band_size), width, width, sides, band_.data(),
                          lapack(leading_), exchanged_.data(), sides_.data(), lapack(order_.band_size));
  if (failed != 0) return false;
  if (border_.cols() == 0) return true;
  const auto of_border = sides_.rightCols(border_.cols());
  const Eigen::MatrixXd complement = corner_ - border_.transpose() * of_border;
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(complement);
  corner_sides_ = factors.solve(corner_sides_ - border_.transpose() * sides_.leftCols(steps)).eval();
  sides_.leftCols(steps) -= of_border * corner_sides_;
  return true;
}

void BandedKkt::read_step(Eigen::Index side, Eigen::VectorXd& primal_step, Eigen::VectorXd& multiplier_step) const {
  const auto get = [&](std::size_t line) {
    const NodeOrder::Line from = order_.lines[line];
    return (from.in_border ? corner_sides_ : sides_)(static_cast<Eigen::Index>(from.at), side);
  };
  for (std::size_t i = 0; i < is_free_.size(); ++i) primal_step[static_cast<Eigen::Index>(i)] = get(i);
  for (Eigen::Index i = 0; i < multiplier_step.size(); ++i) {
    multiplier_step[i] = get(is_free_.size() + static_cast<std::size_t>(i));
  }
}

/// The matrix times (primal, multipliers); fixed unknowns neither move nor have a line of their own.
void BandedKkt::multiply(const KktMatrix& matrix, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers) {
  unknown_products_ = matrix.diagonal.cwiseProduct(primal);
  row_products_.setZero(multipliers.size());
  if (matrix.compliance.size() > 0) row_products_ -= matrix.compliance.cwiseProduct(multipliers);
  const SparsityPattern& hessian = hessian_pattern_;
  for (const Target& target : hessian_) {
    const int i = hessian.rows[target.entry];
    const int j = hessian.columns[target.entry];
    const double value = matrix.hessian[static_cast<Eigen::Index>(target.entry)];
    unknown_products_[i] += value * primal[j];
    if (i != j) unknown_products_[j] += value * primal[i];
  }
  const SparsityPattern& jacobian = jacobian_pattern_;
  for (const Target& target : jacobian_) {
    const int i = jacobian.rows[target.entry];
    const int j = jacobian.columns[target.entry];
    const double value = matrix.jacobian[static_cast<Eigen::Index>(target.entry)];
    row_products_[i] += value * primal[j];
    unknown_products_[j] += value * multipliers[i];
  }
}

bool BandedKkt::curves_upwards(const KktMatrix& matrix) {
  constexpr double smallest_curvature = 1e-12;
  tangential_multipliers_.setZero();
  multiply(matrix, tangential_, tangential_multipliers_);
  double curvature = tangential_.dot(unknown_products_);
  for (Eigen::Index i = 0; i < row_products_.size(); ++i) {
    const double compliance = matrix.compliance_of(i);
    if (compliance > 0.0) curvature += row_products_[i] * row_products_[i] / compliance;
  }
  return curvature >= smallest_curvature * tangential_.squaredNorm();
}

bool BandedKkt::is_solution(const KktMatrix& matrix, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                            const Eigen::VectorXd& primal_step, const Eigen::VectorXd& multiplier_step) {
  constexpr double largest_share = 1e-9;  // of the right-hand side
  multiply(matrix, primal_step, multiplier_step);
  double left = rows.size() > 0 ? (row_products_ + rows).lpNorm<Eigen::Infinity>() : 0.0;
  double size = rows.size() > 0 ? rows.lpNorm<Eigen::Infinity>() : 0.0;
  for (std::size_t i = 0; i < is_free_.size(); ++i) {
    if (!is_free_[i]) continue;
    const auto at = static_cast<Eigen::Index>(i);
    left = std::max(left, std::abs(unknown_products_[at] + slope[at]));
    size = std::max(size, std::abs(slope[at]));
  }
  return left <= largest_share * size;
}

FactorisationStatus BandedKkt::solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                     const KktStep& step) {
  const auto& [slope, rows] = right_hand_side;
  const auto& [primal_step, multiplier_step] = step;
  const bool has_border = order_.border_size > 0;
  assemble(matrix);
  if (!factorise()) return has_border ? FactorisationStatus::untrusted : FactorisationStatus::singular;
  write_right_hand_sides(slope, rows);
  if (!substitute()) return FactorisationStatus::singular;
  read_step(the_tangential_step, tangential_, tangential_multipliers_);
  if (!is_finite(tangential_)) return FactorisationStatus::singular;
  if (!curves_upwards(matrix)) return FactorisationStatus::wrong_inertia;
  read_step(the_step, primal_step, multiplier_step);
  if (!is_finite(primal_step) || !is_finite(multiplier_step)) return FactorisationStatus::singular;
  if (has_border && !is_solution(matrix, slope, rows, primal_step, multiplier_step))
    return FactorisationStatus::untrusted;
  return FactorisationStatus::solved;
}

}  // namespace dmocbench::interior_point
