#include "methods/solvers/kkt/intervals/segment_chain.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace dmocbench::kkt {

namespace {

/// L with Γ = LLᵀ for a matrix that is positive semidefinite up to rounding: a pivot that has vanished leaves a column
/// of zeros.
template <int size>
Eigen::Matrix<double, size, size> semidefinite_factor(const Eigen::Matrix<double, size, size>& gamma) {
  const Eigen::Index n = gamma.rows();
  Eigen::Matrix<double, size, size> factor = Eigen::Matrix<double, size, size>::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double pivot = gamma(j, j) - factor.row(j).head(j).squaredNorm();
    if (!(pivot > static_cast<double>(n) * std::numeric_limits<double>::epsilon() * gamma(j, j))) continue;
    factor(j, j) = std::sqrt(pivot);
    for (Eigen::Index i = j + 1; i < n; ++i) {
      factor(i, j) = (gamma(i, j) - factor.row(i).head(j).dot(factor.row(j).head(j))) / factor(j, j);
    }
  }
  return factor;
}

/// Column by column: for matrices of right-hand sides, Eigen begins with memory for blocks.
template <class System, class Matrix>
Matrix solve_columns(const System& system, const Matrix& right_hand_sides) {
  using Vector = Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1>;
  Matrix solution(right_hand_sides.rows(), right_hand_sides.cols());
  for (Eigen::Index j = 0; j < right_hand_sides.cols(); ++j) {
    const Vector column = right_hand_sides.col(j);
    solution.col(j) = system.solve(column);
  }
  return solution;
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
}

bool SegmentChain::join(const SegmentValue& segment) {
  // A size that the compiler knows needs no memory from the heap, which would take longer than the arithmetic. Every
  // further size costs compile time.
  constexpr int usual = 4;
  return total_.P.rows() == usual ? join_sized<usual>(segment) : join_sized<Eigen::Dynamic>(segment);
}

template <int size>
bool SegmentChain::join_sized(const SegmentValue& segment) {
  using Matrix = Eigen::Matrix<double, size, size>;
  using Vector = Eigen::Matrix<double, size, 1>;
  const Eigen::Index n = total_.P.rows();
  const Matrix identity = Matrix::Identity(n, n);
  const Matrix reachability = segment.Gamma;
  const Matrix Phi = segment.Phi;
  const Matrix mixed = total_.Phi;
  const Vector constant = total_.p;
  Matrix stiffness = total_.P;
  stiffness.diagonal() -= terminal_weights_;
  // The state y between and the multiplier ν' of the segment in front make (stiffness, -I; -I, -Γ): two such blocks
  // have the inertia of a minimum exactly if I + Lᵀ stiffness L is positive definite.
  const Matrix factor = semidefinite_factor<size>(reachability);
  if (Eigen::LLT<Matrix>(identity + factor.transpose() * stiffness * factor).info() != Eigen::Success) return false;
  const Eigen::PartialPivLU<Matrix> system(identity + reachability * stiffness);
  const Matrix state_state = solve_columns<decltype(system), Matrix>(system, Phi.transpose());
  const Matrix state_multiplier = -solve_columns<decltype(system), Matrix>(system, reachability * mixed);
  const Vector state_constant = system.solve(segment.gamma - reachability * constant);

  const Vector gamma = mixed.transpose() * state_constant;
  const Vector p = Phi * (stiffness * state_constant + constant);
  total_.gamma += gamma;
  total_.Gamma = symmetric_part<Matrix>(total_.Gamma - mixed.transpose() * state_multiplier);
  total_.p = segment.p + p;
  total_.Phi = Phi * (mixed + stiffness * state_multiplier);
  total_.P = symmetric_part<Matrix>(segment.P + Phi * stiffness * state_state);
  if (joins_.size() <= count_) joins_.emplace_back();
  Join& join = joins_[count_++];
  join.state_state = state_state;
  join.state_multiplier = state_multiplier;
  join.state_constant = state_constant;
  join.stiffness = stiffness;
  join.mixed = mixed;
  join.constant = constant;
  return true;
}

void SegmentChain::back_substitute(const Eigen::VectorXd& state, const Eigen::VectorXd& multiplier,
                                   Eigen::MatrixXd& states, Eigen::MatrixXd& multipliers) const {
  states.resize(state.size(), static_cast<Eigen::Index>(count_) + 1);
  multipliers.resizeLike(states);
  states.col(0) = state;
  for (std::size_t s = 0; s < count_; ++s) {
    const Join& join = joins_[count_ - 1 - s];
    const auto column = static_cast<Eigen::Index>(s);
    states.col(column + 1) =
        join.state_state * states.col(column) + join.state_multiplier * multiplier + join.state_constant;
    multipliers.col(column) = join.stiffness * states.col(column + 1) + join.mixed * multiplier + join.constant;
  }
  multipliers.rightCols(1) = multiplier;
}

}  // namespace dmocbench::kkt
