#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/constants.hpp"

namespace dmocbench::interior_point {

/// The formulas for the bounds of a barrier problem, of one instance or of several side by side. d is the
/// distance of an entry from its bound, z its multiplier; of two signs the upper one is for lower bounds.
///
/// `Stretch` gives the places where some bounds on the same side are found, as `BoundStretch` does: `side`, `set`, and
/// the arrays `entries(point)`, `distances(point)`, `multipliers(z)`. A point, a step or a gradient has the type that
/// it takes; a `Number` is one of every instance.
template <class Stretch>
class BoundFormulas {
 public:
  using Number = typename Stretch::Number;

  /// The number of bounds.
  [[nodiscard]] Eigen::Index count() const noexcept { return count_; }

  /// z = max(μ/d, ±gradient): multipliers that balance the gradient where they can.
  void balance(const auto& mu, const auto& at, const auto& gradient, auto&& z) const {
    for (const Stretch& some : stretches_) {
      some.multipliers(z) = (mu / some.distances(at)).max(some.side * some.entries(gradient));
    }
  }

  /// The derivative of -Σ ln d along a step.
  [[nodiscard]] Number barrier_derivative(const auto& at, const auto& step) const {
    Sums sums;
    for (const Stretch& some : stretches_) {
      Number& sum = sums.of[some.set];
      sum = sum - Stretch::sum(some.side * some.entries(step) / some.distances(at));
    }
    return sums.total();
  }

  /// sigma += z/d, and gradient ∓= μ/d, the derivative of μ times the barrier.
  void add_barrier(const auto& at, const auto& z, const Number& mu, auto& sigma, auto& gradient) const {
    for (const Stretch& some : stretches_) {
      const auto distances = some.distances(at);
      some.entries(sigma) += some.multipliers(z) / distances;
      some.entries(gradient) -= (some.side * mu) / distances;
    }
  }

  /// diagonal += μ/d², so that a step near a bound costs more.
  void add_nearness(const auto& at, const Number& mu, auto& diagonal) const {
    for (const Stretch& some : stretches_) some.entries(diagonal) += mu / some.distances(at).square();
  }

  /// gradient ∓= z
  void subtract_multipliers(const auto& z, auto&& gradient) const {
    for (const Stretch& some : stretches_) some.entries(gradient) -= some.side * some.multipliers(z);
  }

  /// The smallest and the largest d z; 0 where there are no bounds.
  void find_products(const auto& at, const auto& z, Number& smallest, Number& largest) const {
    smallest = Stretch::all(count_ > 0 ? unbounded : 0.0);
    largest = Stretch::all(0.0);
    for (const Stretch& some : stretches_) {
      const auto distances = some.distances(at);
      const auto products = distances * some.multipliers(z);
      smallest = Stretch::smaller(smallest, products);
      largest = Stretch::larger(largest, products);
    }
  }

  /// The step of the multipliers that belongs to one of the entries: dz = μ/d - z ∓ (z/d) dx, (12).
  void set_multiplier_step(const auto& at, const auto& z, const Number& mu, const auto& step, auto& z_step) const {
    for (const Stretch& some : stretches_) {
      const auto of_bounds = some.multipliers(z);
      some.multipliers(z_step) = (mu - some.side * of_bounds * some.entries(step)) / some.distances(at) - of_bounds;
    }
  }

  /// The longest step, at most 1, that leaves the share 1 - τ of every d, (15a).
  [[nodiscard]] Number fraction_to_boundary(const auto& at, const auto& step, const Number& tau) const {
    Number loss = Stretch::all(0.0);
    for (const Stretch& some : stretches_) {
      loss = Stretch::larger(loss, -(some.side * some.entries(step)) / some.distances(at));
    }
    return Stretch::shortened(loss, tau);
  }

  /// The same for z, (15b).
  [[nodiscard]] Number multiplier_fraction_to_boundary(const auto& z, const auto& z_step, const Number& tau) const {
    Number loss = Stretch::all(0.0);
    for (const Stretch& some : stretches_) {
      loss = Stretch::larger(loss, -some.multipliers(z_step) / some.multipliers(z));
    }
    return Stretch::shortened(loss, tau);
  }

  /// z += length dz, then kept within a factor κ_Σ of μ/d, (14c) and (16). Instances whose length is 0 keep theirs.
  void update_multipliers(const auto& at, const auto& z_step, const Number& length, const Number& mu, auto& z) const {
    const Number least = mu / constants::kappa_sigma;
    const Number most = mu * constants::kappa_sigma;
    for (const Stretch& some : stretches_) {
      const auto distances = some.distances(at);
      auto of_bounds = some.multipliers(z);
      const auto moved = of_bounds + length * some.multipliers(z_step);
      const auto near = moved.max(least / distances).min(most / distances);
      of_bounds = Stretch::where_moving(length, near, of_bounds);
    }
  }

 protected:
  /// Set by set: a digit depends on the order of a sum.
  struct Sums {
    std::array<Number, 4> of{Stretch::all(0.0), Stretch::all(0.0), Stretch::all(0.0), Stretch::all(0.0)};

    [[nodiscard]] Number total() const { return 0.0 + of[0] + of[1] + of[2] + of[3]; }
  };

  BoundFormulas() = default;

  std::vector<Stretch> stretches_;
  Eigen::Index count_ = 0;
};

}  // namespace dmocbench::interior_point
