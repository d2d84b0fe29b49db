#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>

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

/// The numbers that the line search compares points by.
struct PointValues {
  double objective = 0.0;  ///< f
  double theta = 0.0;      ///< θ = Σ |c_i|
  double phi = 0.0;        ///< φ_μ = f - μ Σ ln d
};

/// Accepts the steps of a solve: the filter line search of Wächter and Biegler, A-5.2 to. Three rules are
/// not theirs (README.md): differences within rounding count as none, the violation may not grow by large factors, and
/// a filter that blocks the way is emptied.
class FilterLineSearch {
 public:
  /// Call before a solve of a program with this many unknowns from a point with the violation θ, where violations below
  /// `rounding_of_theta` are rounding.
  void begin(double theta, double rounding_of_theta, Eigen::Index unknowns);
  /// Call before another barrier problem: the filter forgets its points.
  void forget();

  /// α_min, (23): from a point with the violation θ along a step with this derivative of φ.
  [[nodiscard]] double smallest_length(double theta, double derivative) const;

  /// Whether the point `to` is acceptable, a step of this length away from the point `from`. `derivative` and `length`
  /// belong to the Newton step, also where its correction is tried. The filter takes up `from` by rule A-7.
  [[nodiscard]] bool accept(const PointValues& from, const PointValues& to, double derivative, double length);

  /// Begins restoration, A-9, at a point, which the filter takes up. Restoration has to reduce its violation to the
  /// share κ_resto.
  void begin_restoration(const PointValues& at);
  /// The violation at which restoration may end.
  [[nodiscard]] double restored_theta() const { return restored_theta_; }
  /// Whether a feasibility step of this length reduces the violation enough to be taken.
  [[nodiscard]] static bool restores(double theta_from, double theta_to, double length);
  /// Whether restoration may end at a point with at most this violation.
  [[nodiscard]] bool may_return_to(const PointValues& at, double enough) const {
    return at.theta <= enough && filter_.accepts(at.theta, at.phi);
  }
  /// Counts a feasibility step of this length. True after many very short ones in a row, where bounds leave no room.
  [[nodiscard]] bool has_no_room(double length);

 private:
  [[nodiscard]] bool decreases(const PointValues& from, const PointValues& to, double derivative, double length,
                               double rounding);
  void restart(double theta_max);
  void end_search(double theta);

  Filter filter_;
  bool is_blocked_ = false;      // the last rejected point was rejected by the filter
  int blocked_searches_ = 0;     // in a row, whose last rejection was the filter's
  int emptied_ = 0;              // how often the filter was
  double restored_theta_ = 0.0;  // the violation at which restoration may end
  int very_short_steps_ = 0;     // of restoration, in a row
  double theta_at_start_ = 1.0;  // at least 1
  double theta_min_ = 0.0;
  double theta_max_ = 0.0;
  double rounding_of_theta_ = 0.0;
  double rounding_of_phi_ = 0.0;  // of its terms
};

}  // namespace dmocbench::interior_point
