#include "methods/kkt/intervals/interval_kkt.hpp"

#include <algorithm>
#include <utility>

#include "methods/runtime/long_vectors.hpp"
#include "methods/runtime/parallel.hpp"

namespace dmocbench::kkt {

namespace {

/// Intervals that a new order of elimination is chosen by, besides the middle one.
constexpr Eigen::Index sampled_intervals = 9;

FactorisationStatus status_of(const KktStep& step) {
  return is_finite(step.primal) && is_finite(step.multipliers) ? FactorisationStatus::solved
                                                               : FactorisationStatus::singular;
}

}  // namespace

IntervalKkt::Made IntervalKkt::make(const NonlinearProgram& program, InstructionSet set) {
  auto entries = interval_entries(program);
  if (!entries) return tl::unexpected(std::move(entries).error());
  auto boundary = BoundarySystem::make(program, *entries);
  if (!boundary) return tl::unexpected(std::move(boundary).error());
  const bool suits_single_pass = SinglePass::suits(program, *entries);
  auto kkt = std::make_unique<IntervalKkt>(std::move(*entries), std::move(*boundary), set);
  if (suits_single_pass) kkt->single_pass_.emplace(kkt->entries_);
  return kkt;
}

IntervalKkt::IntervalKkt(IntervalEntries entries, BoundarySystem boundary, InstructionSet set)
    : entries_(std::move(entries)),
      boundary_(std::move(boundary)),
      set_(set),
      weights_(entries_),
      padded_(entries_.make_padded(1)),
      groups_(cut_into_groups(entries_.shape, static_cast<std::size_t>(entries_.intervals))) {}

NewtonArrays IntervalKkt::arrays_of(const KktMatrix& matrix, const KktRightHandSide& right_hand_side) {
  NewtonArrays arrays{{matrix.jacobian.data(), matrix.hessian.data(), matrix.diagonal.data(),
                       right_hand_side.gradient.data(), right_hand_side.constraints.data(), matrix.compliance.data(),
                       padded_.data()}};
  entries_.copy_padded(arrays, 1, padded_);
  return arrays;
}

bool IntervalKkt::choose_plan(const NewtonArrays& arrays, const std::vector<Eigen::Index>& intervals) {
  auto plan = elimination_plan(entries_, arrays, intervals);
  has_plan_ = plan.has_value();
  if (!plan) return false;
  plan_ = std::move(*plan);
  kernel_ = segment_kernels_of(set_)(plan_.shape);
  has_pass_ = single_pass_ && single_pass_->use(plan_, set_);
  weights_.use(plan_);
  for (GroupMemory& memory : groups_) memory.make_workspace(kernel_.workspace_size(plan_));
  return true;
}

FactorisationStatus IntervalKkt::solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                       const KktStep& step) {
  NewtonArrays arrays = arrays_of(matrix, right_hand_side);
  const Eigen::Index middle = entries_.intervals / 2;
  if (!has_plan_ && !choose_plan(arrays, {middle})) return FactorisationStatus::singular;
  if (has_pass_) {
    ++eliminations_;
    const SinglePass::Outcome outcome = single_pass_->solve(plan_, arrays, step);
    if (outcome == SinglePass::Outcome::wrong_inertia) {
      found_ = {FactorisationStatus::wrong_inertia, true};
      return found_.status;
    }
    if (outcome == SinglePass::Outcome::solved) {
      entries_.write_fixed(1, step.primal.data());
      entries_.write_inequality_multipliers(arrays, 1, step.primal.data(), step.multipliers.data());
      return status_of(step);
    }
  }
  weights_.rescale(arrays);
  hold(matrix, arrays);
  for (bool may_choose_order = true;; may_choose_order = false) {
    arrays.terminal_weights = weights_.values().data();
    for_each_part(groups_.size(), [&](std::size_t g) { kernel_.backward(plan_, arrays, groups_[g].group()); });
    ++eliminations_;
    found_ = join(arrays, matrix, right_hand_side);
    if (found_.status == FactorisationStatus::solved) {
      // Positive pivots keep more digits.
      if (!is_minimum_in_parts_) weights_.raise();
      break;
    }
    if (found_.status == FactorisationStatus::untrusted) {
      if (!may_choose_order) return found_.status;
      // A pivot that is large in one interval may be zero in another, for example where a velocity changes its sign.
      std::vector<Eigen::Index> intervals{middle};
      for (Eigen::Index i = 0; i < sampled_intervals; ++i)
        intervals.push_back(i * (entries_.intervals - 1) / (sampled_intervals - 1));
      if (!choose_plan(arrays, intervals)) return FactorisationStatus::singular;
      continue;
    }
    // A conjugate point of a segment with a free end, or a sign lost to rounding, does not justify changing the
    // Hessian. Trying the other weights costs less than the sparse factorisation that a singular system would require.
    if (found_.status == FactorisationStatus::singular) weights_.distrust_next_failure();
    if (found_.is_certain || !weights_.next_multiple()) return found_.status;
  }
  substitute(arrays, step);
  return status_of(step);
}

