#include "methods/extensions/primitives/stored_roadmap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>
#include <unordered_map>
#include <utility>
#include <vector>

#include <boost/container_hash/hash.hpp>

#include "methods/error.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/motions/grid.hpp"

namespace dmocbench {

namespace {

/// Rows x of a table moved by x ↦ A x.
Eigen::MatrixXd turned(const Displacement& moved, const Eigen::MatrixXd& rows) {
  return rows * moved.linear.transpose();
}

/// Times, nodes and controls of the path.
Trajectory motion_along(const PrimitiveLibrary& library, const Roadmap& roadmap, const RoadmapPath& path) {
  const Eigen::Index intervals = Eigen::Index{path.duration} * library.intervals_per_step;
  const Primitive& any = library.primitives.front();
  Trajectory motion;
  motion.tableau = gauss_tableau(1);
  motion.node_times = library.step * path.duration * Grid::uniform(intervals).relative_times();
  motion.q.resize(intervals + 1, any.q.cols());
  motion.v.resize(intervals + 1, any.q.cols());
  motion.stage_u.resize(intervals, any.u.cols());
  Eigen::Index begin = 0;
  for (const std::size_t number : path.edges) {
    const RoadmapEdge& edge = roadmap.edges()[number];
    const Primitive& primitive = library.primitives[edge.primitive];
    const Displacement& moved = roadmap.nodes()[edge.from].moved;
    const Eigen::Index count = primitive.u.rows();
    motion.q.middleRows(begin, count + 1) = turned(moved, primitive.q).rowwise() + moved.shift.transpose();
    motion.v.middleRows(begin, count + 1) = turned(moved, primitive.v);
    motion.stage_u.middleRows(begin, count) = primitive.u;
    begin += count;
  }
  motion.cost = path.cost;
  return motion;
}

}  // namespace

Trajectory concatenate(const Problem& problem, const PrimitiveLibrary& library, const Roadmap& roadmap,
                       const RoadmapPath& path) {
  if (path.edges.empty()) throw Error("a path needs at least one edge; choose a goal other than the start");
  Trajectory motion = motion_along(library, roadmap, path);
  const Eigen::Index intervals = motion.intervals();
  const Eigen::VectorXd first_times = motion.node_times.head(intervals);
  const Eigen::VectorXd steps = motion.node_times.tail(intervals) - first_times;
  motion.stage_times = first_times + 0.5 * steps;
  motion.stage_q = 0.5 * (motion.q.topRows(intervals) + motion.q.bottomRows(intervals));
  motion.stage_v = steps.cwiseInverse().asDiagonal() * (motion.q.bottomRows(intervals) - motion.q.topRows(intervals));
  const TracedProblem traced(problem);
  LegendreTransform legendre(traced);
  motion.p.resizeLike(motion.q);
  for (Eigen::Index k = 0; k <= intervals; ++k) {
    motion.p.row(k) = legendre.momentum(motion.node(k).q, motion.node(k).v, motion.node_times[k]).transpose();
  }
  motion.stage_p.resizeLike(motion.stage_q);
  for (Eigen::Index k = 0; k < intervals; ++k) {
    const MotionPoint stage = motion.stage(k);
    motion.stage_p.row(k) = legendre.momentum(stage.q, stage.v, motion.stage_times[k]).transpose();
  }
  return motion;
}

namespace {

constexpr int never = std::numeric_limits<int>::max() / 4;

/// A state and a configuration on a raster so fine that nodes are apart, so coarse that rounding does not matter.
using NodeKey = std::vector<long long>;

NodeKey key_of(std::size_t state, const Eigen::VectorXd& q) {
  constexpr double width = 1e-6;
  constexpr double offset = 0.317;  // lattices have their points in the middle of raster cells more or less
  NodeKey key{static_cast<long long>(state)};
  for (const double entry : q) key.push_back(std::llround(entry / width + offset));
  return key;
}

/// Nodes and edges in the order of their discovery, with the earliest times of arrival.
class Growth {
 public:
  Growth(const PrimitiveLibrary& library, const GrowthRequest& request)
      : library_(library), request_(request), leaving_(library.states.size()) {
    choose_primitives();
    node_of(request.start, 0);
    for (int t = 0; t <= request.duration; ++t) {
      for (std::size_t node = 0; node < nodes_.size(); ++node) {
        if (arrival_[node] == t) leave(node, t);
      }
    }
  }

