#include "methods/solvers/interior_point/intervals/interval_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/error.hpp"
#include "methods/runtime/long_vectors.hpp"
#include "methods/runtime/parallel.hpp"

namespace dmocbench::interior_point {

namespace {

/// How small a pivot of the equalities may be, measured by those that the order of elimination was chosen by.
constexpr double smallest_ratio = 1e-7;

}  // namespace

IntervalKkt::Made IntervalKkt::make(const NonlinearProgram& program, SegmentKernelChoice choose) {
  auto entries = interval_entries(program);
  if (!entries) return tl::unexpected(std::move(entries).error());
  try {
    return std::make_unique<IntervalKkt>(program, std::move(*entries), choose);
  } catch (const Error& error) {
    return tl::unexpected(std::string(error.what()));
  }
}

IntervalKkt::IntervalKkt(const NonlinearProgram& program, IntervalEntries entries, SegmentKernelChoice choose)
    : entries_(std::move(entries)), boundary_(program, entries_), choose_(choose), weights_(entries_) {
  padded_.setZero(static_cast<Eigen::Index>(entries_.padded.size() * entries_.intervals));
  groups_ = cut_into_groups(entries_.shape, entries_.intervals);
}

NewtonArrays IntervalKkt::arrays_of(const KktMatrix& matrix, const KktRightHandSide& right_hand_side) {
  NewtonArrays arrays;
  const auto give = [&](Source source, const Eigen::VectorXd& values) {
    arrays.arrays[static_cast<std::size_t>(source)] = values.data();
  };
  give(Source::jacobian, matrix.jacobian);
  give(Source::hessian, matrix.hessian);
  give(Source::diagonal, matrix.diagonal);
  give(Source::compliance, matrix.compliance);
  give(Source::gradient, right_hand_side.gradient);
  give(Source::rows, right_hand_side.constraints);
  give(Source::padded, padded_);
  for (const PaddedColumn& column : entries_.padded) {
    const double* from = arrays.of(column.source) + column.entry;
    double* to = padded_.data() + column.padded_first + column.begin;
    for_stretches(static_cast<Eigen::Index>(column.length), [&](std::size_t, Eigen::Index begin, Eigen::Index length) {
      std::copy_n(from + begin, length, to + begin);
    });
  }
  return arrays;
}

bool IntervalKkt::choose_plan(const NewtonArrays& arrays) {
  auto plan = elimination_plan(entries_, arrays, entries_.intervals / 2);
  has_plan_ = plan.has_value();
  if (!plan) return false;
  plan_ = std::move(*plan);
  kernel_ = choose_(plan_.shape);
  weights_.use(plan_);
  for (GroupMemory& memory : groups_) memory.make_workspace(kernel_.workspace_size(plan_));
  return true;
}

FactorisationStatus IntervalKkt::solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                       const KktStep& step) {
  NewtonArrays arrays = arrays_of(matrix, right_hand_side);
  if (!has_plan_ && !choose_plan(arrays)) return FactorisationStatus::singular;
  weights_.rescale(arrays);
  FactorisationStatus status = eliminate(arrays, matrix, right_hand_side);
  if (status == FactorisationStatus::untrusted) {
    if (!choose_plan(arrays)) return FactorisationStatus::singular;
    status = eliminate(arrays, matrix, right_hand_side);
  }
  // A conjugate point of a segment with a free end, or a sign lost to rounding, is no reason to change the Hessian.
  const auto may_be_due_to_weights = [&] {
    return (status == FactorisationStatus::wrong_inertia || status == FactorisationStatus::singular) &&
           !has_certain_inertia_;
  };
  // To try the other weights costs less than the sparse factorisation that is asked otherwise.
  if (status == FactorisationStatus::singular) weights_.distrust_next_failure();
  while (may_be_due_to_weights() && weights_.next_multiple()) status = eliminate(arrays, matrix, right_hand_side);
  if (status != FactorisationStatus::solved) return status;
  substitute(arrays, right_hand_side.constraints, step);
  return is_finite(step.primal) && is_finite(step.multipliers) ? FactorisationStatus::solved
                                                               : FactorisationStatus::singular;
}

FactorisationStatus IntervalKkt::eliminate(NewtonArrays& arrays, const KktMatrix& matrix,
                                           const KktRightHandSide& right_hand_side) {
  arrays.terminal_weights = weights_.values().data();
  has_certain_inertia_ = false;
  ++eliminations_;
  for_each_part(groups_.size(), [&](std::size_t g) { kernel_.backward(plan_, arrays, groups_[g].group()); });
  for (const GroupMemory& memory : groups_) {
    if (!(memory.group().smallest_ratio > smallest_ratio)) return FactorisationStatus::untrusted;
  }
  for (const GroupMemory& memory : groups_) {
    if (!memory.group().pivots_hold) return FactorisationStatus::wrong_inertia;
  }
  if (!join_segments()) return FactorisationStatus::wrong_inertia;
  find_last_carry(arrays);
  const FactorisationStatus status =
      boundary_.solve(matrix, right_hand_side, {chain_.total(), last_carry_, weights_.values()});
  has_certain_inertia_ = boundary_.is_certain();
  return status;
}