/// Adds a penalty to the diagonal of unknowns that do not move. It leaves the form the same where they stay, so that a
/// positive one proves the inertia, and an error of its inverse, which refinement removes: it is larger than what holds
/// the other unknowns, such as the barrier of a bound.
void IntervalKkt::hold(const KktMatrix& matrix, NewtonArrays& arrays) {
  constexpr double multiple = 1e3;
  if (entries_.held_unknowns.empty()) return;
  copy_to(held_diagonal_, matrix.diagonal);
  const double penalty = multiple * std::max(weights_.values().maxCoeff(), largest_of(matrix.diagonal));
  for (const Eigen::Index i : entries_.held_unknowns) held_diagonal_[i] += penalty;
  arrays.arrays[static_cast<std::size_t>(Source::diagonal)] = held_diagonal_.data();
}

/// The status after a backward sweep; if it is `solved`, `boundary_` holds the solution at the ends.
IntervalKkt::Elimination IntervalKkt::join(const NewtonArrays& arrays, const KktMatrix& matrix,
                                           const KktRightHandSide& right_hand_side) {
  const auto any_group = [&](const auto& holds) {
    return std::ranges::any_of(groups_, [&](const GroupMemory& memory) { return holds(memory.group()); });
  };
  if (any_group([](const SegmentGroup& group) { return !(group.smallest_ratio > smallest_trusted_ratio); })) {
    return {FactorisationStatus::untrusted};
  }
  if (any_group([](const SegmentGroup& group) { return group.pivots == FreePivots::too_many_negative; })) {
    return {FactorisationStatus::wrong_inertia, true};
  }
  if (any_group([](const SegmentGroup& group) { return group.pivots == FreePivots::near_zero; }) || !join_segments()) {
    return {FactorisationStatus::wrong_inertia};
  }
  find_last_carry(arrays);
  const FactorisationStatus status =
      boundary_.solve(matrix, right_hand_side, {chain_.total(), last_carry_, weights_.values(), negative_});
  // A minimum that shows only in the sum of all inertias is one where the sum leaves no doubt.
  const bool is_doubtful = !is_minimum_in_parts_ && !boundary_.is_certain();
  if (status == FactorisationStatus::solved && is_doubtful) return {FactorisationStatus::wrong_inertia};
  return {status, boundary_.is_certain()};
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

/// Joins from the last segment to the first. Counts the negative eigenvalues of the eliminated blocks, beyond their
/// number at a minimum; false if rounding hides them.
bool IntervalKkt::join_segments() {
  const Eigen::Index X = state_size(entries_.shape);
  bool is_last = true;
  negative_ = 0;
  is_minimum_in_parts_ = true;
  for (std::size_t g = groups_.size(); g-- > 0;) {
    const bool has_minima = groups_[g].group().pivots == FreePivots::positive;
    is_minimum_in_parts_ = is_minimum_in_parts_ && has_minima;
    for (int segment = lane_count - 1; segment >= 0; --segment) {
      const auto columns = [&](const double* numbers, Eigen::Index first, Eigen::Index count) {
        using Strides = Eigen::Stride<Eigen::Dynamic, lane_count>;
        return Eigen::Map<const Eigen::MatrixXd, 0, Strides>(numbers + first * X * lane_count + segment, X, count,
                                                             Strides(X * lane_count, lane_count));
      };
      const SegmentGroup& group = groups_[g].group();
      segment_value_.P = columns(group.value, 0, X);
      segment_value_.p = columns(group.value, X, 1);
      segment_value_.Phi = columns(group.value, X + 1, X);
      segment_value_.gamma = columns(group.reachability, 0, 1);
      segment_value_.Gamma = columns(group.reachability, 1, X);
      if (has_minima) weights_.observe(segment_value_.Gamma);
      const int negative = has_minima ? 0 : group.negative[static_cast<std::size_t>(segment)];
      negative_ += negative;
      if (std::exchange(is_last, false)) {
        chain_.start(segment_value_, weights_.values());
      } else if (negative > 0 || !chain_.join(segment_value_)) {
        if (!chain_.join_and_count(segment_value_)) return false;
        is_minimum_in_parts_ = false;
      }
    }
  }
  negative_ += chain_.negative();
  return true;
}

void IntervalKkt::substitute(const NewtonArrays& arrays, const KktStep& step) {
  chain_.back_substitute(boundary_.state(), boundary_.multiplier(), states_, multipliers_);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const SegmentGroup& group = groups_[g].group();
    const auto first = static_cast<Eigen::Index>(g) * lane_count;
    Eigen::Map<Eigen::MatrixXd>(group.state, lane_count, states_.rows()) =
        states_.middleCols(first, lane_count).transpose();
    Eigen::Map<Eigen::MatrixXd>(group.multiplier, lane_count, states_.rows()) =
        multipliers_.middleCols(first, lane_count).transpose();
  }
  // The forward sweep writes the steps of free unknowns, `BoundarySystem` writes the steps of the ends.
  entries_.write_fixed(1, step.primal.data());
  for_each_part(groups_.size(), [&](std::size_t g) {
    kernel_.forward(plan_, arrays, groups_[g].group(), step.primal.data(), step.multipliers.data());
  });
  boundary_.write(step);
  for (const Eigen::Index i : entries_.held_unknowns) step.primal[i] = 0.0;
  entries_.write_inequality_multipliers(arrays, 1, step.primal.data(), step.multipliers.data());
}

}  // namespace dmocbench::kkt
