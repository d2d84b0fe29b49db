#pragma once

#include <algorithm>
#include <vector>

namespace dmocbench::interior_point {

/// The filter of the line search: pairs (θ, φ) of violation and barrier function, of which no later point may be as bad
/// in both (Fletcher and Leyffer; Wächter and Biegler 2006, section 2.3, whose constants these are).
class Filter {
 public:
  /// γ_θ = γ_φ: how much better a point has to be, as a share of the violation.
  static constexpr double margin = 1e-5;

  /// Removes all pairs; from now on points with θ > θ_max are rejected, (21).
  void reset(double theta_max) {
    theta_max_ = theta_max;
    pairs_.clear();
  }

  [[nodiscard]] bool accepts(double theta, double phi) const {
    if (!(theta <= theta_max_)) return false;
    return std::ranges::none_of(pairs_, [&](const Pair& pair) { return theta >= pair.theta && phi >= pair.phi; });
  }

  /// Refuses points that are not better than this one, (22).
  void add(double theta, double phi) { pairs_.push_back({(1.0 - margin) * theta, phi - margin * theta}); }

 private:
  struct Pair {
    double theta;
    double phi;
  };
  double theta_max_ = 0.0;
  std::vector<Pair> pairs_;
};

}  // namespace dmocbench::interior_point
