#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/runtime/long_vectors.hpp"
#include "methods/solvers/interior_point/bound_formulas.hpp"

namespace dmocbench::interior_point {

/// One number per unknown and per slack: a point, a gradient, a diagonal.
struct Primal {
  Eigen::VectorXd x;
  Eigen::VectorXd s;  ///< one per inequality
};

/// Multipliers of the bounds of x below, above, of s below, above.
using BoundMultipliers = std::array<Eigen::VectorXd, 4>;

/// A point of the primal-dual method, or a step from one to another.
struct Iterate : Primal {
  Eigen::VectorXd multipliers;  ///< λ, one per constraint
  BoundMultipliers z;           ///< z >= 0
};

/// Consecutive entries of x or s that have a bound on the same side.
struct BoundStretch {
  using Number = double;

  Eigen::VectorXd Primal::*part;  ///< &Primal::x or &Primal::s
  double side;                    ///< 1 for lower bounds, -1 for upper ones
  std::size_t set;                ///< in which z their multipliers stand
  Eigen::Index entry;             ///< the first of the entries
  Eigen::Index bound;             ///< the position of its multiplier in z
  Eigen::ArrayXd values;

  [[nodiscard]] auto entries(const Primal& of) const { return (of.*part).segment(entry, values.size()).array(); }
  [[nodiscard]] auto entries(Primal& of) const { return (of.*part).segment(entry, values.size()).array(); }
  [[nodiscard]] auto multipliers(const BoundMultipliers& z) const {
    return z[set].segment(bound, values.size()).array();
  }
  [[nodiscard]] auto multipliers(BoundMultipliers& z) const { return z[set].segment(bound, values.size()).array(); }
  /// Distances from the bounds; positive inside.
  [[nodiscard]] auto distances(const Primal& of) const { return side * (entries(of) - values); }

  // The combinations that `BoundFormulas` uses for the numbers of a stretch.
  [[nodiscard]] static double all(double value) { return value; }
  [[nodiscard]] static double sum(const auto& numbers) { return numbers.sum(); }
  [[nodiscard]] static double smaller(double than, const auto& numbers) { return std::min(than, numbers.minCoeff()); }
  [[nodiscard]] static double larger(double than, const auto& numbers) { return std::max(than, numbers.maxCoeff()); }
  /// The longest step, at most 1, along which no distance shrinks by more than the share τ.
  [[nodiscard]] static double shortened(double loss, double tau) { return loss > tau ? tau / loss : 1.0; }
  [[nodiscard]] static auto where_moving(double /*length*/, const auto& moved, const auto& /*kept*/) { return moved; }
};

/// The bounds of a barrier problem. Entries whose two bounds are equal have none: they do not move.
class BarrierBounds : public BoundFormulas<BoundStretch> {
 public:
  /// `lower` and `upper` bound x and s; infinite where there is no bound.
  BarrierBounds(const Primal& lower, const Primal& upper);

  /// Other values of the same bounds.
  void read(const Primal& lower, const Primal& upper);
  /// Sizes z and sets all of it to one value.
  void set_multipliers(double value, BoundMultipliers& z) const;
  /// -Σ ln d
  [[nodiscard]] double barrier(const Primal& at) const;

 private:
  std::array<Eigen::Index, 4> counts_{};  // of bounds in each set
};

/// Moves a number away from its bounds by this share of their size, at most of their distance. Section 3.6.
[[nodiscard]] double pushed_inside(double value, double lower, double upper, double share);

/// Calls `visit(i)` for every entry i that has a bound on one side at least, in ascending order. Most have none, and
/// are skipped many at a time, long vectors by several threads.
template <class Visit>
void for_each_bounded(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const Visit& visit) {
  constexpr Eigen::Index at_once = 32;
  const auto have_bounds = [&](Eigen::Index begin, Eigen::Index count) {
    return lower.segment(begin, count).maxCoeff() != -unbounded || upper.segment(begin, count).minCoeff() != unbounded;
  };
  const auto visit_some = [&](Eigen::Index first, Eigen::Index length) {
    for (Eigen::Index begin = first; begin < first + length; begin += at_once) {
      const Eigen::Index count = std::min(at_once, first + length - begin);
      if (!have_bounds(begin, count)) continue;
      for (Eigen::Index i = begin; i < begin + count; ++i) {
        if (lower[i] != -unbounded || upper[i] != unbounded) visit(i);
      }
    }
  };
  if (part_count(static_cast<std::size_t>(lower.size()), entries_per_stretch) == 1) {
    return visit_some(0, lower.size());
  }
  struct Stretch {
    Eigen::Index begin = 0;
    Eigen::Index length = 0;
  };
  std::array<Stretch, most_parts> some{};  // those with bounds; the others are left empty
  for_stretches(lower.size(), [&](std::size_t s, Eigen::Index begin, Eigen::Index length) {
    if (have_bounds(begin, length)) some[s] = {begin, length};
  });
  for (const Stretch& stretch : some) visit_some(stretch.begin, stretch.length);
}

}  // namespace dmocbench::interior_point
