#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::interior_point {

/// Where a vector has bounds on one side, and their values. Entries whose two bounds are equal have none: they do not
/// move. In what follows z are the multipliers of the bounds, in their order, and `side` is 1 for lower bounds and -1
/// for upper ones.
struct BoundList {
  /// Bounds of consecutive entries.
  struct Stretch {
    Eigen::Index entry;  ///< the first of the vector
    Eigen::Index bound;  ///< and its number
    Eigen::Index length;
  };
  std::vector<Stretch> stretches;
  Eigen::VectorXd values;

  /// Entries of a vector that have these bounds.
  [[nodiscard]] static auto entries(const Eigen::VectorXd& vector, const Stretch& at) {
    return vector.segment(at.entry, at.length).array();
  }
  [[nodiscard]] static auto entries(Eigen::VectorXd& vector, const Stretch& at) {
    return vector.segment(at.entry, at.length).array();
  }
  /// Their multipliers, or whatever else there is one of per bound.
  [[nodiscard]] static auto of_bounds(const Eigen::VectorXd& z, const Stretch& at) {
    return z.segment(at.bound, at.length).array();
  }
  [[nodiscard]] static auto of_bounds(Eigen::VectorXd& z, const Stretch& at) {
    return z.segment(at.bound, at.length).array();
  }
  /// How far the bounds are from the vector's entries; positive inside.
  [[nodiscard]] auto distances(const Eigen::VectorXd& vector, double side, const Stretch& at) const {
    return side * (entries(vector, at) - of_bounds(values, at));
  }
};

/// Calls `visit(i)` for every entry i that has a bound on one side at least. Most have none: those are passed over many
/// at a time.
template <class Visit>
void for_each_bounded(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const Visit& visit) {
  constexpr Eigen::Index at_once = 32;
  for (Eigen::Index begin = 0; begin < lower.size(); begin += at_once) {
    const Eigen::Index count = std::min(at_once, lower.size() - begin);
    const double highest_lower = lower.segment(begin, count).maxCoeff();
    const double lowest_upper = upper.segment(begin, count).minCoeff();
    if (highest_lower == -unbounded && lowest_upper == unbounded) continue;
    for (Eigen::Index i = begin; i < begin + count; ++i) {
      if (lower[i] != -unbounded || upper[i] != unbounded) visit(i);
    }
  }
}

/// The bounds of a vector on one side.
[[nodiscard]] BoundList bounds_of(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double side);

/// Entries whose bounds are equal.
[[nodiscard]] std::vector<Eigen::Index> fixed_entries(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

/// -Σ ln(distances).
[[nodiscard]] double barrier_of(const Eigen::VectorXd& vector, const BoundList& bounds, double side);
/// Its derivative along a step.
[[nodiscard]] double barrier_slope(const Eigen::VectorXd& vector, const Eigen::VectorXd& step, const BoundList& bounds);

/// Adds z/d to the diagonal, and to the slope the barrier's -μ/d (times the side).
void add_barrier(const Eigen::VectorXd& vector, const BoundList& bounds, const Eigen::VectorXd& z, double side,
                 double mu, Eigen::VectorXd& diagonal, Eigen::VectorXd& slope);
/// Makes steps near bounds cost more: adds μ/d² to the diagonal.
void add_nearness(const Eigen::VectorXd& vector, const BoundList& bounds, double mu, Eigen::VectorXd& diagonal);
/// slope -= z (times the side).
void subtract_multipliers(const BoundList& bounds, const Eigen::VectorXd& z, double side, Eigen::VectorXd& slope);
/// Sets z to what balances the slope (times the side), at least to μ/d.
void balance_slope(const Eigen::VectorXd& vector, const BoundList& bounds, double side, double mu,
                   const Eigen::VectorXd& slope, Eigen::VectorXd& z);

/// δz = μ/d - z - (z/d) δd.
void set_bound_step(const Eigen::VectorXd& vector, const Eigen::VectorXd& step, const BoundList& bounds,
                    const Eigen::VectorXd& z, double side, double mu, Eigen::VectorXd& z_step);

/// The longest step, at most 1, that leaves `1 - share` of the distance from every bound; of z, from zero.
[[nodiscard]] double longest_step(const Eigen::VectorXd& vector, const Eigen::VectorXd& step, const BoundList& bounds,
                                  double side, double share);
[[nodiscard]] double longest_step(const Eigen::VectorXd& z, const Eigen::VectorXd& step, double share);

/// Largest |d z - μ|.
[[nodiscard]] double complementarity_of(const Eigen::VectorXd& vector, const BoundList& bounds,
                                        const Eigen::VectorXd& z, double side, double mu);
/// Keeps z within a factor of μ/d, so that it cannot leave the neighbourhood of the barrier's own multipliers.
void keep_near(const Eigen::VectorXd& vector, const BoundList& bounds, double side, double mu, Eigen::VectorXd& z);

}  // namespace dmocbench::interior_point
