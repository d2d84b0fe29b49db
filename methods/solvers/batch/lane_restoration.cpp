// The restoration of feasibility of `LaneRun`: steps of least length to where the linearised constraints hold, until
// the filter accepts a point. Where there are bounds, or these steps end, an instance is left to `interior_point`.
#include <cmath>

#include "methods/solvers/batch/lane_run.hpp"

namespace dmocbench::batch {

/// The lane goes back to the point where its search began. False if it cannot be restored.
bool LaneRun::begin_restoration(std::size_t number) {
  Lane& lane = lanes_[number];
  const double theta = values_.theta[index_of(number)];
  if (lane.phase == LanePhase::restoring || problem_.has_bounds() || theta <= options_.tolerance) {
    give_up(number);
    return false;
  }
  lane.line_search.begin_restoration(values_in(number, values_));
  lane.phase = LanePhase::restoring;
  lane.is_searching = false;
  lane.moves = false;
  lane.waits = true;
  return true;
}

bool LaneRun::try_feasibility_step(std::size_t number) {
  ++lanes_[number].evaluations.objective;
  ++lanes_[number].evaluations.constraints;
  const Eigen::Index at = index_of(number);
  const double theta = trial_values_.theta[at];
  return std::isfinite(theta) && std::isfinite(trial_values_.objective[at]) &&
         interior_point::FilterLineSearch::restores(values_.theta[at], theta, length_[at]);
}

/// Whether the filter accepts the point that a step has led to.
bool LaneRun::is_restored(std::size_t number) {
  Lane& lane = lanes_[number];
  if (lane.line_search.may_return_to(values_in(number, values_), lane.line_search.restored_theta())) return true;
  if (lane.line_search.has_no_room(length_[index_of(number)])) give_up(number);
  return false;
}

}  // namespace dmocbench::batch