  /// The part of the roadmap on a way to the goal.
  [[nodiscard]] StoredRoadmap kept() const {
    const auto goal = numbers_.find(key_at(request_.goal));
    if (goal == numbers_.end()) {
      throw Error("the {} primitives of {} do not reach the goal within {} time steps", library_.primitives.size(),
                  library_.problem, request_.duration);
    }
    const std::vector<int> rest = times_to(goal->second);
    std::vector<std::size_t> number(nodes_.size(), nodes_.size());
    std::vector<RoadmapNode> nodes;
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      if (arrival_[node] + rest[node] > request_.duration) continue;
      number[node] = nodes.size();
      nodes.push_back(nodes_[node]);
    }
    std::vector<RoadmapEdge> edges;
    for (const RoadmapEdge& edge : edges_) {
      const int duration = library_.primitives[edge.primitive].duration;
      if (arrival_[edge.from] + duration + rest[edge.to] > request_.duration) continue;
      edges.push_back({.from = number[edge.from], .to = number[edge.to], .primitive = edge.primitive});
    }
    return {.library = library_,
            .roadmap = Roadmap(library_, std::move(nodes), std::move(edges)),
            .start = number[0],
            .goal = number[goal->second]};
  }

 private:
  [[nodiscard]] NodeKey key_at(const RoadmapNode& node) const {
    return key_of(node.state, node.moved.configuration(library_.states[node.state].q));
  }

  /// The cheapest of those that begin and end alike in the same time.
  void choose_primitives() {
    std::unordered_map<NodeKey, std::size_t, boost::hash<NodeKey>> cheapest;
    for (std::size_t i = 0; i < library_.primitives.size(); ++i) {
      const Primitive& primitive = library_.primitives[i];
      NodeKey key = key_at({.state = primitive.last, .moved = primitive.displacement});
      key.push_back(static_cast<long long>(primitive.first));
      key.push_back(primitive.duration);
      const auto [place, is_new] = cheapest.emplace(key, i);
      if (!is_new && primitive.cost < library_.primitives[place->second].cost) place->second = i;
    }
    for (const auto& [key, primitive] : cheapest) leaving_[library_.primitives[primitive].first].push_back(primitive);
    for (std::vector<std::size_t>& primitives : leaving_) std::ranges::sort(primitives);
  }

  std::size_t node_of(const RoadmapNode& node, int t) {
    const auto [place, is_new] = numbers_.emplace(key_at(node), nodes_.size());
    if (is_new) {
      nodes_.push_back(node);
      arrival_.push_back(t);
    }
    arrival_[place->second] = std::min(arrival_[place->second], t);
    return place->second;
  }

  void leave(std::size_t from, int t) {
    for (const std::size_t number : leaving_[nodes_[from].state]) {
      const Primitive& primitive = library_.primitives[number];
      if (t + primitive.duration > request_.duration) continue;
      const RoadmapNode next{.state = primitive.last, .moved = nodes_[from].moved.after(primitive.displacement)};
      if (request_.may_visit && !request_.may_visit(next)) continue;
      edges_.push_back({.from = from, .to = node_of(next, t + primitive.duration), .primitive = number});
    }
  }

  /// The shortest time from every node to the goal.
  [[nodiscard]] std::vector<int> times_to(std::size_t goal) const {
    std::vector<int> rest(nodes_.size(), never);
    rest[goal] = 0;
    for (bool is_changed = true; std::exchange(is_changed, false);) {
      for (const auto& edge : std::views::reverse(edges_)) {
        const int through = rest[edge.to] + library_.primitives[edge.primitive].duration;
        if (through >= rest[edge.from]) continue;
        rest[edge.from] = through;
        is_changed = true;
      }
    }
    return rest;
  }

  const PrimitiveLibrary& library_;
  const GrowthRequest& request_;
  std::vector<std::vector<std::size_t>> leaving_;  // primitives by their first state
  std::unordered_map<NodeKey, std::size_t, boost::hash<NodeKey>> numbers_;
  std::vector<RoadmapNode> nodes_;
  std::vector<int> arrival_;
  std::vector<RoadmapEdge> edges_;
};

}  // namespace

StoredRoadmap grow_roadmap(PrimitiveLibrary library, const GrowthRequest& request) {
  StoredRoadmap stored = Growth(library, request).kept();
  stored.library = std::move(library);
  return stored;
}

}  // namespace dmocbench
