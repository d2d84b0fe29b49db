#include "methods/solvers/interior_point/barrier_bounds.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "methods/solvers/interior_point/optimality_errors.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench::interior_point {
namespace {

constexpr double mu = 0.1;

/// A point inside random bounds, of which entries have none, one or both, or are fixed; and a step.
struct Case {
  explicit Case(unsigned seed) : random(seed) {
    draw(40, &Primal::x);
    draw(7, &Primal::s);
    const BarrierBounds bounds(lower, upper);
    bounds.set_multipliers(1.0, at.z);
    bounds.set_multipliers(0.0, step.z);
    for (Eigen::VectorXd& z : at.z) z = random.vector(z.size(), 0.5, 2.0);
  }

  void draw(Eigen::Index size, Eigen::VectorXd Primal::*part) {
    at.*part = random.vector(size);
    step.*part = random.vector(size);
    lower.*part = at.*part - random.vector(size, 0.1, 2.0);
    upper.*part = at.*part + random.vector(size, 0.1, 2.0);
    for (Eigen::Index i = 0; i < size; ++i) {
      if (random.number() < 0.0) (lower.*part)[i] = -unbounded;
      if (random.number() < 0.0) (upper.*part)[i] = unbounded;
      if (random.number() < -0.8) (lower.*part)[i] = (upper.*part)[i] = (at.*part)[i];
    }
  }

  [[nodiscard]] Iterate moved(double length) const {
    Iterate there = at;
    there.x += length * step.x;
    there.s += length * step.s;
    for (std::size_t k = 0; k < there.z.size(); ++k) {
      if (step.z[k].size() > 0) there.z[k] += length * step.z[k];
    }
    return there;
  }

  /// Calls `use(distance here, distance there)` for every bound of an entry that is not fixed.
  template <class Use>
  void for_each_distance(const Primal& there, const Use& use) const {
    for (const auto part : {&Primal::x, &Primal::s}) {
      for (Eigen::Index i = 0; i < (at.*part).size(); ++i) {
        const double low = (lower.*part)[i];
        const double high = (upper.*part)[i];
        if (low == high) continue;
        if (std::isfinite(low)) use((at.*part)[i] - low, (there.*part)[i] - low);
        if (std::isfinite(high)) use(high - (at.*part)[i], high - (there.*part)[i]);
      }
    }
  }

  tests::RandomPoints random;
  Primal lower;
  Primal upper;
  Iterate at;
  Iterate step;
};

/// Largest |d z - of|.
double complementarity(const BarrierBounds& bounds, const Iterate& at, double of) {
  OptimalityErrors errors;
  bounds.find_products(at, at.z, errors.smallest_product, errors.largest_product);
  return errors.complementarity(of);
}

TEST(BarrierBounds, KnowTheBarrierAndItsDerivative) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Case given(seed);
    const BarrierBounds bounds(given.lower, given.upper);
    double barrier = 0.0;
    Eigen::Index count = 0;
    given.for_each_distance(given.at, [&](double distance, double) {
      barrier -= std::log(distance);
      ++count;
    });
    EXPECT_EQ(bounds.count(), count);
    EXPECT_NEAR(bounds.barrier(given.at), barrier, 1e-12 * (1.0 + std::abs(barrier)));
    constexpr double h = 1e-6;
    const double difference = (bounds.barrier(given.moved(h)) - bounds.barrier(given.moved(-h))) / (2.0 * h);
    const double derivative = bounds.barrier_derivative(given.at, given.step);
    EXPECT_NEAR(derivative, difference, 1e-6 * (1.0 + std::abs(difference)));
    Primal sigma{Eigen::VectorXd::Zero(40), Eigen::VectorXd::Zero(7)};
    Primal gradient = sigma;
    bounds.add_barrier(given.at, given.at.z, mu, sigma, gradient);
    EXPECT_NEAR(gradient.x.dot(given.step.x) + gradient.s.dot(given.step.s), mu * derivative,
                1e-12 * (1.0 + std::abs(derivative)));
  }
}

/// To first order, a step of Newton's method leaves the share 1 - length of d z - μ.
TEST(BarrierBounds, CompleteStepsByThoseOfTheMultipliers) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Case given(seed);
    const BarrierBounds bounds(given.lower, given.upper);
    bounds.set_multiplier_step(given.at, given.at.z, mu, given.step, given.step.z);
    constexpr double length = 1e-7;
    const double before = complementarity(bounds, given.at, mu);
    EXPECT_NEAR(complementarity(bounds, given.moved(length), mu), (1.0 - length) * before, 1e-11);
  }
}

TEST(BarrierBounds, KeepAFractionOfTheDistances) {
  constexpr double tau = 0.9;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Case given(seed);
    const BarrierBounds bounds(given.lower, given.upper);
    given.step.x *= 10.0;
    given.step.s *= 10.0;
    bounds.set_multiplier_step(given.at, given.at.z, mu, given.step, given.step.z);
    double least = 1.0;
    given.for_each_distance(given.moved(bounds.fraction_to_boundary(given.at, given.step, tau)),
                            [&](double here, double there) { least = std::min(least, there / here); });
    EXPECT_NEAR(least, 1.0 - tau, 1e-12);
    const Iterate there = given.moved(bounds.multiplier_fraction_to_boundary(given.at.z, given.step.z, tau));
    least = 1.0;
    for (std::size_t k = 0; k < there.z.size(); ++k) {
      if (there.z[k].size() > 0) least = std::min(least, there.z[k].cwiseQuotient(given.at.z[k]).minCoeff());
    }
    EXPECT_NEAR(least, 1.0 - tau, 1e-12);
  }
}

TEST(BarrierBounds, KeepMultipliersNearThoseOfTheBarrier) {
  Case given(0);
  const BarrierBounds bounds(given.lower, given.upper);
  bounds.set_multiplier_step(given.at, given.at.z, mu, given.step, given.step.z);
  for (Eigen::VectorXd& z : given.step.z) z.setConstant(-1e30);
  bounds.update_multipliers(given.at, given.step.z, 1.0, mu, given.at.z);
  EXPECT_NEAR(complementarity(bounds, given.at, 0.0), mu / 1e10, 1e-20);
  for (Eigen::VectorXd& z : given.step.z) z.setConstant(1e30);
  bounds.update_multipliers(given.at, given.step.z, 1.0, mu, given.at.z);
  EXPECT_NEAR(complementarity(bounds, given.at, 0.0), mu * 1e10, 1.0);
}

}  // namespace
}  // namespace dmocbench::interior_point
