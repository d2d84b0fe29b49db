#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

namespace dmocbench {

/// The quantity that a minor iteration reduces.
enum class MinorPhase : std::uint8_t {
  feasibility = 1,  ///< lowers the sum of infeasibilities
  optimality = 2,   ///< lowers the quadratic objective
};

/// One minor iteration of the SQP method: one step of the active-set method on a quadratic program in variables d_j and
/// slacks s_i of its constraints. It prices (only when the point is stationary on the present sets), takes a direction,
/// tests how far it may go, and updates the sets. A step of length zero is a minor iteration too.
struct MinorIteration {
  int major = 0;                               ///< the quadratic program it belongs to, from 1
  MinorPhase phase = MinorPhase::feasibility;  ///< of the quadratic program
  /// Columns: variable j is j, the slack of constraint i is (number of variables) + i.
  std::optional<Eigen::Index> entering;         ///< nonbasic so far, may move now; empty if the step continues
  std::optional<Eigen::Index> leaving = {};     ///< reached a bound and stays there; none after a whole step
  std::optional<Eigen::Index> into_basis = {};  ///< superbasic so far, takes the place of `leaving` in the basis
  double step = 0.0;              ///< along the entering column, or the share of the whole step in phase 2
  double infeasibility = 0.0;     ///< sum over all columns after the step
  double objective = 0.0;         ///< gᵀd + ½ dᵀHd after the step
  Eigen::Index superbasics = 0;   ///< number of columns in the sets after the step
  Eigen::Index basic_slacks = 0;  ///< slacks in the basis after it
};

}  // namespace dmocbench
