#include "methods/kkt/intervals/lane_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "methods/runtime/lane_loops.hpp"

namespace dmocbench::kkt {

namespace {

static_assert(lane_count == instance_lanes);

/// The number of refusals in a row after which the other multiples of the weights are tried.
constexpr int most_believed = 4;
/// Systems in a row that are not refused, after which a lane goes back to the usual weights, which keep more digits.
constexpr int enough_calm = 3;

std::size_t lanes_of(int entries) { return static_cast<std::size_t>(entries) * lane_count; }

}  // namespace

LaneKkt::Made LaneKkt::make(const NonlinearProgram& program, const KktMatrix& usual, SegmentKernelChoice choose) {
  auto entries = interval_entries(program);
  if (!entries) return tl::unexpected(std::move(entries).error());
  if (const char* const refusal = reason_of_free_ends(program, *entries)) return tl::unexpected(std::string(refusal));
  Eigen::VectorXd padded = entries->make_padded(1);
  const NewtonArrays arrays{{usual.jacobian.data(), usual.hessian.data(), usual.diagonal.data(), nullptr, nullptr,
                             usual.compliance.data(), padded.data()}};
  entries->copy_padded(arrays, 1, padded);
  auto plan = elimination_plan(*entries, arrays, {entries->intervals / 2});
  if (!plan)
    return tl::unexpected(std::string("the equalities of an interval depend on each other at the default start"));
  return std::unique_ptr<LaneKkt>(new LaneKkt(std::move(*entries), std::move(*plan), choose));
}

LaneKkt::LaneKkt(IntervalEntries entries, EliminationPlan plan, SegmentKernelChoice choose)
    : entries_(std::move(entries)),
      plan_(std::move(plan)),
      kernel_(choose(plan_.shape)),
      fresh_weights_(entries_),
      lane_weights_(lanes_of(state_size(entries_.shape)), 1.0),
      last_state_(lane_weights_.size(), 0.0),
      factor_(lane_weights_.size() * static_cast<std::size_t>(state_size(entries_.shape))),
      end_(lane_weights_.size()),
      reachability_(state_size(entries_.shape), state_size(entries_.shape)),
      padded_(entries_.make_padded(lane_count)),
      memory_(GroupMemory::of_instances(entries_.shape, static_cast<std::size_t>(entries_.intervals))) {
  fresh_weights_.use(plan_);
  fresh_weights_.prefer_middle();
  weights_.assign(lane_count, fresh_weights_);
  free_diagonals_ = fresh_weights_.free_diagonals();
  compliances_.resize(free_diagonals_.size() * lane_count);
  memory_.make_workspace(kernel_.workspace_size(plan_));
  std::fill_n(memory_.group().state, lane_weights_.size(), 0.0);  // the first state is given
}

void LaneKkt::forget(std::size_t lane) {
  weights_[lane] = fresh_weights_;
  refusals_[lane] = 0;
  calm_[lane] = 0;
  tries_others_[lane] = false;
  has_other_weights_[lane] = false;
}

NewtonArrays LaneKkt::arrays_of(const Systems& systems) {
  NewtonArrays arrays{{systems.jacobian, systems.hessian, systems.diagonal, systems.gradient, systems.constraints,
                       systems.compliance, padded_.data()}};
  entries_.copy_padded(arrays, lane_count, padded_);
  arrays.terminal_weights = lane_weights_.data();
  return arrays;
}

LaneKkt::Outcomes LaneKkt::solve(const Systems& systems, const Mask& wanted, double* primal, double* multipliers) {
  const NewtonArrays arrays = arrays_of(systems);
  rescale_weights(arrays, wanted);
  SegmentGroup& group = memory_.group();
  kernel_.backward(plan_, arrays, group);
  factorise_reachability();
  Outcomes outcomes;
  outcomes.fill(Outcome::failed);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    if (wanted[lane]) outcomes[lane] = outcome_of(lane);
  }
  if (std::ranges::find(outcomes, Outcome::solved) == outcomes.end()) return outcomes;
  find_end_multipliers(systems.constraints);
  kernel_.forward(plan_, arrays, group, primal, multipliers);
  write_ends(primal, multipliers);
  entries_.write_inequality_multipliers(arrays, lane_count, primal, multipliers);
  return outcomes;
}

void LaneKkt::rescale_weights(const NewtonArrays& arrays, const Mask& wanted) {
  for (std::size_t i = 0; i < free_diagonals_.size(); ++i) {
    const TerminalWeights::Diagonal& diagonal = free_diagonals_[i];
    const auto numbers = [&](const LocalEntry& entry) { return arrays.of(entry.source) + entry.first * lane_count; };
    lane_loops().sum_of_reciprocals(diagonal.hessian ? numbers(*diagonal.hessian) : nullptr, numbers(diagonal.added),
                                    TerminalWeights::negligible_curvature, entries_.intervals,
                                    &compliances_[i * lane_count]);
  }
  std::vector<double> of_lane(free_diagonals_.size());
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    if (!wanted[lane]) continue;
    if (!std::exchange(has_other_weights_[lane], false)) {
      for (std::size_t i = 0; i < of_lane.size(); ++i) of_lane[i] = compliances_[i * lane_count + lane];
      weights_[lane].rescale(of_lane);
    }
    const Eigen::VectorXd& values = weights_[lane].values();
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      lane_weights_[static_cast<std::size_t>(i) * lane_count + lane] = values[i];
    }
  }
}

