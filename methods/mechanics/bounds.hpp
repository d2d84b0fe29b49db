#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// lower <= x <= upper, entry by entry; ±infinity where there is no bound, equal entries where x is fixed. Without
/// entries nothing is bounded.
struct Bounds {
  Eigen::VectorXd lower;  ///< one entry per component, or none
  Eigen::VectorXd upper;  ///< one entry per component, or none

  /// -infinity <= x <= infinity, `size` entries.
  [[nodiscard]] static Bounds none(Eigen::Index size);
  /// lower <= x <= upper, the same for all of `size` entries.
  [[nodiscard]] static Bounds all(Eigen::Index size, double lower, double upper);
  /// x = value.
  [[nodiscard]] static Bounds fixed(const Eigen::VectorXd& value);

  /// Removes the bounds of component i.
  void free(Eigen::Index i);

  /// True if nothing is bounded.
  [[nodiscard]] bool empty() const noexcept { return lower.size() == 0 && upper.size() == 0; }
  /// True if component i has only one value.
  [[nodiscard]] bool is_fixed(Eigen::Index i) const { return lower[i] == upper[i]; }
  /// True if every component has only one value.
  [[nodiscard]] bool all_fixed() const { return lower == upper; }
  /// True if entry i, or any entry, has a finite bound on either side.
  [[nodiscard]] bool is_bounded(Eigen::Index i) const;
  /// True if a component has a finite bound.
  [[nodiscard]] bool any() const;
};

/// Bounds on the state at an end of the horizon.
struct EndBounds {
  Bounds q;       ///< n entries
  Bounds v;       ///< n entries
  Bounds y = {};  ///< first-order states, l entries

  /// (q, v, y) = state, (eq:LOCP3).
  [[nodiscard]] static EndBounds fixed(const BoundaryState& state);
  /// Removes the bounds of q_i (v_i).
  EndBounds& free_configuration(Eigen::Index i);
  /// Leaves the velocity of component i free.
  EndBounds& free_velocity(Eigen::Index i);
  /// Leaves the first-order state y_i free.
  EndBounds& free_first_order(Eigen::Index i);

  /// True if q and v of this end are given completely.
  [[nodiscard]] bool all_fixed() const { return q.all_fixed() && v.all_fixed(); }
};

/// Bounds on the state at a time between the ends, such as a waypoint: every grid gets a node there. Equal bounds make
/// an equation. A part without entries is not bounded.
struct InteriorBounds {
  double relative_time = 0.0;  ///< t / T, between 0 and 1; where T is given, the time t is t / horizon()
  Bounds q = {};               ///< n entries or none
  Bounds v = {};               ///< n entries or none
  Bounds y = {};               ///< first-order states, l entries or none
};

/// lower <= T <= upper; a fixed horizon has equal bounds.
struct HorizonBounds {
  double lower = 0.0;  ///< least T
  double upper = 0.0;  ///< largest T
  /// True if T is an unknown.
  [[nodiscard]] bool is_free() const noexcept { return lower != upper; }
};

/// All bounds of a problem.
struct ProblemBounds {
  EndBounds first;        ///< on (q, q̇, y)(0)
  EndBounds last;         ///< on (q, q̇, y)(T)
  HorizonBounds horizon;  ///< on T
  Bounds q;               ///< at every node, n entries or none
  Bounds v;               ///< at every stage, n entries or none
  Bounds u;               ///< at every stage, m entries or none
  Bounds y;               ///< on first-order states at every node, l entries or none
  Bounds path;            ///< on the path constraints h at every stage, one entry each; h >= 0 where there are none
  Bounds integrals;       ///< on the integrals of `Problem::integrands` over [0, T], one entry each
  std::vector<InteriorBounds> interior;  ///< at times between the ends

  /// On h, with `count` entries: `path`, or h >= 0 where that is empty.
  [[nodiscard]] Bounds of_path(Eigen::Index count) const;

  /// The i whose velocity has a bound, in ascending order.
  [[nodiscard]] std::vector<Eigen::Index> bounded_velocities() const;
};

}  // namespace dmocbench
