#include "methods/transcription/motions/grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/error.hpp"

namespace dmocbench {

Grid::Grid(Eigen::VectorXd nodes, Eigen::VectorXd widths) : nodes_(std::move(nodes)), widths_(std::move(widths)) {}

Grid Grid::uniform(long long intervals) {
  if (intervals < 1 || intervals > most_intervals) {
    throw Error("the number of intervals must lie between 1 and {}, got {}", most_intervals, intervals);
  }
  const auto count = static_cast<Eigen::Index>(intervals);
  Eigen::VectorXd nodes(count + 1);
  for (Eigen::Index k = 0; k <= count; ++k) nodes[k] = static_cast<double>(k) / static_cast<double>(count);
  return {std::move(nodes), Eigen::VectorXd::Constant(count, 1.0 / static_cast<double>(count))};
}

Grid Grid::from_nodes(Eigen::VectorXd relative_times) {
  const Eigen::Index count = relative_times.size() - 1;
  if (count < 1 || count > most_intervals) throw Error("a grid needs at least two node times, from 0 to 1");
  if (relative_times[0] != 0.0 || relative_times[count] != 1.0) {
    throw Error("relative node times must begin with 0 and end with 1");
  }
  Eigen::VectorXd widths = relative_times.tail(count) - relative_times.head(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!(widths[k] > 0.0)) {
      throw Error("relative node times must ascend: entry {} is not greater than entry {}", k + 1, k);
    }
    if (widths[k] < narrowest) {
      throw Error(
          "relative node times {} and {} are {:.1e} apart, less than {:g}: round-off would dominate the "
          "step between them; remove one of the two",
          k, k + 1, widths[k], narrowest);
    }
  }
  return {std::move(relative_times), std::move(widths)};
}

Grid Grid::with_nodes_at(const std::vector<double>& times) const {
  if (times.empty()) return *this;
  const auto count = std::ssize(times);
  const Eigen::Index last = nodes_.size() - 1;
  if (last <= count) {
    throw Error("{} times between the ends need a node each, so the grid needs at least {} intervals, not {}", count,
                count + 1, last);
  }
  Eigen::VectorXd moved(nodes_.size());
  Eigen::Index from = 0;  // the node that was moved last, and where to
  double to = 0.0;
  const auto move = [&](Eigen::Index node, double time) {
    const double stretch = (time - to) / (nodes_[node] - nodes_[from]);
    for (Eigen::Index k = from; k < node; ++k) moved[k] = to + stretch * (nodes_[k] - nodes_[from]);
    from = node;
    to = time;
  };
  for (Eigen::Index j = 0; j < count; ++j) {
    const double time = times[static_cast<std::size_t>(j)];
    const Eigen::Index above = std::clamp<Eigen::Index>(node_at(time), 1, last);
    const Eigen::Index nearest = time - nodes_[above - 1] < nodes_[above] - time ? above - 1 : above;
    move(std::clamp(nearest, from + 1, last - (count - j)), time);  // which leaves a node for each of the others
  }
  move(last, 1.0);
  moved[last] = 1.0;
  return from_nodes(std::move(moved));
}

Eigen::Index Grid::node_at(double relative_time) const {
  return std::lower_bound(nodes_.begin(), nodes_.end(), relative_time) - nodes_.begin();
}

}  // namespace dmocbench