/// Γ = LLᵀ in all lanes; L stands where the lower triangle of Γ stood, with the reciprocals of its diagonal.
void LaneKkt::factorise_reachability() {
  const auto X = static_cast<std::size_t>(state_size(entries_.shape));
  const double* const gamma = memory_.group().reachability + X * lane_count;
  const auto at = [&](std::size_t i, std::size_t j) { return (i + j * X) * lane_count; };
  const double rounding = 10.0 * static_cast<double>(X) * std::numeric_limits<double>::epsilon();
  is_definite_.fill(true);
  for (std::size_t j = 0; j < X; ++j) {
    for (std::size_t i = j; i < X; ++i) {
      double* const entry = &factor_[at(i, j)];
      std::copy_n(gamma + at(i, j), lane_count, entry);
      for (std::size_t k = 0; k < j; ++k) {
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
          entry[lane] -= factor_[at(i, k) + lane] * factor_[at(j, k) + lane];
        }
      }
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        if (i > j) {
          entry[lane] *= factor_[at(j, j) + lane];
          continue;
        }
        const bool holds = entry[lane] > rounding * gamma[at(j, j) + lane];
        is_definite_[lane] = is_definite_[lane] && holds;
        entry[lane] = 1.0 / std::sqrt(holds ? entry[lane] : 1.0);
      }
    }
  }
}

LaneKkt::Outcome LaneKkt::outcome_of(std::size_t lane) {
  const SegmentGroup& group = memory_.group();
  if (!(group.lane_smallest_ratio[lane] > smallest_trusted_ratio)) return Outcome::failed;
  const bool pivots_hold = group.lane_pivots_hold[lane] > 0.0;
  if (pivots_hold) {
    const Eigen::Index X = reachability_.rows();
    for (Eigen::Index i = 0; i < X; ++i) {
      reachability_(i, i) = group.reachability[(X + i + i * X) * lane_count + static_cast<Eigen::Index>(lane)];
    }
    weights_[lane].observe(reachability_);
    if (is_definite_[lane]) {
      calm_[lane] = refusals_[lane] > 0 ? 0 : calm_[lane] + 1;
      if (calm_[lane] == enough_calm) weights_[lane].prefer_middle();
      refusals_[lane] = 0;
      tries_others_[lane] = false;
      return Outcome::solved;
    }
  }
  // The largest multiple decides the inertia of DMOC, and of the midpoint rule; collocation with several stages needs
  // more. Repeated refusals may mean that digits were lost between the ends of the horizon, which no shift repairs.
  calm_[lane] = 0;
  const bool needs_more = entries_.shape.node_sums == 0 && !plan_.shape.is_plain;
  const bool is_doubtful = needs_more || tries_others_[lane] || (refusals_[lane] + 1) % most_believed == 0;
  tries_others_[lane] = is_doubtful && weights_[lane].next_multiple();
  has_other_weights_[lane] = tries_others_[lane] || (!is_doubtful && weights_[lane].take_largest());
  if (has_other_weights_[lane]) return Outcome::again;
  ++refusals_[lane];
  return pivots_hold ? Outcome::failed : Outcome::wrong_inertia;
}

/// d, and ν = Γ⁻¹(γ - d).
void LaneKkt::find_end_multipliers(const double* constraints) {
  const auto X = static_cast<std::size_t>(state_size(entries_.shape));
  const auto node = static_cast<std::size_t>(entries_.shape.node);
  const auto L = [&](std::size_t i, std::size_t j) { return &factor_[(i + j * X) * lane_count]; };
  const auto row = [&](std::size_t i) { return &end_[i * lane_count]; };
  for (std::size_t i = 0; i < static_cast<std::size_t>(entries_.shape.node_sums); ++i) {
    const double* const residual = constraints + (entries_.equality_rows[i] + entries_.intervals) * lane_count;
    for (std::size_t lane = 0; lane < lane_count; ++lane) last_state_[(node + i) * lane_count + lane] = -residual[lane];
  }
  const double* const gamma = memory_.group().reachability;
  for (std::size_t i = 0; i < end_.size(); ++i) end_[i] = gamma[i] - last_state_[i];
  for (std::size_t i = 0; i < X; ++i) {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      for (std::size_t k = 0; k < i; ++k) row(i)[lane] -= L(i, k)[lane] * row(k)[lane];
      row(i)[lane] *= L(i, i)[lane];
    }
  }
  for (std::size_t i = X; i-- > 0;) {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      for (std::size_t k = i + 1; k < X; ++k) row(i)[lane] -= L(k, i)[lane] * row(k)[lane];
      row(i)[lane] *= L(i, i)[lane];
    }
  }
  std::ranges::copy(end_, memory_.group().multiplier);
}

/// The steps of the ends and of fixed unknowns, which are zero, and the multipliers of the last node's rows, ν + ρ d.
void LaneKkt::write_ends(double* primal, double* multipliers) const {
  const Eigen::Index N = entries_.intervals;
  for (const Eigen::Index first : entries_.node_unknowns) {
    std::fill_n(primal + first * lane_count, lane_count, 0.0);
    std::fill_n(primal + (first + N) * lane_count, lane_count, 0.0);
  }
  entries_.write_fixed(lane_count, primal);
  const auto node = static_cast<std::size_t>(entries_.shape.node);
  for (std::size_t i = 0; i < static_cast<std::size_t>(entries_.shape.node_sums); ++i) {
    double* const to = multipliers + (entries_.equality_rows[i] + N) * lane_count;
    const std::size_t at = (node + i) * lane_count;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      to[lane] = end_[at + lane] + lane_weights_[at + lane] * last_state_[at + lane];
    }
  }
}

}  // namespace dmocbench::kkt
