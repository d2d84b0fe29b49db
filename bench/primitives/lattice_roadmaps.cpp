// Roadmaps of systems without a symmetry: lattices of states between the ends of the problem.

#include "bench/primitives/roadmap_systems.hpp"
#include "methods/primitives/lattice_roadmap.hpp"

namespace dmocbench {

namespace {

/// All controls whose entries are `levels` values spread evenly from -largest to largest, one per row.
Eigen::MatrixXd spread_controls(Eigen::Index entries, double largest, int levels) {
  Eigen::Index count = 1;
  for (Eigen::Index i = 0; i < entries; ++i) count *= levels;
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(levels, -largest, largest);
  Eigen::MatrixXd controls(count, entries);
  for (Eigen::Index row = 0; row < count; ++row) {
    Eigen::Index rest = row;
    for (Eigen::Index i = 0; i < entries; ++i, rest /= levels) controls(row, i) = values[rest % levels];
  }
  return controls;
}

/// The same size for all angles and lengths, and for all their rates.
Eigen::VectorXd cells(Eigen::Index n, double configuration, double velocity) {
  Eigen::VectorXd sizes(2 * n);
  sizes << Eigen::VectorXd::Constant(n, configuration), Eigen::VectorXd::Constant(n, velocity);
  return sizes;
}

}  // namespace

StoredRoadmap two_link_roadmap(const Problem& problem, const PrimitiveOptions& options) {
  return lattice_roadmap(problem,
                         {.time_steps = 4,
                          .intervals_per_step = 16,
                          .connection = 1,
                          .controls = spread_controls(2, 30.0, 5),
                          .cell = cells(2, 0.3, 1.0),
                          .most_states = 1500,
                          .most_connections = 200},
                         options);
}

StoredRoadmap cart_pole_roadmap(const Problem& problem, const PrimitiveOptions& options) {
  return lattice_roadmap(problem,
                         {.time_steps = 10,
                          .intervals_per_step = 13,
                          .connection = 2,
                          .controls = spread_controls(1, 12.0, 7),
                          .cell = cells(2, 0.1, 0.4),
                          .most_states = 1500,
                          .most_connections = 200},
                         options);
}

StoredRoadmap acrobot_roadmap(const Problem& problem, const PrimitiveOptions& options) {
  return lattice_roadmap(problem,
                         {.time_steps = 24,
                          .intervals_per_step = 11,
                          .connection = 4,
                          .controls = spread_controls(1, 6.0, 5),
                          .cell = cells(2, 0.2, 0.5),
                          .most_states = 3000,
                          .most_connections = 300},
                         options);
}

}  // namespace dmocbench
