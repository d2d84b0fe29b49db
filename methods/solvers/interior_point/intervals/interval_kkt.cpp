#include "methods/solvers/interior_point/intervals/interval_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/error.hpp"

namespace dmocbench::interior_point {

namespace {

/// How small a pivot of the equalities may be, measured by those that the order of elimination was chosen by.
constexpr double smallest_ratio = 1e-7;

}  // namespace

std::unique_ptr<IntervalKkt> IntervalKkt::make(const NonlinearProgram& program, std::string& why,
                                               SegmentKernelChoice choose) {
  auto entries = interval_entries(program, why);
  if (!entries) return nullptr;
  try {
    return std::make_unique<IntervalKkt>(program, std::move(*entries), choose);
  } catch (const Error& error) {
    why = error.what();
    return nullptr;
  }
}

IntervalKkt::IntervalKkt(const NonlinearProgram& program, IntervalEntries entries, SegmentKernelChoice choose)
    : entries_(std::move(entries)), ends_(program, entries_), choose_(choose), weights_(entries_) {
  cut_into_segments();
  padded_.setZero(static_cast<Eigen::Index>(entries_.padded.size() * entries_.intervals));
  const auto X = static_cast<std::size_t>(state_size(entries_.shape));
  value_.resize(X * (2 * X + 1) * lane_count);
  reach_.resize(X * (X + 1) * lane_count);
  state_.resize(X * lane_count);
  multiplier_.resize(X * lane_count);
  group_.value = value_.data();
  group_.reach = reach_.data();
  group_.state = state_.data();
  group_.multiplier = multiplier_.data();
}

void IntervalKkt::cut_into_segments() {
  const auto intervals = static_cast<std::ptrdiff_t>(entries_.intervals);
  const auto begin_of = [&](int lane) { return lane * intervals / lane_count; };
  for (int lane = 0; lane < lane_count; ++lane) {
    group_.first[lane] = begin_of(lane);
    group_.length[lane] = static_cast<int>(begin_of(lane + 1) - begin_of(lane));
  }
  group_.steps = *std::ranges::max_element(group_.length);
  group_.shortest = *std::ranges::min_element(group_.length);
  const auto record = static_cast<std::size_t>(RecordBlocks<Shape>{entries_.shape}.size());
  records_.resize(static_cast<std::size_t>(group_.steps) * record * lane_count);
  group_.records = records_.data();
}

NewtonArrays IntervalKkt::arrays_of(const KktMatrix& matrix, const Eigen::VectorXd& slope,
                                    const Eigen::VectorXd& rows) {
  NewtonArrays arrays;
  const auto give = [&](Source source, const Eigen::VectorXd& values) {
    arrays.arrays[static_cast<std::size_t>(source)] = values.data();
  };
  give(Source::jacobian, matrix.jacobian);
  give(Source::hessian, matrix.hessian);
  give(Source::diagonal, matrix.diagonal);
  give(Source::softness, matrix.softness);
  give(Source::slope, slope);
  give(Source::rows, rows);
  give(Source::padded, padded_);
  for (const PaddedColumn& column : entries_.padded) {
    const double* from = arrays.of(column.source) + column.entry;
    std::copy_n(from, column.length, padded_.data() + column.padded_first + column.begin);
  }
  return arrays;
}

bool IntervalKkt::choose_plan(const NewtonArrays& arrays) {
  auto plan = elimination_plan(entries_, arrays, entries_.intervals / 2);
  has_plan_ = plan.has_value();
  if (!plan) return false;
  plan_ = std::move(*plan);
  kernel_ = choose_(plan_.shape);
  workspace_.resize(kernel_.workspace_size(plan_));
  group_.workspace = workspace_.data();
  return true;
}

Verdict IntervalKkt::solve(const KktMatrix& matrix, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                           Eigen::VectorXd& primal_step, Eigen::VectorXd& multiplier_step) {
  NewtonArrays arrays = arrays_of(matrix, slope, rows);
  weights_.follow(arrays);
  if (!has_plan_ && !choose_plan(arrays)) return Verdict::singular;
  Verdict verdict = eliminate(arrays, matrix, slope, rows);
  if (verdict == Verdict::untrusted) {
    if (!choose_plan(arrays)) return Verdict::singular;
    verdict = eliminate(arrays, matrix, slope, rows);
  }
  // A conjugate point of a segment with a free end, or a sign lost to rounding, is no reason to change the Hessian.
  const auto may_be_weight = [&] { return verdict == Verdict::wrong_inertia || verdict == Verdict::singular; };
  while (may_be_weight() && weights_.try_another()) verdict = eliminate(arrays, matrix, slope, rows);
  if (verdict != Verdict::solved) return verdict;
  substitute(arrays, rows, primal_step, multiplier_step);
  const bool is_finite = ((primal_step.array() * 0.0).sum() + (multiplier_step.array() * 0.0).sum()) == 0.0;
  return is_finite ? Verdict::solved : Verdict::singular;
}

Verdict IntervalKkt::eliminate(NewtonArrays& arrays, const KktMatrix& matrix, const Eigen::VectorXd& slope,
                               const Eigen::VectorXd& rows) {
  arrays.terminal_weights = weights_.values().data();
  kernel_.backward(plan_, arrays, group_);
  if (!(group_.smallest_ratio > smallest_ratio)) return Verdict::untrusted;
  if (!group_.pivots_hold) return Verdict::wrong_inertia;
  for (int segment = lane_count - 1; segment >= 0; --segment) {
    read_value(segment);
    weights_.learn(segment_value_.Gamma);
    if (segment == lane_count - 1) {
      chain_.start(segment_value_, weights_.values());
    } else if (!chain_.join(segment_value_)) {
      return Verdict::wrong_inertia;
    }
  }
  return ends_.solve(matrix, slope, rows, chain_.total(), weights_.values());
}

void IntervalKkt::read_value(int segment) {
  const Eigen::Index X = state_size(entries_.shape);
  const auto read = [&](const double* from, auto& to) {
    for (Eigen::Index i = 0; i < to.size(); ++i) to.data()[i] = from[i * lane_count + segment];
  };
  segment_value_.P.resize(X, X);
  segment_value_.p.resize(X);
  segment_value_.Phi.resize(X, X);
  segment_value_.Gamma.resize(X, X);
  segment_value_.gamma.resize(X);
  read(group_.value, segment_value_.P);
  read(group_.value + X * X * lane_count, segment_value_.p);
  read(group_.value + X * (X + 1) * lane_count, segment_value_.Phi);
  read(group_.reach, segment_value_.gamma);
  read(group_.reach + X * lane_count, segment_value_.Gamma);
}

void IntervalKkt::substitute(const NewtonArrays& arrays, const Eigen::VectorXd& rows, Eigen::VectorXd& primal_step,
                             Eigen::VectorXd& multiplier_step) {
  chain_.spread(ends_.state(), ends_.multiplier(), states_, multipliers_);
  for (Eigen::Index i = 0; i < states_.rows(); ++i) {
    for (int segment = 0; segment < lane_count; ++segment) {
      group_.state[i * lane_count + segment] = states_(i, segment);
      group_.multiplier[i * lane_count + segment] = multipliers_(i, segment);
    }
  }
  primal_step.setZero();
  multiplier_step.setZero();
  kernel_.forward(plan_, group_, primal_step.data(), multiplier_step.data());
  ends_.write(primal_step, multiplier_step);
  write_soft_multipliers(arrays, rows, primal_step, multiplier_step);
}

std::size_t IntervalKkt::first_of(int column) const {
  const Shape& shape = entries_.shape;
  if (column < shape.node) return entries_.node_unknowns[static_cast<std::size_t>(column)] + 1;
  if (column < next_size(shape)) return entries_.inner_unknowns[static_cast<std::size_t>(column - shape.node)];
  const int state = column - next_size(shape);
  if (state < shape.node) return entries_.node_unknowns[static_cast<std::size_t>(state)];
  return entries_.shared_unknowns[static_cast<std::size_t>(state - shape.node - shape.carried)];
}

void IntervalKkt::write_soft_multipliers(const NewtonArrays& arrays, const Eigen::VectorXd& rows,
                                         const Eigen::VectorXd& primal_step, Eigen::VectorXd& multiplier_step) const {
  const auto count = static_cast<Eigen::Index>(entries_.intervals);
  const auto at = [](std::size_t first) { return static_cast<Eigen::Index>(first); };
  for (const std::size_t row : entries_.soft_rows) {
    multiplier_step.segment(at(row), count) = rows.segment(at(row), count);
  }
  const int first_shared = next_size(entries_.shape) + entries_.shape.node + entries_.shape.carried;
  const int one = next_size(entries_.shape) + state_size(entries_.shape);
  for (const LocalEntry& entry : entries_.local) {
    if (entry.block != LocalEntry::Block::soft || entry.column < 0 || entry.column == one) continue;
    auto sum = multiplier_step.segment(at(entries_.soft_rows[static_cast<std::size_t>(entry.row)]), count);
    const Eigen::Map<const Eigen::VectorXd> derivative(arrays.of(entry.source) + entry.first, count);
    if (entry.column >= first_shared) {
      sum += derivative * primal_step[at(first_of(entry.column))];
    } else {
      sum += derivative.cwiseProduct(primal_step.segment(at(first_of(entry.column)), count));
    }
  }
  for (const std::size_t row : entries_.soft_rows) {
    const Eigen::Map<const Eigen::ArrayXd> softness(arrays.of(Source::softness) + row, count);
    multiplier_step.segment(at(row), count).array() /= softness;
  }
}

}  // namespace dmocbench::interior_point
