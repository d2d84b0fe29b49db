#include "methods/kkt/intervals/segment_chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <lapacke.h>

namespace dmocbench::kkt {

namespace {

static_assert(std::is_same_v<lapack_int, int>);

/// Multiplies rows and columns, given by the lower triangle, by factors that bring the largest entries near 1.
void equilibrate(Eigen::MatrixXd& lower, Eigen::VectorXd& factors) {
  const Eigen::Index n = lower.rows();
  factors.setZero(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j; i < n; ++i) {
      factors[i] = std::max(factors[i], std::abs(lower(i, j)));
      factors[j] = std::max(factors[j], std::abs(lower(i, j)));
    }
  }
  for (double& factor : factors) factor = factor > 0.0 ? 1.0 / std::sqrt(factor) : 1.0;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j; i < n; ++i) lower(i, j) = factors[i] * lower(i, j) * factors[j];
  }
}

/// Smallest magnitude of the eigenvalues of a symmetric block (a, b; b, c).
double smallest_eigenvalue(double a, double b, double c) {
  const double largest = 0.5 * (std::abs(a + c) + std::hypot(a - c, 2.0 * b));
  return largest > 0.0 ? std::abs(a * c - b * b) / largest : 0.0;
}

/// Counts by the blocks of one or two rows of D; a block of two has one eigenvalue of either sign.
DenseInertia inertia_of(const Eigen::MatrixXd& factors, const std::vector<int>& pivots) {
  const Eigen::Index n = factors.rows();
  constexpr double far_from_zero = 1e-11;  // hundreds of times the rounding of dependent rows
  // Elimination turns a dependent row into a few units of rounding per row.
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

void SymmetricWork::make(Eigen::Index size) {
  constexpr Eigen::Index columns_at_once = 64;
  scale.resize(size);
  pivots.resize(static_cast<std::size_t>(size));
  numbers.resize(size * columns_at_once);
}

DenseInertia solve_symmetric(Eigen::MatrixXd& matrix, Eigen::VectorXd& right_hand_side, SymmetricWork& work) {
  const Eigen::Index n = matrix.rows();
  if (n == 0) return {.is_certain = true};
  if (!matrix.allFinite() || !right_hand_side.allFinite()) return {.is_singular = true};
  work.make(n);
  equilibrate(matrix, work.scale);
  right_hand_side.array() *= work.scale.array();
  // Not LAPACKE's usual functions, which allocate and look for NaN again.
  const auto order = static_cast<lapack_int>(n);
  const lapack_int info = LAPACKE_dsytrf_work(LAPACK_COL_MAJOR, 'L', order, matrix.data(), order, work.pivots.data(),
                                              work.numbers.data(), static_cast<lapack_int>(work.numbers.size()));
  if (info != 0) return {.is_singular = true};
  LAPACKE_dsytrs_work(LAPACK_COL_MAJOR, 'L', order, 1, matrix.data(), order, work.pivots.data(), right_hand_side.data(),
                      order);
  right_hand_side.array() *= work.scale.array();
  return inertia_of(matrix, work.pivots);
}

namespace {

/// L with Γ = LLᵀ for a matrix that is positive semidefinite up to rounding: a pivot that has vanished leaves a column
/// of zeros.
template <class Matrix>
Matrix semidefinite_factor(const Matrix& gamma) {
  const Eigen::Index n = gamma.rows();
  Matrix factor = Matrix::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    double pivot = gamma(j, j);
    for (Eigen::Index q = 0; q < j; ++q) pivot -= factor(j, q) * factor(j, q);
    if (!(pivot > static_cast<double>(n) * std::numeric_limits<double>::epsilon() * gamma(j, j))) continue;
    factor(j, j) = std::sqrt(pivot);
    const double reciprocal = 1.0 / factor(j, j);
    for (Eigen::Index i = j + 1; i < n; ++i) {
      double sum = gamma(i, j);
      for (Eigen::Index q = 0; q < j; ++q) sum -= factor(i, q) * factor(j, q);
      factor(i, j) = sum * reciprocal;
    }
  }
  return factor;
}

/// Factorises a symmetric matrix whose lower triangle is read and overwritten. A pivot that is NaN counts as positive.
template <class Matrix>
bool is_positive_definite(Matrix& lower) {
  const Eigen::Index n = lower.rows();
  for (Eigen::Index j = 0; j < n; ++j) {
    if (lower(j, j) <= 0.0) return false;
    const double reciprocal = 1.0 / lower(j, j);
    for (Eigen::Index k = j + 1; k < n; ++k) {
      const double factor = lower(k, j) * reciprocal;
      for (Eigen::Index i = k; i < n; ++i) lower(i, k) -= factor * lower(i, j);
    }
  }
  return true;
}

/// Solves for all right-hand sides, the rows of `sides`, by elimination with partial pivoting; both are overwritten.
/// (Eigen's own begins with memory for blocks.)
template <class Matrix, class Sides>
void solve_in_place(Matrix& system, Sides& sides) {
  const Eigen::Index n = system.rows();
  for (Eigen::Index p = 0; p < n; ++p) {
    Eigen::Index pivot = p;
    for (Eigen::Index i = p + 1; i < n; ++i) {
      if (std::abs(system(i, p)) > std::abs(system(pivot, p))) pivot = i;
    }
    if (pivot != p) {
      system.row(p).swap(system.row(pivot));
      sides.row(p).swap(sides.row(pivot));
    }
    const double reciprocal = 1.0 / system(p, p);
    for (Eigen::Index i = p + 1; i < n; ++i) {
      const double factor = system(i, p) * reciprocal;
      system.row(i) -= factor * system.row(p);
      sides.row(i) -= factor * sides.row(p);
    }
  }
  for (Eigen::Index p = n - 1; p >= 0; --p) {
    for (Eigen::Index q = p + 1; q < n; ++q) sides.row(p) -= system(p, q) * sides.row(q);
    sides.row(p) *= 1.0 / system(p, p);
  }
}

/// A product of matrices: by blocks if their size has no bound, else entry by entry, which then takes less time.
template <int most, class Left, class Right>
auto product(const Left& left, const Right& right) {
  if constexpr (most == Eigen::Dynamic) {
    return (left * right).eval();
  } else {
    return left.lazyProduct(right);
  }
}

template <class Matrix>
Matrix symmetric_part(const Matrix& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

}  // namespace

void SegmentChain::start(const SegmentValue& last, const Eigen::VectorXd& terminal_weights) {
  terminal_weights_ = terminal_weights;
  total_ = last;
  count_ = 0;
  negative_ = 0;
  // Allocated here so that `join_and_count` allocates nothing.
  const Eigen::Index both = 2 * last.P.rows();
  between_.resize(both, both);
  no_side_.resize(both);
  work_.make(both);
}

bool SegmentChain::join(const SegmentValue& segment) { return join(segment, Between::must_be_minimum); }

/// The state y between and the multiplier ν' of the segment in front make (S, -I; -I, -Γ). Measured by √ρ, both S and Γ
/// are about 1. A minimum has as many positive eigenvalues as negative ones.
bool SegmentChain::join_and_count(const SegmentValue& segment) {
  const Eigen::Index n = total_.P.rows();
  between_.setZero();
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j; i < n; ++i) {
      const double measure = std::sqrt(terminal_weights_[i] * terminal_weights_[j]);
      between_(i, j) = total_.P(i, j) / measure - (i == j ? 1.0 : 0.0);
      between_(n + i, n + j) = -segment.Gamma(i, j) * measure;
    }
    between_(n + j, j) = -1.0;
  }
  no_side_.setZero();
  const DenseInertia inertia = solve_symmetric(between_, no_side_, work_);
  if (!inertia.is_certain || inertia.is_singular) return false;
  negative_ += inertia.negative - n;
  return join(segment, Between::may_be_saddle);
}

