#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/runtime/long_vectors.hpp"

namespace dmocbench::interior_point {

/// One number per unknown and per slack: a point, a gradient, a diagonal.
struct Primal {
  Eigen::VectorXd x;
  Eigen::VectorXd s;  ///< one per inequality
};

/// A point of the primal-dual method, or a step from one to another.
struct Iterate : Primal {
  Eigen::VectorXd multipliers;       ///< λ, one per constraint
  std::array<Eigen::VectorXd, 4> z;  ///< multipliers of the bounds of x below, above, of s below, above; z >= 0
};

/// Consecutive entries of x or s that have a bound on the same side.
struct BoundStretch {
  Eigen::VectorXd Primal::*part;  ///< &Primal::x or &Primal::s
  double side;                    ///< 1 for lower bounds, -1 for upper ones
  std::size_t set;                ///< in which z their multipliers stand
  Eigen::Index entry;             ///< the first of the entries
  Eigen::Index bound;             ///< the position of its multiplier in z
  Eigen::ArrayXd values;

  [[nodiscard]] auto entries(const Primal& of) const { return (of.*part).segment(entry, values.size()).array(); }
  [[nodiscard]] auto entries(Primal& of) const { return (of.*part).segment(entry, values.size()).array(); }
  [[nodiscard]] auto z(const Iterate& of) const { return of.z[set].segment(bound, values.size()).array(); }
  [[nodiscard]] auto z(Iterate& of) const { return of.z[set].segment(bound, values.size()).array(); }
  /// From the bounds; positive inside.
  [[nodiscard]] auto distances(const Primal& of) const { return side * (entries(of) - values); }
};

/// The bounds of a barrier problem. Entries whose two bounds are equal have none: they do not move. d is the distance
/// of an entry from its bound; of two signs the upper one is that of lower bounds.
class BarrierBounds {
 public:
  /// `lower` and `upper` bound x and s; infinite where there is no bound.
  BarrierBounds(const Primal& lower, const Primal& upper);

  /// Other values of the same bounds.
  void read(const Primal& lower, const Primal& upper);

  [[nodiscard]] Eigen::Index count() const noexcept { return count_; }

  /// Sizes z and sets all of it to one value.
  void set_multipliers(double value, Iterate& at) const;
  /// z = max(μ/d, ±gradient): multipliers that balance the gradient where they can.
  void balance(double mu, const Primal& gradient, Iterate& at) const;

  /// -Σ ln d
  [[nodiscard]] double barrier(const Primal& at) const;
  /// Its derivative along a step.
  [[nodiscard]] double barrier_derivative(const Primal& at, const Primal& step) const;
  /// sigma += z/d, and gradient ∓= μ/d, the derivative of μ times the barrier.
  void add_barrier(const Iterate& at, double mu, Primal& sigma, Primal& gradient) const;
  /// diagonal += μ/d², so that a step near a bound costs more.
  void add_nearness(const Primal& at, double mu, Primal& diagonal) const;
  /// gradient ∓= z
  void subtract_multipliers(const Iterate& at, Primal& gradient) const;

  /// Largest |d z - μ|.
  [[nodiscard]] double complementarity(const Iterate& at, double mu) const;

  /// The step of the multipliers that belongs to one of x and s: dz = μ/d - z ∓ (z/d) dx, (12).
  void set_multiplier_step(const Iterate& at, double mu, Iterate& step) const;
  /// The longest step of x and s, at most 1, that leaves the share 1 - τ of every d, (15a).
  [[nodiscard]] double fraction_to_boundary(const Primal& at, const Primal& step, double tau) const;
  /// The same for z, (15b).
  [[nodiscard]] double multiplier_fraction_to_boundary(const Iterate& at, const Iterate& step, double tau) const;
  /// z += length dz, then kept within a factor κ_Σ of μ/d, (14c) and (16).
  void update_multipliers(const Iterate& step, double length, double mu, Iterate& at) const;

 private:
  std::vector<BoundStretch> stretches_;   // set by set
  std::array<Eigen::Index, 4> counts_{};  // of bounds in each set
  Eigen::Index count_ = 0;
};

/// Calls `visit(i)` for every entry i that has a bound on one side at least, in ascending order. Most have none, and
/// are skipped many at a time, those of long vectors by several threads.
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
