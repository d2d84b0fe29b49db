#pragma once

#include <Eigen/Core>

#include "methods/solvers/interior_point/filter.hpp"

namespace dmocbench::interior_point {

/// The numbers that the line search compares points by.
struct PointValues {
  double objective = 0.0;  ///< f
  double theta = 0.0;      ///< θ = Σ |c_i|
  double phi = 0.0;        ///< φ_μ = f - μ Σ ln d
};

/// Which steps a solve takes: the filter line search of Wächter and Biegler, A-5.2 to. Three rules are
/// not theirs (README.md): differences within rounding count as none, the violation may not grow by large factors, and
/// a filter that blocks the way is emptied.
class FilterLineSearch {
 public:
  /// Before a solve of a program with so many unknowns from a point with the violation θ, where violations below
  /// `rounding_of_theta` are rounding.
  void begin(double theta, double rounding_of_theta, Eigen::Index unknowns);
  /// Before another barrier problem: the filter forgets its points.
  void forget();

  /// α_min, (23): from a point with the violation θ along a step with this derivative of φ.
  [[nodiscard]] double smallest_length(double theta, double derivative) const;

  /// Whether the point `to` is acceptable, a step of this length away from the point `from`. `derivative` and `length`
  /// are those of the Newton step, also where its correction is tried. The filter takes up `from` where A-7 says so.
  [[nodiscard]] bool accept(const PointValues& from, const PointValues& to, double derivative, double length);

  /// Before restoration: the filter takes up the point that is left, A-9.
  void leave(const PointValues& at);
  /// Whether restoration may end at a point.
  [[nodiscard]] bool may_return_to(const PointValues& at) const { return filter_.accepts(at.theta, at.phi); }

 private:
  [[nodiscard]] bool decreases(const PointValues& from, const PointValues& to, double derivative, double length,
                               double rounding);
  void restart(double theta_max);
  void end_search(double theta);

  Filter filter_;
  bool is_blocked_ = false;      // the last point that was refused was so by the filter
  int blocked_searches_ = 0;     // in a row, whose last refusal was the filter's
  int emptied_ = 0;              // how often the filter was
  double theta_at_start_ = 1.0;  // at least 1
  double theta_min_ = 0.0;
  double theta_max_ = 0.0;
  double rounding_of_theta_ = 0.0;
  double rounding_of_phi_ = 0.0;  // of its terms
};

}  // namespace dmocbench::interior_point
