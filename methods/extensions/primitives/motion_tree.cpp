#include "methods/extensions/primitives/motion_tree.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace dmocbench {

namespace {

/// The states of a layer with each control, as far as a time step leads.
struct Reached {
  Eigen::MatrixXd states;
  Eigen::VectorXd costs;
};

Reached reached_from(const MotionTreeLayer& layer, const DiscreteFlow& flow, const MotionTreeOptions& options) {
  const Eigen::Index choices = options.controls.rows();
  const Eigen::Index count = layer.states.rows();
  // State i with control k is row k · count + i.
  Reached reached{layer.states.replicate(choices, 1), Eigen::VectorXd::Zero(choices * count)};
  Eigen::MatrixXd controls(choices * count, options.controls.cols());
  for (Eigen::Index k = 0; k < choices; ++k) {
    controls.middleRows(k * count, count) = options.controls.row(k).replicate(count, 1);
  }
  for (int i = 0; i < options.intervals_per_step; ++i) flow.advance(reached.states, controls, reached.costs);
  const double sign = flow.step() < 0.0 ? -1.0 : 1.0;
  reached.costs = (layer.costs.replicate(choices, 1) + sign * reached.costs).eval();
  return reached;
}

bool is_allowed(const Eigen::VectorXd& state, const Bounds& bounds) {
  if (!state.allFinite()) return false;
  if (bounds.empty()) return true;
  const auto q = state.head(bounds.lower.size()).array();
  return (q >= bounds.lower.array()).all() && (q <= bounds.upper.array()).all();
}

/// The cheapest state of every cell, cells in the order of the lattice.
std::vector<Eigen::Index> cheapest_of_cells(const Reached& reached, const MotionTreeOptions& options) {
  std::map<std::vector<long long>, Eigen::Index> cells;
  std::vector<long long> cell(static_cast<std::size_t>(options.cell.size()));
  for (Eigen::Index row = 0; row < reached.states.rows(); ++row) {
    const Eigen::VectorXd state = reached.states.row(row).transpose();
    if (!is_allowed(state, options.configuration)) continue;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const auto entry = static_cast<Eigen::Index>(i);
      cell[i] = std::llround(state[entry] / options.cell[entry]);
    }
    const auto [place, is_new] = cells.try_emplace(cell, row);
    if (!is_new && reached.costs[row] < reached.costs[place->second]) place->second = row;
  }
  std::vector<Eigen::Index> rows;
  rows.reserve(cells.size());
  for (const auto& [key, row] : cells) rows.push_back(row);
  return rows;
}

MotionTreeLayer layer_behind(const MotionTreeLayer& layer, const DiscreteFlow& flow, const MotionTreeOptions& options) {
  const Reached reached = reached_from(layer, flow, options);
  const std::vector<Eigen::Index> rows = cheapest_of_cells(reached, options);
  const std::size_t kept = std::min(rows.size(), options.most_states);
  MotionTreeLayer next{.states = Eigen::MatrixXd(static_cast<Eigen::Index>(kept), reached.states.cols()),
                       .costs = Eigen::VectorXd(static_cast<Eigen::Index>(kept)),
                       .parents = {},
                       .controls = {}};
  for (std::size_t i = 0; i < kept; ++i) {
    const Eigen::Index row = rows[i * rows.size() / kept];
    next.states.row(static_cast<Eigen::Index>(i)) = reached.states.row(row);
    next.costs[static_cast<Eigen::Index>(i)] = reached.costs[row];
    next.parents.push_back(row % layer.states.rows());
    next.controls.push_back(row / layer.states.rows());
  }
  return next;
}

}  // namespace

std::vector<MotionTreeLayer> grow_tree(const DiscreteFlow& flow, const BoundaryState& root,
                                       const MotionTreeOptions& options) {
  std::vector<MotionTreeLayer> layers(1);
  layers[0].states.resize(1, 2 * root.q.size());
  layers[0].states.row(0) << root.q.transpose(), root.v.transpose();
  layers[0].costs = Eigen::VectorXd::Zero(1);
  for (int i = 0; i < options.layers; ++i) layers.push_back(layer_behind(layers.back(), flow, options));
  return layers;
}

}  // namespace dmocbench
