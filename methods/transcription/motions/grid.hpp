#pragma once

#include <vector>

#include <Eigen/Core>

namespace dmocbench {

/// The nodes 0 = τ_0 < τ_1 < ... < τ_N = 1 of a horizon, relative to its length T: t_k = T τ_k, h_k = T (τ_{k+1} -
/// τ_k).
class Grid {
 public:
  /// The largest number of intervals accepted.
  static constexpr long long most_intervals = 1LL << 24;

  /// The narrowest interval accepted, as a share of the horizon. Velocities are differences of q divided by the step:
  /// in an interval ten times narrower, rounding would leave of a velocity that covers |q| in the horizon fewer than
  /// six digits.
  static constexpr double narrowest = 1e-8;

  /// N intervals of equal length. Throws `Error` unless 1 <= intervals <= most_intervals.
  [[nodiscard]] static Grid uniform(long long intervals);
  /// Any relative node times. Throws `Error` unless they ascend strictly from 0 to 1 and every interval is at least
  /// `narrowest` wide.
  [[nodiscard]] static Grid from_nodes(Eigen::VectorXd relative_times);

  /// As many intervals, with nodes at these ascending relative times between 0 and 1. The node nearest to each is moved
  /// there, and the nodes between two of them are moved in proportion: a uniform grid becomes uniform pieces. Without
  /// times the grid itself. Throws `Error` if there are as many times as intervals, or as `from_nodes`.
  [[nodiscard]] Grid with_nodes_at(const std::vector<double>& times) const;
  /// The number of the node at a relative time that `with_nodes_at` was given.
  [[nodiscard]] Eigen::Index node_at(double relative_time) const;

  /// N.
  [[nodiscard]] std::size_t intervals() const noexcept { return static_cast<std::size_t>(nodes_.size() - 1); }
  /// τ_0 .. τ_N.
  [[nodiscard]] const Eigen::VectorXd& relative_times() const noexcept { return nodes_; }
  /// τ_{k+1} - τ_k for k from 0 to N - 1; exactly 1/N on a uniform grid.
  [[nodiscard]] const Eigen::VectorXd& relative_widths() const noexcept { return widths_; }

 private:
  Grid(Eigen::VectorXd nodes, Eigen::VectorXd widths);
  Eigen::VectorXd nodes_;
  Eigen::VectorXd widths_;
};

}  // namespace dmocbench
