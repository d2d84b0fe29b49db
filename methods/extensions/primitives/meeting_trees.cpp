#include "methods/extensions/primitives/meeting_trees.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "methods/extensions/primitives/steering.hpp"
#include "methods/mechanics/point_function.hpp"

namespace dmocbench {

namespace {

/// The states of a layer with each control, as far as a time step leads.
struct Reached {
  Eigen::MatrixXd states;
  Eigen::VectorXd costs;
};

Reached reached_from(const MotionTreeLayer& layer, const DiscreteFlow& flow, const LatticeOptions& options) {
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
std::vector<Eigen::Index> cheapest_of_cells(const Reached& reached, const LatticeOptions& options,
                                            const Bounds& configurations) {
  std::map<std::vector<long long>, Eigen::Index> cells;
  std::vector<long long> cell(static_cast<std::size_t>(options.cell.size()));
  for (Eigen::Index row = 0; row < reached.states.rows(); ++row) {
    const Eigen::VectorXd state = reached.states.row(row).transpose();
    if (!is_allowed(state, configurations)) continue;
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

MotionTreeLayer layer_behind(const MotionTreeLayer& layer, const DiscreteFlow& flow, const LatticeOptions& options,
                             const Bounds& configurations) {
  const Reached reached = reached_from(layer, flow, options);
  const std::vector<Eigen::Index> rows = cheapest_of_cells(reached, options, configurations);
  const std::size_t kept = std::min(rows.size(), options.most_states);
  MotionTreeLayer next{.states = Eigen::MatrixXd(static_cast<Eigen::Index>(kept), reached.states.cols()),
                       .costs = Eigen::VectorXd(static_cast<Eigen::Index>(kept))};
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
                                       const LatticeOptions& options, const Bounds& configurations, int steps) {
  std::vector<MotionTreeLayer> layers(1);
  layers[0].states.resize(1, 2 * root.q.size());
  layers[0].states.row(0) << root.q.transpose(), root.v.transpose();
  layers[0].costs = Eigen::VectorXd::Zero(1);
  for (int i = 0; i < steps; ++i) layers.push_back(layer_behind(layers.back(), flow, options, configurations));
  return layers;
}

namespace {

/// A pair of states of both trees that is perhaps joined.
struct StatePair {
  double cost = 0.0;  // of the whole motion, linearised
  Eigen::Index first = 0;
  Eigen::Index last = 0;
};

/// Keeps the cheapest of many pairs.
class CheapestPairs {
 public:
  explicit CheapestPairs(std::size_t most) : most_(most) {}
  void offer(const StatePair& pair) {
    if (!(pair.cost < limit_)) return;
    pairs_.push_back(pair);
    if (pairs_.size() >= 8 * most_) thin();
  }
  [[nodiscard]] std::vector<StatePair> take() && {
    if (pairs_.size() > most_) thin();
    return std::move(pairs_);
  }

 private:
  void thin() {
    const auto end = pairs_.begin() + static_cast<std::ptrdiff_t>(most_);
    std::ranges::nth_element(pairs_, end, {}, &StatePair::cost);
    pairs_.erase(end, pairs_.end());
    limit_ = std::ranges::max(pairs_, {}, &StatePair::cost).cost;
  }

  std::size_t most_;
  double limit_ = std::numeric_limits<double>::infinity();
  std::vector<StatePair> pairs_;
};

/// Finds the controls that lead from the last layer of one tree to the last layer of the other.
class Joining {
 public:
  Joining(const Problem& problem, const DiscreteFlow& flow, const LatticeOptions& options, const MeetingTrees& trees)
      : flow_(flow),
        firsts_(trees.forward().back()),
        lasts_(trees.backward().back()),
        intervals_(options.connection * options.intervals_per_step),
        usual_(problem.guess(0.0).u),
        curvature_(curvature_of(problem)),
        steerings_(steerings(flow, firsts_.states, usual_, intervals_)) {}

  /// The pairs whose motions are cheapest by the linearised estimate.
  [[nodiscard]] std::vector<StatePair> cheapest_pairs(std::size_t most) const {
    CheapestPairs cheapest(most);
    const Eigen::MatrixXd targets = lasts_.states.transpose();
    for (Eigen::Index i = 0; i < firsts_.states.rows(); ++i) {
      const Steering& steering = steerings_[static_cast<std::size_t>(i)];
      if (!steering.root().allFinite() || !steering.end().allFinite()) continue;
      const Eigen::MatrixXd misses = steering.root() * (targets.colwise() - steering.end());
      const Eigen::VectorXd efforts = misses.colwise().squaredNorm().transpose();
      for (Eigen::Index j = 0; j < targets.cols(); ++j) {
        cheapest.offer({firsts_.costs[i] + curvature_ * efforts[j] + lasts_.costs[j], i, j});
      }
    }
    return std::move(cheapest).take();
  }

  /// Their motions, by some simplified Newton steps of shooting. Left out are those that do not come near.
  [[nodiscard]] std::vector<TreeConnection> joined(const std::vector<StatePair>& pairs) const {
    constexpr int newton_steps = 4;
    const auto count = static_cast<Eigen::Index>(pairs.size());
    std::vector<Eigen::VectorXd> misses;
    misses.reserve(pairs.size());
    for (const StatePair& pair : pairs) misses.emplace_back(target_of(pair) - steering_of(pair).end());
    std::vector<Eigen::MatrixXd> controls;
    Eigen::MatrixXd ends;
    Eigen::VectorXd costs;
    for (int i = 0; i <= newton_steps; ++i) {
      controls = controls_of(pairs, misses);
      costs = Eigen::VectorXd::Zero(count);
      ends = ends_under(pairs, controls, costs);
      if (i == newton_steps) break;
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        misses[k] += target_of(pairs[k]) - ends.row(static_cast<Eigen::Index>(k)).transpose();
      }
    }
    std::vector<TreeConnection> connections;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const double left = curvature_ * steering_of(pairs[k]).effort(target_of(pairs[k]) - ends.row(row).transpose());
      const double cost = costs[row] + left;
      if (!std::isfinite(cost) || left > largest_left_share * std::abs(cost)) continue;
      const StatePair& pair = pairs[k];
      connections.push_back({pair.first, pair.last, cost_to(pair) + cost, std::move(controls[k])});
    }
    std::ranges::stable_sort(connections, {}, &TreeConnection::cost);
    return connections;
  }

 private:
  // The permitted error of a connection's cost at the end of its Newton steps.
  static constexpr double largest_left_share = 0.1;

  /// Mean curvature of the cost in the controls, at the start.
  static double curvature_of(const Problem& problem);

  [[nodiscard]] const Steering& steering_of(const StatePair& pair) const {
    return steerings_[static_cast<std::size_t>(pair.first)];
  }
  [[nodiscard]] Eigen::VectorXd target_of(const StatePair& pair) const {
    return lasts_.states.row(pair.last).transpose();
  }
  /// The cost of both branches.
  [[nodiscard]] double cost_to(const StatePair& pair) const {
    return firsts_.costs[pair.first] + lasts_.costs[pair.last];
  }
  [[nodiscard]] std::vector<Eigen::MatrixXd> controls_of(const std::vector<StatePair>& pairs,
                                                         const std::vector<Eigen::VectorXd>& misses) const {
    std::vector<Eigen::MatrixXd> controls;
    controls.reserve(pairs.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      controls.emplace_back(steering_of(pairs[k]).deviations(misses[k]).rowwise() + usual_.transpose());
    }
    return controls;
  }

  [[nodiscard]] Eigen::MatrixXd ends_under(const std::vector<StatePair>& pairs,
                                           const std::vector<Eigen::MatrixXd>& controls, Eigen::VectorXd& costs) const {
    const auto count = static_cast<Eigen::Index>(pairs.size());
    Eigen::MatrixXd states(count, 2 * flow_.configuration_size());
    Eigen::MatrixXd u(count, flow_.control_size());
    for (Eigen::Index k = 0; k < count; ++k) {
      states.row(k) = firsts_.states.row(pairs[static_cast<std::size_t>(k)].first);
    }
    for (int interval = 0; interval < intervals_; ++interval) {
      for (Eigen::Index k = 0; k < count; ++k) u.row(k) = controls[static_cast<std::size_t>(k)].row(interval);
      flow_.advance(states, u, costs);
    }
    return states;
  }

  const DiscreteFlow& flow_;
  const MotionTreeLayer& firsts_;
  const MotionTreeLayer& lasts_;
  int intervals_;
  Eigen::VectorXd usual_;
  double curvature_;
  std::vector<Steering> steerings_;  // of every state of `firsts_`
};

double Joining::curvature_of(const Problem& problem) {
  const BoundaryState first = problem.initial_state();
  const Eigen::Index m = problem.control_size();
  PointFunction cost(problem.configuration_size(), m,
                     [&](const ControlledState& x) { return ExpressionVector{{problem.running_cost(x)}}; });
  // Second differences: exact for costs of second degree.
  const auto at = [&](const Eigen::VectorXd& u) {
    Eigen::VectorXd value(1);
    cost.evaluate(first.q, first.v, u, 0.0, value);
    return value[0];
  };
  const Eigen::VectorXd usual = problem.guess(0.0).u;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < m; ++i) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(m, i);
    sum += at(usual + unit) - 2.0 * at(usual) + at(usual - unit);
  }
  return sum / static_cast<double>(m);
}

}  // namespace

MeetingTrees::MeetingTrees(const Problem& problem, const DiscreteFlow& flow, const LatticeOptions& options) {
  constexpr std::size_t pairs_per_connection = 20;
  const int steps = options.time_steps - options.connection;
  const int forward_steps = (steps + 1) / 2;
  const Bounds configurations = problem.bounds().q;
  forward_ = grow_tree(flow, problem.initial_state(), options, configurations, forward_steps);
  backward_ = grow_tree(DiscreteFlow(problem, -flow.step()), problem.final_state(), options, configurations,
                        steps - forward_steps);
  const Joining joining(problem, flow, options, *this);
  connections_ = joining.joined(joining.cheapest_pairs(pairs_per_connection * options.most_connections));
  connections_.resize(std::min(connections_.size(), options.most_connections));
}

BoundaryState boundary_state(const MotionTreeLayer& layer, Eigen::Index number) {
  const Eigen::Index n = layer.states.cols() / 2;
  return {layer.states.row(number).head(n).transpose(), layer.states.row(number).tail(n).transpose()};
}

}  // namespace dmocbench
