#include "methods/kkt/intervals/boundary_system.hpp"

#include <algorithm>
#include <map>

namespace dmocbench::kkt {

BoundarySystem::Made BoundarySystem::make(const NonlinearProgram& program, const IntervalEntries& entries) {
  BoundarySystem system(entries);
  if (!system.place(entries))
    return tl::unexpected(std::string("an entry of the end conditions belongs to neither end"));
  system.drop_what_is_fixed(program);
  return system;
}

BoundarySystem::BoundarySystem(const IntervalEntries& entries)
    : state_size_(state_size(entries.shape)), node_(entries.shape.node), node_sums_(entries.shape.node_sums) {
  number_lines(entries);
  matrix_.resize(size_, size_);
  right_hand_side_.resize(size_);
}

void BoundarySystem::number_lines(const IntervalEntries& entries) {
  const auto append = [&](const std::vector<Eigen::Index>& numbers, std::vector<Binding>& list) {
    for (const Eigen::Index number : numbers) list.push_back({number, size_++});
  };
  append(entries.node_unknowns, unknowns_);
  size_ += node_sums_;
  append(entries.global_unknowns, unknowns_);
  append(entries.end_unknowns[0], unknowns_);
  last_state_ = size_;
  append(entries.node_unknowns, last_unknowns_);
  for (Binding& of_last_node : last_unknowns_) of_last_node.number += entries.intervals;
  size_ = last_state_ + state_size_;
  append(entries.end_unknowns[1], unknowns_);

  multiplier_at_ = size_;
  carry_at_ = multiplier_at_ + state_size_;
  last_rows_ = carry_at_ + node_sums_;
  size_ = last_rows_ + node_sums_;
  for (Eigen::Index i = 0; i < node_sums_; ++i) {
    const Eigen::Index first = entries.equality_rows[static_cast<std::size_t>(i)];
    first_rows_.push_back({first, carry_at_ + i});
    rows_.push_back({first + entries.intervals, last_rows_ + i});
  }
  append(entries.end_rows, rows_);
}

/// Places the entries in turn; false at the first that belongs to neither end.
bool BoundarySystem::place(const IntervalEntries& entries) {
  using Lines = std::map<Eigen::Index, Eigen::Index>;
  const auto lines_of = [](const auto&... lists) {
    Lines lines;
    for (const auto* list : {&lists...}) {
      for (const Binding& binding : *list) lines[binding.number] = binding.at;
    }
    return lines;
  };
  const Lines unknown_at = lines_of(unknowns_, last_unknowns_);
  const Lines row_at = lines_of(first_rows_, rows_);
  return std::ranges::all_of(entries.ends, [&](const EndEntry& entry) {
    const bool is_row = entry.source == Source::jacobian;
    const Lines& lines = is_row ? row_at : unknown_at;
    const auto row = lines.find(entry.row);
    const auto column = unknown_at.find(entry.column);
    if (row == lines.end() || column == unknown_at.end()) return false;
    const auto [lower, upper] = std::minmax(row->second, column->second);
    const double sign = is_row && defines_carry(row->second) ? -1.0 : 1.0;
    placed_.push_back({entry.source, entry.entry, upper, lower, sign});
    return true;
  });
}

void BoundarySystem::drop_what_is_fixed(const NonlinearProgram& program) {
  std::vector<bool> moves(static_cast<std::size_t>(size_), true);
  const auto drop = [&](Eigen::Index at) { moves[static_cast<std::size_t>(at)] = false; };
  for (const auto* list : {&unknowns_, &last_unknowns_}) {
    for (const auto& [number, at] : *list) {
      if (is_fixed(program, number)) drop(at);
    }
  }
  // Where nothing but the first interval is in the rows of the first node, s_0 is zero.
  const bool nothing_carried =
      std::ranges::none_of(placed_, [&](const Placed& entry) { return defines_carry(entry.row); });
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
    matrix_(entry.row, entry.column) += entry.sign * values[entry.entry];
  }
  for (const auto& [number, at] : unknowns_) {
    matrix_(at, at) += matrix.diagonal[number];
    right_hand_side_[at] -= right_hand_side.gradient[number];
  }
  for (const auto& [number, at] : rows_) {
    matrix_(at, at) -= matrix.compliance_of(number);
    right_hand_side_[at] -= right_hand_side.constraints[number];
  }
}

FactorisationStatus BoundarySystem::solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                          const Horizon& horizon) {
  assemble(matrix, right_hand_side, horizon);
  const auto count = static_cast<Eigen::Index>(kept_.size());
  reduced_.resize(count, count);
  reduced_solution_.resize(count);
  const auto kept = [&](Eigen::Index i) { return kept_[static_cast<std::size_t>(i)]; };
  Eigen::Index rows = 0;
  for (Eigen::Index j = 0; j < count; ++j) {
    for (Eigen::Index i = 0; i < count; ++i) reduced_(i, j) = matrix_(kept(i), kept(j));
    reduced_solution_[j] = right_hand_side_[kept(j)];
    if (kept(j) >= multiplier_at_) ++rows;
  }
  const DenseInertia inertia = solve_symmetric(reduced_, reduced_solution_, work_);
  is_certain_ = inertia.is_certain;
  if (inertia.is_singular) return FactorisationStatus::singular;
  if (inertia.negative + horizon.negative != rows) return FactorisationStatus::wrong_inertia;
  solution_.setZero(size_);
  for (Eigen::Index j = 0; j < count; ++j) solution_[kept(j)] = reduced_solution_[j];
  state_ = solution_.head(state_size_);
  multiplier_ = solution_.segment(multiplier_at_, state_size_);
  return FactorisationStatus::solved;
}

void BoundarySystem::write(const KktStep& step) const {
  for (const auto* list : {&unknowns_, &last_unknowns_}) {
    for (const auto& [number, at] : *list) step.primal[number] = solution_[at];
  }
  for (const auto& [number, at] : rows_) step.multipliers[number] = solution_[at];
}

}  // namespace dmocbench::kkt
