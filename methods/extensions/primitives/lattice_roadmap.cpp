#include "methods/extensions/primitives/lattice_roadmap.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "methods/error.hpp"
#include "methods/extensions/primitives/discrete_flow.hpp"
#include "methods/extensions/primitives/meeting_trees.hpp"
#include "methods/extensions/primitives/solve_primitives.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

namespace {

/// A primitive to be solved, with the controls that nearly lead there, a row per interval.
struct Wanted {
  PrimitiveRequest request;
  Eigen::MatrixXd controls;
};

/// The motion under given controls, as DMOC has it.
Motion motion_under(const DiscreteFlow& flow, const BoundaryState& first, const Eigen::MatrixXd& controls) {
  const Eigen::Index n = first.q.size();
  const Eigen::Index intervals = controls.rows();
  Trajectory motion;
  motion.tableau = gauss_tableau(1);
  motion.node_times = flow.step() * Eigen::VectorXd::LinSpaced(intervals + 1, 0.0, static_cast<double>(intervals));
  motion.stage_times = motion.node_times.head(intervals).array() + 0.5 * flow.step();
  motion.q.resize(intervals + 1, n);
  motion.v.resize(intervals + 1, n);
  motion.stage_u = controls;
  Eigen::MatrixXd state(1, 2 * n);
  state << first.q.transpose(), first.v.transpose();
  Eigen::VectorXd cost = Eigen::VectorXd::Zero(1);
  for (Eigen::Index k = 0; k <= intervals; ++k) {
    motion.q.row(k) = state.leftCols(n);
    motion.v.row(k) = state.rightCols(n);
    if (k < intervals) flow.advance(state, controls.row(k), cost);
  }
  return smooth_motion(motion);
}

/// Gathers the states and primitives of a roadmap, each once.
class LatticeGraph {
 public:
  LatticeGraph(const MeetingTrees& trees, const LatticeOptions& options, PrimitiveLibrary& library)
      : trees_(trees), options_(options), library_(library) {
    static_cast<void>(state_of(trees.forward(), 0, 0));
    static_cast<void>(state_of(trees.backward(), 0, 0));
  }

  void add(const TreeConnection& connection) {
    const std::size_t first_layer = trees_.forward().size() - 1;
    const std::size_t last_layer = trees_.backward().size() - 1;
    const std::size_t first = state_of(trees_.forward(), first_layer, connection.first);
    const std::size_t last = state_of(trees_.backward(), last_layer, connection.last);
    want(first, last, options_.connection, connection.controls);
    add_branch(trees_.forward(), first_layer, connection.first);
    add_branch(trees_.backward(), last_layer, connection.last);
  }

  [[nodiscard]] std::vector<PrimitiveRequest> requests(const DiscreteFlow& flow) && {
    std::vector<PrimitiveRequest> requests;
    for (Wanted& wanted : wanted_) {
      wanted.request.start = motion_under(flow, library_.states[wanted.request.first], wanted.controls);
      requests.push_back(std::move(wanted.request));
    }
    return requests;
  }

 private:
  using Layers = std::vector<MotionTreeLayer>;

  std::size_t state_of(const Layers& tree, std::size_t layer, Eigen::Index number) {
    const auto [place, is_new] = states_.try_emplace({&tree, layer, number}, library_.states.size());
    if (is_new) library_.states.push_back(boundary_state(tree[layer], number));
    return place->second;
  }

  void want(std::size_t first, std::size_t last, int duration, Eigen::MatrixXd controls) {
    if (!joined_.insert({first, last, duration}).second) return;
    const Eigen::Index n = library_.states[first].q.size();
    wanted_.push_back({{.first = first, .last = last, .displacement = Displacement::identity(n), .duration = duration},
                       std::move(controls)});
  }

  /// The primitives between a state of a tree and its root.
  void add_branch(const Layers& tree, std::size_t layer, Eigen::Index number) {
    for (; layer > 0; --layer) {
      const auto i = static_cast<std::size_t>(number);
      const Eigen::Index parent = tree[layer].parents[i];
      const std::size_t here = state_of(tree, layer, number);
      const std::size_t there = state_of(tree, layer - 1, parent);
      const bool is_forward = &tree == &trees_.forward();
      want(is_forward ? there : here, is_forward ? here : there, 1,
           options_.controls.row(tree[layer].controls[i]).replicate(options_.intervals_per_step, 1));
      number = parent;
    }
  }

  const MeetingTrees& trees_;
  const LatticeOptions& options_;
  PrimitiveLibrary& library_;
  std::map<std::tuple<const Layers*, std::size_t, Eigen::Index>, std::size_t> states_;
  std::set<std::tuple<std::size_t, std::size_t, int>> joined_;
  std::vector<Wanted> wanted_;
};

void check(const Problem& problem, const LatticeOptions& options) {
  const Eigen::Index n = problem.configuration_size();
  if (options.controls.cols() != problem.control_size() || options.controls.rows() == 0 ||
      options.cell.size() != 2 * n || !(options.cell.array() > 0.0).all()) {
    throw Error("a lattice of {} needs constant controls with {} entries and cells with {} positive sizes",
                problem.name(), problem.control_size(), 2 * n);
  }
  if (options.connection < 1 || options.connection > options.time_steps || options.intervals_per_step < 1) {
    throw Error("connections of {} time steps do not fit into a horizon of {} time steps", options.connection,
                options.time_steps);
  }
  const auto intervals = static_cast<Eigen::Index>(options.connection) * options.intervals_per_step;
  if (intervals * problem.control_size() < 2 * n) {
    throw Error(
        "connections of {} intervals have fewer control values than a state of {} has entries; use more intervals",
        intervals, problem.name());
  }
}

}  // namespace

StoredRoadmap lattice_roadmap(const Problem& problem, const LatticeOptions& options,
                              const PrimitiveOptions& primitive_options) {
  check(problem, options);
  PrimitiveLibrary library =
      PrimitiveLibrary::of(problem, problem.horizon() / options.time_steps, options.intervals_per_step);
  const DiscreteFlow flow(problem, library.step / options.intervals_per_step);
  const MeetingTrees trees(problem, flow, options);
  LatticeGraph graph(trees, options, library);
  for (const TreeConnection& connection : trees.connections()) graph.add(connection);
  solve_primitives(WithoutBounds(problem), std::move(graph).requests(flow), library, primitive_options);

  const Displacement identity = Displacement::identity(problem.configuration_size());
  std::vector<RoadmapNode> nodes;
  for (std::size_t i = 0; i < library.states.size(); ++i) nodes.push_back({.state = i, .moved = identity});
  std::vector<RoadmapEdge> edges;
  for (std::size_t i = 0; i < library.primitives.size(); ++i) {
    edges.push_back({.from = library.primitives[i].first, .to = library.primitives[i].last, .primitive = i});
  }
  Roadmap roadmap(library, std::move(nodes), std::move(edges));
  return {.library = std::move(library), .roadmap = std::move(roadmap), .start = 0, .goal = 1};
}

}  // namespace dmocbench
