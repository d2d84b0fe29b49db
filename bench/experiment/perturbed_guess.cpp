#include "bench/experiment/perturbed_guess.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace dmocbench {

namespace {

constexpr Eigen::Index modes = 3;

/// Evenly distributed between -1 and 1, the same numbers with every standard library.
double even(std::mt19937_64& engine) {
  constexpr int kept_bits = 53;
  return std::ldexp(static_cast<double>(engine() >> (64 - kept_bits)), 1 - kept_bits) - 1.0;
}

/// The range of every q_i along a motion; 1 where it does not move.
Eigen::VectorXd ranges(const Motion& motion) {
  constexpr int samples = 64;
  Eigen::VectorXd lowest = motion.at(0.0).q;
  Eigen::VectorXd highest = lowest;
  for (int i = 1; i <= samples; ++i) {
    const Eigen::VectorXd q = motion.at(motion.horizon * i / samples).q;
    lowest = lowest.cwiseMin(q);
    highest = highest.cwiseMax(q);
  }
  const Eigen::VectorXd range = highest - lowest;
  return (range.array() > 0.0).select(range, 1.0);
}

}  // namespace

Motion perturbed(const Motion& motion, double amplitude, std::uint64_t seed, std::uint64_t number) {
  if (number == 0) return motion;
  std::seed_seq mixed{seed, number};
  std::mt19937_64 engine(mixed);
  const Eigen::VectorXd range = ranges(motion);
  Eigen::MatrixXd amplitudes(range.size(), modes);
  for (Eigen::Index k = 0; k < modes; ++k) {
    for (Eigen::Index i = 0; i < range.size(); ++i) {
      amplitudes(i, k) = amplitude * range[i] * even(engine) / static_cast<double>(k + 1);
    }
  }
  const auto at = [motion, amplitudes](double t) {
    MotionPoint point = motion.at(t);
    for (Eigen::Index k = 0; k < modes; ++k) {
      const double frequency = static_cast<double>(k + 1) * std::numbers::pi / motion.horizon;
      point.q += amplitudes.col(k) * std::sin(frequency * t);
      point.v += amplitudes.col(k) * (frequency * std::cos(frequency * t));
    }
    return point;
  };
  return {at, motion.horizon};
}

}  // namespace dmocbench