bool SegmentChain::join(const SegmentValue& segment, Between between) {
  // A size known at compile time, or a bound of it, needs no memory from the heap, which would take longer than the
  // arithmetic. Every further size costs compile time.
  constexpr int most = 16;
  switch (const Eigen::Index n = total_.P.rows()) {
    case 4:
      return join_sized<4, 4>(segment, between);
    case 6:
      return join_sized<6, 6>(segment, between);
    case 8:
      return join_sized<8, 8>(segment, between);
    default:
      return n <= most ? join_sized<Eigen::Dynamic, most>(segment, between)
                       : join_sized<Eigen::Dynamic, Eigen::Dynamic>(segment, between);
  }
}

template <int size, int most>
bool SegmentChain::join_sized(const SegmentValue& segment, Between between) {
  // Columns (X, ν, 1), and one of zeros: an even number fills vector registers.
  constexpr int wide = size == Eigen::Dynamic ? Eigen::Dynamic : 2 * size + 2;
  constexpr int widest = most == Eigen::Dynamic ? Eigen::Dynamic : 2 * most + 2;
  // Row by row, as all of them: a product then fills vector registers along the rows of its right factor.
  using Matrix = Eigen::Matrix<double, size, size, Eigen::RowMajor, most, most>;
  using Vector = Eigen::Matrix<double, size, 1, 0, most, 1>;
  using Wide = Eigen::Matrix<double, size, wide, Eigen::RowMajor, most, widest>;
  const Eigen::Index n = total_.P.rows();
  const Matrix identity = Matrix::Identity(n, n);
  const Matrix reachability = segment.Gamma;
  const Matrix Phi = segment.Phi;
  const Matrix mixed = total_.Phi;
  const Vector constant = total_.p;
  Matrix stiffness = total_.P;
  stiffness.diagonal() -= terminal_weights_;
  if (between == Between::must_be_minimum) {
    // The state y between and the multiplier ν' of the segment in front make (stiffness, -I; -I, -Γ): two such blocks
    // have the inertia of a minimum exactly if I + Lᵀ stiffness L is positive definite.
    const auto factor = semidefinite_factor<Matrix>(reachability);
    const Matrix weighed = product<most>(stiffness, factor);
    Matrix form = identity + product<most>(factor.transpose(), weighed);
    if (!is_positive_definite(form)) return false;
  }
  // y as a function of (X, ν, 1).
  Matrix system = identity + product<most>(reachability, stiffness);
  Wide state(n, 2 * n + 2);
  state.leftCols(n) = Phi.transpose();
  state.middleCols(n, n) = -product<most>(reachability, mixed);
  state.col(2 * n) = segment.gamma - reachability.lazyProduct(constant);
  state.col(2 * n + 1).setZero();
  solve_in_place(system, state);
  const Matrix state_multiplier = state.middleCols(n, n);
  const Vector state_constant = state.col(2 * n);

  // ν' as a function of (X, ν, 1).
  Wide costate = product<most>(stiffness, state);
  costate.middleCols(n, n) += mixed;
  costate.col(2 * n) += constant;
  const Wide value = product<most>(Phi, costate);
  const Matrix Gamma = total_.Gamma - product<most>(mixed.transpose(), state_multiplier);
  total_.gamma += mixed.transpose().lazyProduct(state_constant);
  total_.Gamma = symmetric_part<Matrix>(Gamma);
  total_.p = segment.p + value.col(2 * n);
  total_.Phi = value.middleCols(n, n);
  total_.P = symmetric_part<Matrix>(segment.P + value.leftCols(n));
  if (joins_.size() <= count_) joins_.emplace_back();
  Join& join = joins_[count_++];
  join.state = state;
  join.stiffness = stiffness;
  join.mixed = mixed;
  join.constant = constant;
  return true;
}

