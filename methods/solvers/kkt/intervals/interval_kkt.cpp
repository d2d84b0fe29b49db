#include "methods/solvers/kkt/intervals/interval_kkt.hpp"

#include <algorithm>
#include <utility>

#include "methods/error.hpp"
#include "methods/runtime/long_vectors.hpp"
#include "methods/runtime/parallel.hpp"

namespace dmocbench::kkt {

namespace {

/// Intervals that a new order of elimination is chosen by, besides the middle one.
constexpr Eigen::Index sampled_intervals = 9;

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
    : entries_(std::move(entries)),
      boundary_(program, entries_),
      choose_(choose),
      weights_(entries_),
      padded_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(entries_.padded.size()) * entries_.intervals)),
      groups_(cut_into_groups(entries_.shape, static_cast<std::size_t>(entries_.intervals))) {}

NewtonArrays IntervalKkt::arrays_of(const KktMatrix& matrix, const KktRightHandSide& right_hand_side) {
  NewtonArrays arrays{{matrix.jacobian.data(), matrix.hessian.data(), matrix.diagonal.data(),
                       right_hand_side.gradient.data(), right_hand_side.constraints.data(), matrix.compliance.data(),
                       padded_.data()}};
  for (const PaddedRun& run : entries_.padded) {
    const double* from = arrays.of(run.source) + run.entry;
    double* to = padded_.data() + run.padded_first + run.begin;
    for_stretches(run.length, [&](std::size_t, Eigen::Index begin, Eigen::Index length) {
      std::copy_n(from + begin, length, to + begin);
    });
  }
  return arrays;
}

bool IntervalKkt::choose_plan(const NewtonArrays& arrays, const std::vector<Eigen::Index>& intervals) {
  auto plan = elimination_plan(entries_, arrays, intervals);
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
  const Eigen::Index middle = entries_.intervals / 2;
  if (!has_plan_ && !choose_plan(arrays, {middle})) return FactorisationStatus::singular;
  weights_.rescale(arrays);
  for (bool may_choose_order = true;; may_choose_order = false) {
    arrays.terminal_weights = weights_.values().data();
    for_each_part(groups_.size(), [&](std::size_t g) { kernel_.backward(plan_, arrays, groups_[g].group()); });
    ++eliminations_;
    const Elimination found = join(arrays, matrix, right_hand_side);
    if (found.status == FactorisationStatus::solved) break;
    if (found.status == FactorisationStatus::untrusted) {
      if (!may_choose_order) return found.status;
      // A pivot that is large in one interval may be zero in another, where a velocity changes its sign, say.
      std::vector<Eigen::Index> intervals{middle};
      for (Eigen::Index i = 0; i < sampled_intervals; ++i)
        intervals.push_back(i * (entries_.intervals - 1) / (sampled_intervals - 1));
      if (!choose_plan(arrays, intervals)) return FactorisationStatus::singular;
      continue;
    }
    // A conjugate point of a segment with a free end, or a sign lost to rounding, is no reason to change the Hessian.
    // To try the other weights costs less than the sparse factorisation that is asked about a singular system.
    if (found.status == FactorisationStatus::singular) weights_.distrust_next_failure();
    if (found.is_certain || !weights_.next_multiple()) return found.status;
  }
  substitute(arrays, right_hand_side.constraints, step);
  return is_finite(step.primal) && is_finite(step.multipliers) ? FactorisationStatus::solved
                                                               : FactorisationStatus::singular;
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
  if (any_group([](const SegmentGroup& group) { return !group.pivots_hold; }) || !join_segments()) {
    return {FactorisationStatus::wrong_inertia};
  }
  find_last_carry(arrays);
  const FactorisationStatus status =
      boundary_.solve(matrix, right_hand_side, {chain_.total(), last_carry_, weights_.values()});
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

/// From the last segment to the first; false if a state between two is no minimum.
bool IntervalKkt::join_segments() {
  const Eigen::Index X = state_size(entries_.shape);
  bool is_last = true;
  for (std::size_t g = groups_.size(); g-- > 0;) {
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
  // The forward sweep writes the steps of free unknowns, `BoundarySystem` those of the ends.
  for (int column = 0; column < next_size(entries_.shape); ++column) {
    if (!entries_.is_fixed_column(column)) continue;
    step.primal.segment(entries_.unknown_in(column), entries_.intervals).setZero();
  }
  for_each_part(groups_.size(), [&](std::size_t g) {
    kernel_.forward(plan_, arrays, groups_[g].group(), step.primal.data(), step.multipliers.data());
  });
  boundary_.write(step);
  write_inequality_multipliers(arrays, constraints, step);
}

/// (J δx + constraints) / e for the rows of every inequality.
void IntervalKkt::write_inequality_multipliers(const NewtonArrays& arrays, const Eigen::VectorXd& constraints,
                                               const KktStep& step) const {
  const Eigen::Index count = entries_.intervals;
  for (const Eigen::Index row : entries_.inequality_rows) {
    step.multipliers.segment(row, count) = constraints.segment(row, count);
  }
  const int one = next_size(entries_.shape) + state_size(entries_.shape);
  for (const LocalEntry& entry : entries_.local) {
    if (entry.block != LocalEntry::Block::inequality || entry.column < 0 || entry.column == one) continue;
    const Eigen::Index unknown = entries_.unknown_in(entry.column);
    auto sum = step.multipliers.segment(entries_.inequality_rows[static_cast<std::size_t>(entry.row)], count);
    const Eigen::Map<const Eigen::VectorXd> derivative(arrays.of(entry.source) + entry.first, count);
    if (entry.column >= one - entries_.shape.global) {
      sum += derivative * step.primal[unknown];
    } else {
      sum += derivative.cwiseProduct(step.primal.segment(unknown, count));
    }
  }
  for (const Eigen::Index row : entries_.inequality_rows) {
    const Eigen::Map<const Eigen::ArrayXd> compliance(arrays.of(Source::compliance) + row, count);
    step.multipliers.segment(row, count).array() /= compliance;
  }
}

}  // namespace dmocbench::kkt
