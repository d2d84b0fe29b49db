#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/extensions/primitives/discrete_flow.hpp"
#include "methods/mechanics/bounds.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// Options for the growth of a tree of motions.
struct MotionTreeOptions {
  int layers = 1;                  ///< time steps
  int intervals_per_step = 1;      ///< steps of the flow in each
  Eigen::MatrixXd controls;        ///< the constant controls that are tried, one per row
  Eigen::VectorXd cell;            ///< size of the lattice's cells in (q, v), 2n entries
  std::size_t most_states = 1000;  ///< of a layer
  Bounds configuration;            ///< states that leave them are dropped
};

/// The states that are reached after some time steps: row i is (q, v) of state i.
struct MotionTreeLayer {
  /// A state per node of the layer.
  Eigen::MatrixXd states;
  Eigen::VectorXd costs;               ///< of the motion from the root, or to it
  std::vector<Eigen::Index> parents;   ///< the state of the layer before
  std::vector<Eigen::Index> controls;  ///< the row of the constant control between both
};

/// The states of a lattice that motions under constant controls reach from a root, layer by layer: in every cell of
/// the lattice the cheapest one, and where there are too many, cells spread evenly. Where the flow goes backwards,
/// these are the states from which motions reach the root. Layer 0 is the root.
[[nodiscard]] std::vector<MotionTreeLayer> grow_tree(const DiscreteFlow& flow, const BoundaryState& root,
                                                     const MotionTreeOptions& options);

}  // namespace dmocbench