/// J_{N,N-1}, of the unknowns that move by increments.
void IntervalKkt::find_last_carry(const NewtonArrays& arrays) {
  const Shape& shape = entries_.shape;
  last_carry_.setZero(shape.node_sums, shape.node);
  for (const LocalEntry& entry : entries_.local) {
    if (entry.block != LocalEntry::Block::carry || entry.column >= shape.node) continue;
    if (!moves_by_increment(shape, plan_.node_in_next.data(), entry.column)) continue;
    last_carry_(entry.row, entry.column) += arrays.at(entry.source, entry.first + entries_.intervals - 1);
  }
}

/// From the last segment to the first; false if a state between two is no minimum.
bool IntervalKkt::join_segments() {
  bool is_last = true;
  for (std::size_t g = groups_.size(); g-- > 0;) {
    for (int segment = lane_count - 1; segment >= 0; --segment) {
      read_value(groups_[g].group(), segment);
      weights_.observe(segment_value_.Gamma);
      if (is_last) {
        chain_.start(segment_value_, weights_.values());
      } else if (!chain_.join(segment_value_)) {
        return false;
      }
      is_last = false;
    }
  }
  return true;
}

void IntervalKkt::read_value(const SegmentGroup& group, int segment) {
  const Eigen::Index X = state_size(entries_.shape);
  const auto read = [&](const double* from, auto& to) {
    for (Eigen::Index i = 0; i < to.size(); ++i) to.data()[i] = from[i * lane_count + segment];
  };
  segment_value_.P.resize(X, X);
  segment_value_.p.resize(X);
  segment_value_.Phi.resize(X, X);
  segment_value_.Gamma.resize(X, X);
  segment_value_.gamma.resize(X);
  read(group.value, segment_value_.P);
  read(group.value + X * X * lane_count, segment_value_.p);
  read(group.value + X * (X + 1) * lane_count, segment_value_.Phi);
  read(group.reachability, segment_value_.gamma);
  read(group.reachability + X * lane_count, segment_value_.Gamma);
}

void IntervalKkt::substitute(const NewtonArrays& arrays, const Eigen::VectorXd& constraints, const KktStep& step) {
  chain_.back_substitute(boundary_.state(), boundary_.multiplier(), states_, multipliers_);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const SegmentGroup& group = groups_[g].group();
    const auto first = static_cast<Eigen::Index>(g) * lane_count;
    Eigen::Map<Eigen::MatrixXd>(group.state, lane_count, states_.rows()) =
        states_.middleCols(first, lane_count).transpose();
    Eigen::Map<Eigen::MatrixXd>(group.multiplier, lane_count, states_.rows()) =
        multipliers_.middleCols(first, lane_count).transpose();
  }
  // The sweep writes what moves, and `BoundarySystem` all that belongs to the ends.
  const auto count = static_cast<Eigen::Index>(entries_.intervals);
  for (std::size_t j = 0; j < entries_.inner_unknowns.size(); ++j) {
    if (!entries_.inner_is_fixed[j]) continue;
    step.primal.segment(static_cast<Eigen::Index>(entries_.inner_unknowns[j]), count).setZero();
  }
  for_each_part(groups_.size(), [&](std::size_t g) {
    kernel_.forward(plan_, arrays, groups_[g].group(), step.primal.data(), step.multipliers.data());
  });
  boundary_.write(step);
  write_inequality_multipliers(arrays, constraints, step);
}

std::size_t IntervalKkt::first_of(int column) const {
  const Shape& shape = entries_.shape;
  if (column < shape.node) return entries_.node_unknowns[static_cast<std::size_t>(column)] + 1;
  if (column < next_size(shape)) return entries_.inner_unknowns[static_cast<std::size_t>(column - shape.node)];
  const int state = column - next_size(shape);
  if (state < shape.node) return entries_.node_unknowns[static_cast<std::size_t>(state)];
  return entries_.shared_unknowns[static_cast<std::size_t>(state - shape.node - shape.node_sums)];
}

/// (J δx + constraints) / e for the rows of every inequality.
void IntervalKkt::write_inequality_multipliers(const NewtonArrays& arrays, const Eigen::VectorXd& constraints,
                                               const KktStep& step) const {
  const auto count = static_cast<Eigen::Index>(entries_.intervals);
  const auto at = [](std::size_t first) { return static_cast<Eigen::Index>(first); };
  for (const std::size_t row : entries_.inequality_rows) {
    step.multipliers.segment(at(row), count) = constraints.segment(at(row), count);
  }
  const int first_global = next_size(entries_.shape) + entries_.shape.node + entries_.shape.node_sums;
  const int one = next_size(entries_.shape) + state_size(entries_.shape);
  for (const LocalEntry& entry : entries_.local) {
    if (entry.block != LocalEntry::Block::inequality || entry.column < 0 || entry.column == one) continue;
    auto sum = step.multipliers.segment(at(entries_.inequality_rows[static_cast<std::size_t>(entry.row)]), count);
    const Eigen::Map<const Eigen::VectorXd> derivative(arrays.of(entry.source) + entry.first, count);
    if (entry.column >= first_global) {
      sum += derivative * step.primal[at(first_of(entry.column))];
    } else {
      sum += derivative.cwiseProduct(step.primal.segment(at(first_of(entry.column)), count));
    }
  }
  for (const std::size_t row : entries_.inequality_rows) {
    const Eigen::Map<const Eigen::ArrayXd> compliance(arrays.of(Source::compliance) + row, count);
    step.multipliers.segment(at(row), count).array() /= compliance;
  }
}

}  // namespace dmocbench::interior_point
