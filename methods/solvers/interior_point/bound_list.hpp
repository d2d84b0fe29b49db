#pragma once

#include <vector>

#include <Eigen/Core>

namespace dmocbench::interior_point {

/// Where a vector has bounds on one side, and their values. Entries whose two bounds are equal have none: they do not
/// move. In what follows z are the multipliers of the bounds, in their order, and `side` is 1 for lower bounds and -1
/// for upper ones.
struct BoundList {
  std::vector<Eigen::Index> entries;
  Eigen::VectorXd values;

  /// How far bound b is from the vector's entry; positive inside.
  [[nodiscard]] double distance(const Eigen::VectorXd& vector, double side, std::size_t b) const {
    return side * (vector[entries[b]] - values[static_cast<Eigen::Index>(b)]);
  }
};

/// The bounds of a vector on the side of `bounds`; `others` are those of the other side.
[[nodiscard]] BoundList bounds_of(const Eigen::VectorXd& bounds, const Eigen::VectorXd& others);

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

/// δz = μ/d - z - (z/d) δd.
[[nodiscard]] Eigen::VectorXd bound_step(const Eigen::VectorXd& vector, const Eigen::VectorXd& step,
                                         const BoundList& bounds, const Eigen::VectorXd& z, double side, double mu);

/// The longest step, at most 1, that leaves `1 - share` of the distance from every bound; of z, from zero.
[[nodiscard]] double longest_step(const Eigen::VectorXd& vector, const Eigen::VectorXd& step, const BoundList& bounds,
                                  double side, double share);
[[nodiscard]] double longest_step(const Eigen::VectorXd& z, const Eigen::VectorXd& step, double share);

/// Largest |d z - μ|.
[[nodiscard]] double complementarity(const Eigen::VectorXd& vector, const BoundList& bounds, const Eigen::VectorXd& z,
                                     double side, double mu);
/// Keeps z within a factor of μ/d, so that it cannot leave the neighbourhood of the barrier's own multipliers.
void keep_near_barrier(const Eigen::VectorXd& vector, const BoundList& bounds, double side, double mu,
                       Eigen::VectorXd& z);

}  // namespace dmocbench::interior_point
