#include "methods/solvers/interior_point/filter_line_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "methods/solvers/interior_point/constants.hpp"

namespace dmocbench::interior_point {

namespace {

/// Left and right side of the switching condition (19): for a step of this length, and for the violation θ.
double switching_left(double length, double derivative) { return length * std::pow(-derivative, constants::s_phi); }
double switching_right(double theta) { return constants::delta * std::pow(theta, constants::s_theta); }

}  // namespace

void FilterLineSearch::begin(double theta, double rounding_of_theta, Eigen::Index unknowns) {
  constexpr double safety = 10.0;  // φ is a sum of as many terms as there are unknowns
  theta_at_start_ = std::max(1.0, theta);
  theta_min_ = constants::theta_min_ratio * theta_at_start_;
  theta_max_ = constants::theta_max_ratio * theta_at_start_;
  rounding_of_theta_ = rounding_of_theta;
  rounding_of_phi_ = safety * std::sqrt(static_cast<double>(unknowns)) * std::numeric_limits<double>::epsilon();
  emptied_ = 0;
  forget();
}

void FilterLineSearch::forget() { restart(theta_max_); }

void FilterLineSearch::restart(double theta_max) {
  filter_.reset(theta_max);
  is_blocked_ = false;
  blocked_searches_ = 0;
}

void FilterLineSearch::begin_restoration(const PointValues& at) {
  filter_.add(at.theta, at.phi);
  is_blocked_ = false;
  blocked_searches_ = 0;
  restored_theta_ = constants::kappa_resto * at.theta;
  very_short_steps_ = 0;
}

bool FilterLineSearch::restores(double theta_from, double theta_to, double length) {
  return theta_to <= (1.0 - constants::sufficient_decrease * length) * theta_from;
}

bool FilterLineSearch::has_no_room(double length) {
  very_short_steps_ = length < constants::very_short_step ? very_short_steps_ + 1 : 0;
  return very_short_steps_ >= constants::most_blocked_steps;
}

double FilterLineSearch::smallest_length(double theta, double derivative) const {
  constexpr double shortest = 1e-14;
  double length = Filter::margin;
  if (derivative < 0.0) {
    length = std::min(length, -Filter::margin * theta / derivative);
    if (theta <= theta_min_) length = std::min(length, switching_right(theta) / switching_left(1.0, derivative));
  }
  return std::max(constants::gamma_alpha * length, shortest);
}

bool FilterLineSearch::accept(const PointValues& from, const PointValues& to, double derivative, double length) {
  const double rounding = rounding_of_phi_ * (std::abs(from.objective) + std::abs(from.phi - from.objective));
  // Where the violation leaps, the linearised constraints are meaningless there, however low its cost.
  const bool leaps = to.theta > std::max(constants::most_growth * from.theta, theta_at_start_);
  const bool is_usable = std::isfinite(to.theta) && std::isfinite(to.phi) && !leaps;
  const bool passes = is_usable && filter_.accepts(to.theta - rounding_of_theta_, to.phi - rounding);
  if (!passes || !decreases(from, to, derivative, length, rounding)) {
    is_blocked_ = is_usable && !passes;
    return false;
  }
  end_search(from.theta);
  return true;
}

/// where `rounding` of φ counts as no difference.
bool FilterLineSearch::decreases(const PointValues& from, const PointValues& to, double derivative, double length,
                                 double rounding) {
  const bool is_nearer = to.theta <= (1.0 - Filter::margin) * from.theta;  // (18a)
  const bool is_rounding = to.theta <= rounding_of_theta_ && from.theta <= rounding_of_theta_;
  const bool is_descent = derivative < 0.0 && switching_left(length, derivative) > switching_right(from.theta);  // (19)
  const double rise = to.phi - from.phi;
  if (from.theta <= theta_min_ && (is_descent || is_rounding)) {
    // Where the constraints hold up to rounding, φ may have to rise for them to hold better still.
    const bool is_decrease = rise <= constants::eta_phi * length * derivative + rounding;  // (20)
    return is_decrease || (is_rounding && is_nearer);
  }
  const bool is_lower = rise <= -Filter::margin * from.theta + rounding;  // (18b)
  if (!is_nearer && !is_lower) return false;
  filter_.add(from.theta, from.phi);  // (22)
  return true;
}

/// Empties the filter after several searches in a row whose last rejection was the filter's. Without its pairs only
/// θ_max keeps the violation from growing step by step as the cost falls: it becomes the violation of the start, or of
/// this point.
void FilterLineSearch::end_search(double theta) {
  blocked_searches_ = is_blocked_ ? blocked_searches_ + 1 : 0;
  is_blocked_ = false;
  if (blocked_searches_ < constants::filter_reset_trigger || emptied_ == constants::max_filter_resets) return;
  ++emptied_;
  restart(std::max(theta_at_start_, theta));
}

}  // namespace dmocbench::interior_point
