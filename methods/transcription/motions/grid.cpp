#include "methods/transcription/motions/grid.hpp"

#include <utility>

#include <fmt/format.h>

#include "methods/error.hpp"

namespace dmocbench {

Grid::Grid(Eigen::VectorXd nodes, Eigen::VectorXd widths) : nodes_(std::move(nodes)), widths_(std::move(widths)) {}

Grid Grid::uniform(long long intervals) {
  if (intervals < 1 || intervals > most_intervals) {
    throw Error(fmt::format("the number of intervals must lie between 1 and {}, got {}", most_intervals, intervals));
  }
  const auto count = static_cast<Eigen::Index>(intervals);
  Eigen::VectorXd nodes(count + 1);
  for (Eigen::Index k = 0; k <= count; ++k) nodes[k] = static_cast<double>(k) / static_cast<double>(count);
  return {std::move(nodes), Eigen::VectorXd::Constant(count, 1.0 / static_cast<double>(count))};
}

Grid Grid::from_nodes(Eigen::VectorXd relative_times) {
  const Eigen::Index count = relative_times.size() - 1;
  if (count < 1 || count > most_intervals) throw Error("a grid needs at least two node times, the first 0, the last 1");
  if (relative_times[0] != 0.0 || relative_times[count] != 1.0) {
    throw Error("relative node times must begin with 0 and end with 1");
  }
  Eigen::VectorXd widths = relative_times.tail(count) - relative_times.head(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!(widths[k] > 0.0)) {
      throw Error(fmt::format("relative node times must ascend: entry {} is not above entry {}", k + 1, k));
    }
    if (widths[k] < narrowest) {
      throw Error(
          fmt::format("relative node times {} and {} are {:.1e} apart, less than {:g}: rounding would hide the motion "
                      "between them; take one of the two out",
                      k, k + 1, widths[k], narrowest));
    }
  }
  return {std::move(relative_times), std::move(widths)};
}

}  // namespace dmocbench
