// The line search of `LaneRun`.
#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/solvers/batch/lane_run.hpp"
#include "methods/solvers/interior_point/barrier_parameter.hpp"

namespace dmocbench::batch {

/// From the fraction to the boundary (15a), halve α until filter and decrease accept the point.
void LaneRun::search_lines() {
  const PhaseClock::Within within(clock_, BatchPhase::line_search);
  const OfLanes mu = of_lanes([](const Lane& lane) { return lane.mu; });
  const OfLanes tau = of_lanes([](const Lane& lane) { return interior_point::tau_of(lane.mu); });
  length_.setZero();
  if (std::ranges::any_of(lanes_, &Lane::moves)) {
    OfLanes derivative;
    lane_loops().dot(problem_.gradient().data(), step_.data(), problem_.variable_count(), derivative.data());
    share_of_step_ = problem_.length_of(step_, primal_, derivative, values_.objective);
    OfLanes longest = OfLanes::Ones();
    if (problem_.has_bounds()) {
      derivative += mu * problem_.bounds().barrier_derivative(primal_, step_);
      longest = problem_.bounds().fraction_to_boundary(primal_, step_, tau);
    }
    for (std::size_t lane = 0; lane < instance_lanes; ++lane) {
      if (!lanes_[lane].moves) continue;
      lanes_[lane].derivative = derivative[index_of(lane)];
      length_[index_of(lane)] = longest[index_of(lane)];
      begin_search(lane);
    }
  }
  LaneMask fresh{};
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) fresh[lane] = lanes_[lane].phase == LanePhase::fresh;
  search(fresh);
  primal_.swap(trial_);
  std::swap(values_, trial_values_);
  lane_loops().set_to_sum(multipliers_.data(), multipliers_.data(), length_.data(), multiplier_step_.data(),
                          multipliers_.size());
  if (!problem_.has_bounds()) return;
  // The step of z is that from the point before, which now stands in `trial_`.
  problem_.bounds().set_multiplier_step(trial_, z_, mu, step_, z_step_);
  const OfLanes of_z = problem_.bounds().multiplier_fraction_to_boundary(z_, z_step_, tau);
  problem_.bounds().update_multipliers(primal_, z_step_, (length_ > 0.0).select(of_z, 0.0), mu, z_);
}

/// Evaluates trial points until all lanes have one that is accepted. A lane that has one keeps its length, and gets the
/// same values again.
void LaneRun::search(const LaneMask& fresh) {
  bool is_first = true;
  bool has_returned = false;  // a lane goes back to where the search began
  OfLanes push;
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) push[index_of(lane)] = push_of(lane);
  do {
    has_returned = false;
    lane_loops().set_to_sum(trial_.data(), primal_.data(), length_.data(), step_.data(), primal_.size());
    {
      const PhaseClock::Within within(clock_, BatchPhase::tapes);
      problem_.evaluate(fresh, push, trial_, trial_values_);
    }
    for (std::size_t number = 0; number < instance_lanes; ++number) {
      Lane& lane = lanes_[number];
      if (is_first && fresh[number]) evaluate_start(number);
      if (!lane.is_searching) continue;
      lane.is_searching = lane.phase == LanePhase::restoring ? !try_feasibility_step(number) : !try_step(number);
      if (!lane.is_searching) continue;
      length_[index_of(number)] *= 0.5;
      if (length_[index_of(number)] >= lane.smallest_length) continue;
      length_[index_of(number)] = 0.0;
      has_returned = begin_restoration(number) || has_returned;
    }
    is_first = false;
  } while (has_returned || std::ranges::any_of(lanes_, &Lane::is_searching));
}

void LaneRun::begin_search(std::size_t number) {
  Lane& lane = lanes_[number];
  lane.is_searching = true;
  if (lane.phase == LanePhase::restoring) {
    lane.is_newton = false;
    lane.smallest_length = constants::shortest_feasibility_step;
    return;
  }
  lane.is_newton = lane.shift.value() == 0.0;
  lane.shift.keep();
  lane.smallest_length = lane.line_search.smallest_length(values_.theta[index_of(number)], lane.derivative);
}

interior_point::PointValues LaneRun::values_in(std::size_t number, const LaneValues& values) const {
  const Eigen::Index at = index_of(number);
  const double objective = values.objective[at];
  return {objective, values.theta[at], objective + lanes_[number].mu * values.barrier[at]};
}

/// Whether filter and decrease allow the trial point.
bool LaneRun::try_step(std::size_t number) {
  Lane& lane = lanes_[number];
  ++lane.evaluations.objective;
  ++lane.evaluations.constraints;
  return lane.line_search.accept(values_in(number, values_), values_in(number, trial_values_), lane.derivative,
                                 length_[index_of(number)]);
}

/// A-1, with the values at the start.
void LaneRun::evaluate_start(std::size_t number) {
  Lane& lane = lanes_[number];
  const double theta = trial_values_.theta[index_of(number)];
  ++lane.evaluations.objective;
  ++lane.evaluations.constraints;
  if (!std::isfinite(theta) || !std::isfinite(trial_values_.objective[index_of(number)])) return give_up(number);
  lane.line_search.begin(theta, rounding_of_theta_, problem_.variable_count());
}

}  // namespace dmocbench::batch
