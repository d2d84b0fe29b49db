#pragma once

#include <algorithm>
#include <vector>

namespace dmocbench::interior_point {

/// Pairs of violation and barrier function that no later point may be as bad as in both (Fletcher and Leyffer; Wächter
/// and Biegler 2006, whose constants these are).
class Filter {
 public:
  /// The margin by which a point has to be better, as a share of the violation.
  static constexpr double margin = 1e-5;

  /// Forgets all pairs; from now on points whose violation exceeds `largest_violation` are refused.
  void reset(double largest_violation) {
    largest_violation_ = largest_violation;
    pairs_.clear();
  }

  [[nodiscard]] bool accepts(double violation, double function) const {
    if (!(violation <= largest_violation_)) return false;
    return std::none_of(pairs_.begin(), pairs_.end(),
                        [&](const Pair& pair) { return violation >= pair.violation && function >= pair.function; });
  }

  /// Refuses points that are not better than this one.
  void add(double violation, double function) {
    pairs_.push_back({(1.0 - margin) * violation, function - margin * violation});
  }

 private:
  struct Pair {
    double violation;
    double function;
  };
  double largest_violation_ = 0.0;
  std::vector<Pair> pairs_;
};

}  // namespace dmocbench::interior_point
