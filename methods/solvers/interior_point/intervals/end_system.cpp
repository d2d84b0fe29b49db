#include "methods/solvers/interior_point/intervals/end_system.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "methods/error.hpp"
#include "methods/solvers/interior_point/intervals/symmetric_solve.hpp"

namespace dmocbench::interior_point {

namespace {

double value_at(const Eigen::VectorXd& vector, std::size_t i) { return vector[static_cast<Eigen::Index>(i)]; }

}  // namespace

EndSystem::EndSystem(const NonlinearProgram& program, const IntervalEntries& entries)
    : state_size_(state_size(entries.shape)), node_(entries.shape.node), carried_(entries.shape.carried) {
  number_unknowns(entries);
  number_rows(entries);
  place(entries);
  keep_what_moves(program);
  matrix_.resize(size_, size_);
  right_hand_side_.resize(size_);
  const auto kept = static_cast<Eigen::Index>(kept_.size());
  reduced_.resize(kept, kept);
}

void EndSystem::number_unknowns(const IntervalEntries& entries) {
  const auto single = [&](std::size_t end) {
    for (const std::size_t unknown : entries.single_unknowns[end]) unknowns_.push_back({unknown, size_++});
  };
  for (int i = 0; i < node_; ++i) unknowns_.push_back({entries.node_unknowns[static_cast<std::size_t>(i)], i});
  for (std::size_t i = 0; i < entries.shared_unknowns.size(); ++i) {
    unknowns_.push_back({entries.shared_unknowns[i], node_ + carried_ + static_cast<Eigen::Index>(i)});
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

void EndSystem::number_rows(const IntervalEntries& entries) {
  first_row_ = size_;
  multiplier_at_ = size_;
  carry_at_ = multiplier_at_ + state_size_;
  last_rows_ = carry_at_ + carried_;
  size_ = last_rows_ + carried_;
  for (int i = 0; i < carried_; ++i) {
    const std::size_t first = entries.node_rows[static_cast<std::size_t>(i)];
    first_rows_.push_back({first, carry_at_ + i});
    rows_.push_back({first + entries.intervals, last_rows_ + i});
  }
  for (const std::size_t row : entries.single_rows) rows_.push_back({row, size_++});
}

void EndSystem::place(const IntervalEntries& entries) {
  std::map<std::size_t, Eigen::Index> unknown_at;
  std::map<std::size_t, Eigen::Index> row_at;
  for (const auto& list : {unknowns_, last_unknowns_}) {
    for (const Bound& bound : list) unknown_at[bound.number] = bound.at;
  }
  for (const auto& list : {first_rows_, rows_}) {
    for (const Bound& bound : list) row_at[bound.number] = bound.at;
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

void EndSystem::keep_what_moves(const NonlinearProgram& program) {
  std::vector<bool> moves(static_cast<std::size_t>(size_), true);
  const auto drop = [&](Eigen::Index at) { moves[static_cast<std::size_t>(at)] = false; };
  for (const auto& list : {unknowns_, last_unknowns_}) {
    for (const Bound& bound : list) {
      const auto i = static_cast<Eigen::Index>(bound.number);
      if (program.variable_lower()[i] == program.variable_upper()[i]) drop(bound.at);
    }
  }
  // Where nothing but the first interval is in the rows of the first node, s_0 is zero.
  const bool nothing_carried = std::none_of(placed_.begin(), placed_.end(), [&](const Placed& entry) {
    return entry.row >= carry_at_ && entry.row < last_rows_;
  });
  for (Eigen::Index i = 0; i < carried_ && nothing_carried; ++i) {
    drop(node_ + i);
    drop(carry_at_ + i);
  }
  for (Eigen::Index i = 0; i < size_; ++i) {
    if (moves[static_cast<std::size_t>(i)]) kept_.push_back(i);
  }
}

void EndSystem::assemble(const KktMatrix& matrix, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                         const SegmentValue& horizon, const Eigen::MatrixXd& last_carry,
                         const Eigen::VectorXd& terminal_weights) {
  const Eigen::Index n = state_size_;
  matrix_.setZero();
  right_hand_side_.setZero();
  matrix_.topLeftCorner(n, n) = horizon.P;
  matrix_.block(multiplier_at_, 0, n, n) = horizon.Phi.transpose();
  matrix_.block(multiplier_at_, multiplier_at_, n, n) = -horizon.Gamma;
  matrix_.block(multiplier_at_, last_state_, n, n) = -Eigen::MatrixXd::Identity(n, n);
  matrix_.block(last_state_, last_state_, n, n).diagonal() = -terminal_weights;
  matrix_.block(carry_at_, node_, carried_, carried_).setIdentity();
  matrix_.block(last_rows_, last_state_ + node_, carried_, carried_).setIdentity();
  matrix_.block(last_rows_, last_state_, carried_, node_) += last_carry;
  right_hand_side_.head(n) = -horizon.p;
  right_hand_side_.segment(multiplier_at_, n) = -horizon.gamma;
  for (const Placed& entry : placed_) {
    const Eigen::VectorXd& values = entry.source == Source::jacobian ? matrix.jacobian : matrix.hessian;
    matrix_(entry.row, entry.column) += entry.sign * value_at(values, entry.entry);
  }
  for (const Bound& unknown : unknowns_) {
    matrix_(unknown.at, unknown.at) += value_at(matrix.diagonal, unknown.number);
    right_hand_side_[unknown.at] -= value_at(slope, unknown.number);
  }
  for (const Bound& row : rows_) {
    matrix_(row.at, row.at) -= matrix.compliance_of(static_cast<Eigen::Index>(row.number));
    right_hand_side_[row.at] -= value_at(rows, row.number);
  }
}

FactorisationStatus EndSystem::factorise_and_solve() {
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

FactorisationStatus EndSystem::solve(const KktMatrix& matrix, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                                     const SegmentValue& horizon, const Eigen::MatrixXd& last_carry,
                                     const Eigen::VectorXd& terminal_weights) {
  assemble(matrix, slope, rows, horizon, last_carry, terminal_weights);
  const FactorisationStatus verdict = factorise_and_solve();
  if (verdict != FactorisationStatus::solved) return verdict;
  state_ = solution_.head(state_size_);
  multiplier_ = solution_.segment(multiplier_at_, state_size_);
  return verdict;
}

void EndSystem::write(Eigen::VectorXd& primal_step, Eigen::VectorXd& multiplier_step) const {
  for (const auto& list : {unknowns_, last_unknowns_}) {
    for (const Bound& unknown : list) primal_step[static_cast<Eigen::Index>(unknown.number)] = solution_[unknown.at];
  }
  for (const Bound& row : rows_) multiplier_step[static_cast<Eigen::Index>(row.number)] = solution_[row.at];
}

}  // namespace dmocbench::interior_point
