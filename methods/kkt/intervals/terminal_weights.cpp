#include "methods/kkt/intervals/terminal_weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "methods/runtime/long_vectors.hpp"

namespace dmocbench::kkt {

namespace {

/// The multiples of the stiffness that are tried, one after the other.
constexpr std::array multiples{1.0, 30.0, 1e3, 1e6};
/// The multiple to begin with after a failure: smaller ones may be too small, the largest may swamp the stiffness.
constexpr std::size_t middle = 2;
/// Failures of the largest multiple that are then accepted without trying smaller ones, after all multiples have
/// failed once. Fewer than make `RefinedKkt` use the sparse factorisation, which costs more than all multiples do.
constexpr int patience = 2;
/// A stiffness lost to rounding under a weight was at most this share of the weight.
constexpr double drowned_share = 1e-3;
constexpr double unknown = std::numeric_limits<double>::infinity();

}  // namespace

TerminalWeights::TerminalWeights(const IntervalEntries& entries)
    : intervals_(entries.intervals),
      stiffness_(Eigen::VectorXd::Ones(state_size(entries.shape))),
      observed_(Eigen::VectorXd::Constant(state_size(entries.shape), unknown)),
      values_(Eigen::VectorXd::Ones(state_size(entries.shape))) {
  for (int column = entries.shape.node; column < next_size(entries.shape); ++column) {
    if (entries.is_fixed_column(column)) continue;
    Diagonal& diagonal = diagonals_.emplace_back();
    for (const LocalEntry& entry : entries.local) {
      if (entry.block != LocalEntry::Block::hessian || entry.row != column || entry.column != column) continue;
      if (entry.source == Source::diagonal) {
        diagonal.added = entry;
      } else {
        diagonal.hessian = entry;
      }
    }
  }
}

void TerminalWeights::use(const EliminationPlan& plan) {
  const auto is_free = [&](const Diagonal& diagonal) {
    return std::ranges::any_of(plan.scatters, [&](const Scatter& item) {
      return !item.is_multiplier && item.index < free_size(plan.shape) && item.first == diagonal.added.first;
    });
  };
  const bool some_are_free = std::ranges::any_of(diagonals_, is_free);
  for (Diagonal& diagonal : diagonals_) diagonal.is_free = !some_are_free || is_free(diagonal);
}

void TerminalWeights::forget() {
  level_ = 0;
  tried_ = 0;
  believed_ = 0;
  stiffness_.setOnes();
  observed_.setConstant(unknown);
}

/// Σ 1/|curvature| over the intervals.
double TerminalWeights::compliance_of(const Diagonal& diagonal, const NewtonArrays& arrays) const {
  const auto numbers = [&](const LocalEntry& entry) { return arrays.of(entry.source) + entry.first; };
  const double* const added = numbers(diagonal.added);
  const double* const hessian = diagonal.hessian ? numbers(*diagonal.hessian) : nullptr;
  return sum_of_stretches(intervals_, [&](Eigen::Index begin, Eigen::Index length) {
    double sum = 0.0;
    for (Eigen::Index k = begin; k < begin + length; ++k) {
      sum += 1.0 / (std::abs((hessian != nullptr ? hessian[k] : 0.0) + added[k]) + negligible_curvature);
    }
    return sum;
  });
}

/// The harmonic mean, because the most compliant unknowns count most, times the number of intervals, because the
/// Hessian of an interval is proportional to its length. Unknowns that cost next to nothing, such as stage rates, are
/// left out: equalities tie them to others that have a cost.
double TerminalWeights::stiffness_of_free_unknowns(const std::vector<double>& compliances) const {
  constexpr double next_to_nothing = 1e4;
  if (compliances.empty()) return 1.0;
  const double largest = next_to_nothing * *std::ranges::min_element(compliances);
  double sum = 0.0;
  double kinds = 0.0;
  for (const double compliance : compliances) {
    if (!(compliance <= largest)) continue;
    sum += compliance;
    kinds += 1.0;
  }
  const auto count = static_cast<double>(intervals_);
  return sum > 0.0 ? count * count * kinds / sum : 1.0;
}

std::vector<TerminalWeights::Diagonal> TerminalWeights::free_diagonals() const {
  std::vector<Diagonal> free;
  std::ranges::copy_if(diagonals_, std::back_inserter(free), &Diagonal::is_free);
  return free;
}

void TerminalWeights::rescale(const NewtonArrays& arrays) {
  compliances_.clear();
  for (const Diagonal& diagonal : diagonals_) {
    if (diagonal.is_free) compliances_.push_back(compliance_of(diagonal, arrays));
  }
  rescale(compliances_);
}

void TerminalWeights::rescale(const std::vector<double>& compliances) {
  update();
  scale_ = stiffness_of_free_unknowns(compliances);
  values_ = multiples[level_] * scale_ * stiffness_;
  tried_ = 0;
}

bool TerminalWeights::next_multiple() {
  // A weight that may be too small proves nothing about the Hessian, so only a failure of the largest counts.
  const bool is_largest = level_ + 1 == multiples.size();
  if (tried_ + 1 == multiples.size() || (is_largest && believed_ > 0)) {
    believed_ = believed_ > 0 ? believed_ - 1 : patience;
    level_ = middle;
    tried_ = 0;
    return false;
  }
  ++tried_;
  take((level_ + 1) % multiples.size());
  return true;
}

bool TerminalWeights::take_largest() {
  constexpr std::size_t largest = multiples.size() - 1;
  if (level_ == largest) return false;
  take(largest);
  return true;
}

void TerminalWeights::take(std::size_t level) {
  level_ = level;
  update();
  values_ = multiples[level_] * scale_ * stiffness_;
}

void TerminalWeights::prefer_middle() noexcept { level_ = middle; }

void TerminalWeights::raise() noexcept {
  if (level_ < middle) ++level_;
}

void TerminalWeights::observe(const Eigen::MatrixXd& Gamma) {
  for (Eigen::Index i = 0; i < values_.size(); ++i) {
    if (!(Gamma(i, i) > 0.0)) continue;
    const double stiffness = std::max(1.0 / Gamma(i, i) - values_[i], drowned_share * values_[i]);
    if (std::isfinite(stiffness)) observed_[i] = std::min(observed_[i], stiffness);
  }
}

void TerminalWeights::update() {
  for (Eigen::Index i = 0; i < values_.size(); ++i) {
    // A state that the free unknowns hardly reach needs no larger weight.
    if (observed_[i] < unknown) stiffness_[i] = std::min(1.0, observed_[i] / scale_);
    observed_[i] = unknown;
  }
}

}  // namespace dmocbench::kkt
