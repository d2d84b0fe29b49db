#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/extensions/primitives/discrete_flow.hpp"

namespace dmocbench {

/// Steers from a state to another one within some intervals, by DMOC linearised about the motion under a constant
/// control: where there are fewer controls than velocities, states that look near may be out of reach, and this shows
/// it.
class Steering {
 public:
  /// The end under the constant control: (q, v), 2n entries.
  [[nodiscard]] const Eigen::VectorXd& end() const noexcept { return end_; }
  /// The deviations from the constant control that lead to end + `miss`, with the least Σ h |δU|²/2: a row per
  /// interval.
  [[nodiscard]] Eigen::MatrixXd deviations(const Eigen::VectorXd& miss) const;
  /// That least sum.
  [[nodiscard]] double effort(const Eigen::VectorXd& miss) const { return (root_ * miss).squaredNorm(); }
  /// A matrix whose product with a miss has the effort as its squared norm, 2n × 2n.
  [[nodiscard]] const Eigen::MatrixXd& root() const noexcept { return root_; }

 private:
  friend std::vector<Steering> steerings(const DiscreteFlow&, const Eigen::MatrixXd&, const Eigen::VectorXd&, int);

  Eigen::VectorXd end_;
  Eigen::MatrixXd root_;
  Eigen::MatrixXd law_;  // (intervals · m) × 2n
  Eigen::Index controls_ = 0;
};

/// The steerings from the states in the rows of a table, about the constant control `u`, over a number of intervals.
/// Those whose motion leaves the domain of the formulas, or that some direction cannot be steered from, need an effort
/// that is not finite.
[[nodiscard]] std::vector<Steering> steerings(const DiscreteFlow& flow, const Eigen::MatrixXd& states,
                                              const Eigen::VectorXd& u, int intervals);

}  // namespace dmocbench
