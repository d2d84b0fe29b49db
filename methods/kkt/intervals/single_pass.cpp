#include "methods/kkt/intervals/single_pass.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/kkt/intervals/pass_blocks.hpp"
#include "methods/kkt/intervals/pass_gathers.hpp"
#include "methods/runtime/parallel.hpp"

namespace dmocbench::kkt {

namespace {

/// Below this pivot of Γ, scaled to a diagonal of ones, ν is carried further, ...
constexpr double smallest_conditioned_pivot = 1e-5;
/// ... through so many intervals at most: if they do not determine the end, more of them hardly do.
constexpr int most_carried = 32;

PassKernel pass_kernel_of(const Shape& shape, InstructionSet set) {
  static constexpr std::array choices{DMOCBENCH_VERSIONS(pass_kernel)};
  return compiled_for(set, choices)(shape);
}

}  // namespace

bool SinglePass::suits(const NonlinearProgram& program, const IntervalEntries& entries) {
  // From there on, eight segments at a time take less time than the pass (`build/bench/speed/scaling`). With more
  // unknowns the numbers of eight intervals do not fit the first-level cache, but threads share long horizons.
  constexpr std::array<std::size_t, 4> most{0, 32, 48, 128};
  const auto node = static_cast<std::size_t>(entries.shape.node);
  const auto intervals = static_cast<std::size_t>(entries.intervals);
  const bool is_faster = node < most.size() ? intervals <= most.at(node) : intervals < intervals_per_part;
  return is_faster && reason_of_free_ends(program, entries) == nullptr;
}

bool SinglePass::use(const EliminationPlan& plan, InstructionSet set) {
  const Shape& shape = plan.shape;
  if (!fits_single_pass(shape)) return false;
  kernel_ = pass_kernel_of(shape, set);
  const ForwardBlocks<Shape> found{shape};
  const PassForwardBlocks<Shape> places{shape};
  scatters_ = plan.scatters;
  for (Scatter& item : scatters_) {
    if (item.is_multiplier) {
      item.index += places.multipliers().first - found.multipliers().first;
    } else if (item.index < found.next_state().first) {
      item.index += places.inputs().first + shape.node - found.columns().first;
    } else {
      item.index += places.state().first - found.next_state().first;
    }
  }
  const int X = 2 * shape.node;
  const auto intervals = static_cast<std::size_t>(entries_.intervals);
  const auto numbers = [](int size) { return static_cast<std::size_t>(whole_quads(size)); };
  const std::size_t value = numbers(PassValueBlocks<Shape>{shape}.size());
  const std::size_t records = intervals * numbers(PassRecordBlocks<Shape>{shape}.size());
  const std::size_t ends = intervals * numbers(PassEndBlocks<Shape>{shape}.size());
  // NOLINTBEGIN(*-avoid-c-arrays): a vector would write zeros
  numbers_ = std::make_unique_for_overwrite<NumberLine[]>((value + records + ends + lane_count - 1) / lane_count);
  workspace_ = std::make_unique<NumberLine[]>(kernel_.workspace_size(plan) / lane_count);
  // NOLINTEND(*-avoid-c-arrays)
  pass_ = {};
  pass_.intervals = static_cast<int>(entries_.intervals);
  pass_.value = numbers_[0].numbers.data();
  pass_.records = pass_.value + value;
  pass_.end_records = pass_.records + records;
  pass_.workspace = workspace_[0].numbers.data();
  pass_.scatters = scatters_.data();
  pass_.scatter_count = static_cast<int>(scatters_.size());
  gathers_ = pass_gathers(entries_, plan);
  pass_.gathers = gathers_.data();
  pass_.gather_count = static_cast<int>(gathers_.size());
  units_ = pass_units(entries_);
  pass_.unit_slots = units_.data();
  pass_.unit_count = static_cast<int>(units_.size());
  places_of_rows_ = places_of_rows(plan);
  pass_.places_of_rows = places_of_rows_.data();
  last_sums_.resize(shape.node);
  factor_.resize(X, X);
  solved_.resize(X, X + 1);
  end_.resize(X);
  return true;
}

SinglePass::Outcome SinglePass::solve(const EliminationPlan& plan, const NewtonArrays& arrays, const KktStep& step) {
  const int node = entries_.shape.node;
  const int N = pass_.intervals;
  for (int i = 0; i < node; ++i) {
    last_sums_[i] = -arrays.at(Source::rows, entries_.equality_rows[static_cast<std::size_t>(i)] + N);
  }
  // Four keep a digit more than two (README.md), but with a free end fewer of them have a minimum.
  int at = -1;  // intervals from here on carry ν
  for (int carried = N < 32 ? 2 : 4; at < 0 && carried > 1; carried /= 2) {
    at = carry_end_multiplier(plan, arrays, carried);
  }
  if (at < 0) return Outcome::undecided;
  eliminate_end_multiplier();
  kernel_.backward(plan, arrays, 0, at, false, pass_);
  if (!(pass_.smallest_ratio > smallest_trusted_ratio)) return Outcome::undecided;
  if (!pass_.pivots_hold) return pass_.is_negative ? Outcome::wrong_inertia : Outcome::undecided;
  kernel_.forward(plan, pass_, 0, at, nullptr, step.primal.data(), step.multipliers.data());
  find_end_multiplier();
  kernel_.forward(plan, pass_, at, N, end_.data(), step.primal.data(), step.multipliers.data());
  write_ends(step);
  return Outcome::solved;
}

/// Eliminates the last intervals, `carried` or more, until Γ shows that they reach every state. Returns the first of
/// them; -1 if a pivot is not positive, or too many intervals do not suffice.
int SinglePass::carry_end_multiplier(const EliminationPlan& plan, const NewtonArrays& arrays, int carried) {
  const int N = pass_.intervals;
  kernel_.start(plan, last_sums_.data(), pass_);
  for (int end = N;; carried *= 2) {
    const int begin = std::max(N - carried, 0);
    kernel_.backward(plan, arrays, begin, end, true, pass_);
    if (pass_.pivots_hold && factorise_reachability()) return begin;
    if (!pass_.pivots_hold || begin == 0 || carried >= most_carried) return -1;
    end = begin;
  }
}

/// Γ = LLᵀ; L has the reciprocals of its diagonal. False if Γ is not positive definite, or badly conditioned.
bool SinglePass::factorise_reachability() {
  const Eigen::Index X = end_.size();
  const double* const Gamma = pass_.value + PassValueBlocks<Shape>{entries_.shape}.reachability()(0, 1);
  for (Eigen::Index j = 0; j < X; ++j) {
    for (Eigen::Index i = j; i < X; ++i) {
      double sum = Gamma[i + j * X];
      for (Eigen::Index k = 0; k < j; ++k) sum -= factor_(i, k) * factor_(j, k);
      if (i > j) {
        factor_(i, j) = sum * factor_(j, j);
        continue;
      }
      if (!(sum > smallest_conditioned_pivot * Gamma[j + j * X])) return false;
      factor_(j, j) = 1.0 / std::sqrt(sum);
    }
  }
  return true;
}

/// L⁻¹ (Φᵀ, γ - d) is left for `find_end_multiplier`, its squares are added to the cost-to-go.
void SinglePass::eliminate_end_multiplier() {
  const PassValueBlocks<Shape> places{entries_.shape};
  const Eigen::Index X = end_.size();
  const int height = state_height(entries_.shape);
  double* const P = pass_.value;
  double* const extras = P + places.extras().first;
  const double* const gap = P + places.reachability().first;
  for (Eigen::Index i = 0; i < X; ++i) {
    for (Eigen::Index j = 0; j <= X; ++j) {
      double sum = j < X ? extras[j + (1 + i) * height] : gap[i];
      for (Eigen::Index k = 0; k < i; ++k) sum -= factor_(i, k) * solved_(k, j);
      solved_(i, j) = sum * factor_(i, i);
    }
  }
  for (Eigen::Index j = 0; j < X; ++j) {
    extras[j] += solved_.col(j).dot(solved_.col(X));
    for (Eigen::Index i = j; i < X; ++i) {
      P[i + j * height] += solved_.col(i).dot(solved_.col(j));
      P[j + i * height] = P[i + j * height];
    }
  }
}

/// ν = L⁻ᵀ L⁻¹ (ΦᵀX + γ - d).
void SinglePass::find_end_multiplier() {
  const Eigen::Index X = end_.size();
  for (Eigen::Index i = X - 1; i >= 0; --i) {
    double sum = solved_(i, X);
    for (Eigen::Index j = 0; j < X; ++j) sum += solved_(i, j) * pass_.state[j];
    end_[i] = sum;
  }
  for (Eigen::Index i = X - 1; i >= 0; --i) {
    for (Eigen::Index k = i + 1; k < X; ++k) end_[i] -= factor_(k, i) * end_[k];
    end_[i] *= factor_(i, i);
  }
}

/// The ends do not move. The last entries of ν are the multipliers of the last node's equalities.
void SinglePass::write_ends(const KktStep& step) const {
  for (const Eigen::Index first : entries_.node_unknowns) {
    step.primal[first] = 0.0;
    step.primal[first + entries_.intervals] = 0.0;
  }
  const int node = entries_.shape.node;
  for (int i = 0; i < node; ++i) {
    step.multipliers[entries_.equality_rows[static_cast<std::size_t>(i)] + entries_.intervals] = end_[node + i];
  }
}

}  // namespace dmocbench::kkt
