// The line search of `LaneRun`.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "methods/solvers/batch/lane_run.hpp"
#include "methods/solvers/interior_point/constants.hpp"

namespace dmocbench::batch {

namespace {

using interior_point::Filter;
using namespace interior_point::constants;  // NOLINT(google-build-using-namespace): named as in the papers

}  // namespace

/// From the fraction to the boundary (15a), halve α until filter and decrease accept the point.
void LaneRun::search_lines() {
  const PhaseClock::Within within(clock_, BatchPhase::line_search);
  const OfLanes mu = of_lanes([](const Lane& lane) { return lane.mu; });
  const OfLanes tau = (1.0 - mu).max(tau_min);  // (8)
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
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) fresh[lane] = lanes_[lane].phase == Phase::fresh;
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
      lane.is_searching = lane.phase == Phase::restoring ? !try_feasibility_step(number) : !try_step(number);
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
  if (lane.phase == Phase::restoring) {
    lane.is_newton = false;
    lane.smallest_length = shortest_feasibility_step;
    return;
  }
  lane.is_newton = lane.shift.value() == 0.0;
  lane.shift.keep();
  const double theta = values_.theta[index_of(number)];
  double length = Filter::margin;  // (23)
  if (lane.derivative < 0.0) {
    length = std::min(length, -Filter::margin * theta / lane.derivative);
    if (theta <= lane.theta_min) {
      length = std::min(length, delta * std::pow(theta, s_theta) / std::pow(-lane.derivative, s_phi));
    }
  }
  lane.smallest_length = std::max(gamma_alpha * length, shortest_step);
}

double LaneRun::barrier_function(std::size_t lane, const LaneValues& values) const {
  return values.objective[index_of(lane)] + lanes_[lane].mu * values.barrier[index_of(lane)];
}

/// Whether filter and decrease allow the trial point, A-5.2 to. Differences within rounding count as
/// none.
bool LaneRun::try_step(std::size_t number) {
  Lane& lane = lanes_[number];
  ++lane.evaluations.objective;
  ++lane.evaluations.constraints;
  const double length = length_[index_of(number)];
  const double theta_before = values_.theta[index_of(number)];
  const double theta = trial_values_.theta[index_of(number)];
  const double objective = values_.objective[index_of(number)];
  const double phi_before = barrier_function(number, values_);
  const double phi = barrier_function(number, trial_values_);
  if (!std::isfinite(theta) || !std::isfinite(phi)) return false;
  // Where the violation leaps, the linearised constraints say nothing of the point, however low its cost.
  if (theta > std::max(most_growth * theta_before, lane.theta_at_begin)) return false;
  constexpr double safety = 10.0;  // φ is a sum of as many terms as there are unknowns
  const double rounding = safety * std::sqrt(static_cast<double>(problem_.variable_count())) *
                          std::numeric_limits<double>::epsilon() *
                          (std::abs(objective) + std::abs(phi_before - objective));
  if (!lane.filter.accepts(theta - rounding_of_theta_, phi - rounding)) return false;
  const bool is_nearer = theta <= (1.0 - Filter::margin) * theta_before;  // (18a)
  const bool is_rounding = theta <= rounding_of_theta_ && theta_before <= rounding_of_theta_;
  const bool is_descent = lane.derivative < 0.0 &&
                          length * std::pow(-lane.derivative, s_phi) > delta * std::pow(theta_before, s_theta);  // (19)
  if (theta_before <= lane.theta_min && (is_descent || is_rounding)) {
    // Where the constraints hold but for rounding, φ may have to rise for them to hold better still.
    const bool is_decrease = phi - phi_before <= eta_phi * length * lane.derivative + rounding;  // (20)
    return is_decrease || (is_rounding && is_nearer);
  }
  const bool is_lower = phi - phi_before <= -Filter::margin * theta_before + rounding;  // (18b)
  if (!is_nearer && !is_lower) return false;
  lane.filter.add(theta_before, phi_before);  // (22)
  return true;
}

/// A-1, with the values at the start.
void LaneRun::evaluate_start(std::size_t number) {
  Lane& lane = lanes_[number];
  const double theta = trial_values_.theta[index_of(number)];
  ++lane.evaluations.objective;
  ++lane.evaluations.constraints;
  if (!std::isfinite(theta) || !std::isfinite(trial_values_.objective[index_of(number)])) return give_up(number);
  lane.theta_at_begin = std::max(1.0, theta);
  lane.theta_min = theta_min_ratio * lane.theta_at_begin;
  lane.theta_max = theta_max_ratio * lane.theta_at_begin;
  lane.filter.reset(lane.theta_max);
}

}  // namespace dmocbench::batch
