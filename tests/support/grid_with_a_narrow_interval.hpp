#pragma once

#include "methods/transcription/motions/grid.hpp"

namespace dmocbench::tests {

/// Sixteen even intervals and one between them that is a ten-millionth of the horizon.
inline Grid grid_with_a_narrow_interval() {
  Eigen::VectorXd nodes(18);
  nodes.head(9) = Eigen::VectorXd::LinSpaced(9, 0.0, 0.5);
  nodes.tail(9) = Eigen::VectorXd::LinSpaced(9, 0.5, 1.0);
  nodes[9] += 1e-7;
  return Grid::from_nodes(nodes);
}

}  // namespace dmocbench::tests
