#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/extensions/primitives/discrete_flow.hpp"
#include "methods/mechanics/bounds.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// The lattice of states of a problem without a symmetry, and which of them are joined.
struct LatticeOptions {
  int time_steps = 16;                 ///< of the horizon
  int intervals_per_step = 16;         ///< of the midpoint rule in each
  int connection = 3;                  ///< time steps of the primitives that join the two trees
  Eigen::MatrixXd controls;            ///< the constant controls that trees try, one per row
  Eigen::VectorXd cell;                ///< size of the lattice's cells in (q, v), 2n entries
  std::size_t most_states = 1500;      ///< of a tree, in each time step
  std::size_t most_connections = 300;  ///< that are solved
};

/// The states that are reached after some time steps: row i is (q, v) of state i.
struct MotionTreeLayer {
  /// A state per node of the layer.
  Eigen::MatrixXd states;
  Eigen::VectorXd costs;                    ///< of the motion from the root, or to it
  std::vector<Eigen::Index> parents = {};   ///< the state of the layer before
  std::vector<Eigen::Index> controls = {};  ///< the row of the constant control between both
};

/// The states of a lattice that motions under constant controls reach from a root, layer by layer: in every cell of
/// the lattice the cheapest one, and where there are too many, cells spread evenly. Where the flow goes backwards,
/// these are the states from which motions reach the root. Layer 0 is the root. States outside `configurations` are
/// dropped.
[[nodiscard]] std::vector<MotionTreeLayer> grow_tree(const DiscreteFlow& flow, const BoundaryState& root,
                                                     const LatticeOptions& options, const Bounds& configurations,
                                                     int steps);

/// A motion that nearly leads from a state of the last layer of the forward tree to one of the backward tree.
struct TreeConnection {
  Eigen::Index first = 0;    ///< in the forward tree
  Eigen::Index last = 0;     ///< in the backward tree
  double cost = 0.0;         ///< of the whole motion through it, from root to root, an estimate
  Eigen::MatrixXd controls;  ///< a row per interval
};

/// A tree of motions from the first state of a problem, one backwards from the last, and where they come near.
class MeetingTrees {
 public:
  /// `flow` advances by one interval.
  MeetingTrees(const Problem& problem, const DiscreteFlow& flow, const LatticeOptions& options);

  /// The layers of the tree that begins at the start.
  [[nodiscard]] const std::vector<MotionTreeLayer>& forward() const noexcept { return forward_; }
  /// The layers of the tree that begins at the goal.
  [[nodiscard]] const std::vector<MotionTreeLayer>& backward() const noexcept { return backward_; }
  /// The cheapest first.
  [[nodiscard]] const std::vector<TreeConnection>& connections() const noexcept { return connections_; }

 private:
  std::vector<MotionTreeLayer> forward_;
  std::vector<MotionTreeLayer> backward_;
  std::vector<TreeConnection> connections_;
};

/// (q, v) of a state of a layer.
[[nodiscard]] BoundaryState boundary_state(const MotionTreeLayer& layer, Eigen::Index number);

}  // namespace dmocbench