void SegmentChain::back_substitute(const Eigen::VectorXd& state, const Eigen::VectorXd& multiplier,
                                   Eigen::MatrixXd& states, Eigen::MatrixXd& multipliers) const {
  const Eigen::Index n = state.size();
  states.resize(n, static_cast<Eigen::Index>(count_) + 1);
  multipliers.resizeLike(states);
  states.col(0) = state;
  for (std::size_t s = 0; s < count_; ++s) {
    const Join& join = joins_[count_ - 1 - s];
    const auto column = static_cast<Eigen::Index>(s);
    for (Eigen::Index i = 0; i < n; ++i) {
      double sum = join.state(i, 2 * n);
      for (Eigen::Index j = 0; j < n; ++j) sum += join.state(i, j) * states(j, column);
      for (Eigen::Index j = 0; j < n; ++j) sum += join.state(i, n + j) * multiplier[j];
      states(i, column + 1) = sum;
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      double sum = join.constant[i];
      for (Eigen::Index j = 0; j < n; ++j) sum += join.stiffness(i, j) * states(j, column + 1);
      for (Eigen::Index j = 0; j < n; ++j) sum += join.mixed(i, j) * multiplier[j];
      multipliers(i, column) = sum;
    }
  }
  multipliers.rightCols(1) = multiplier;
}

}  // namespace dmocbench::kkt
