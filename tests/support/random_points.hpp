#pragma once

#include <random>

#include <Eigen/Core>

namespace dmocbench::tests {

/// Numbers that are the same on every run.
class RandomPoints {
 public:
  explicit RandomPoints(unsigned seed = 20090101U) : engine_(seed) {}

  double number(double lower = -1.0, double upper = 1.0) {
    // Not std::uniform_real_distribution: its numbers differ between standard libraries.
    const double unit = static_cast<double>(engine_()) / 4294967296.0;
    return lower + (upper - lower) * unit;
  }

  Eigen::VectorXd vector(Eigen::Index size, double lower = -1.0, double upper = 1.0) {
    Eigen::VectorXd entries(size);
    for (double& entry : entries) entry = number(lower, upper);
    return entries;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace dmocbench::tests
