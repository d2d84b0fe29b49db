// Roadmaps of systems without a symmetry: lattices of states between the ends of the problem.

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "bench/extensions/primitives/roadmap_systems.hpp"
#include "bench/run/solve_case.hpp"
#include "methods/error.hpp"
#include "methods/extensions/primitives/lattice_roadmap.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

namespace {

/// All controls whose entries are `levels` values spread evenly between plus and minus the largest ones, one per row.
Eigen::MatrixXd spread_controls(const Eigen::VectorXd& largest, int levels) {
  const Eigen::Index entries = largest.size();
  Eigen::Index count = 1;
  for (Eigen::Index i = 0; i < entries; ++i) count *= levels;
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(levels, -1.0, 1.0);
  Eigen::MatrixXd controls(count, entries);
  for (Eigen::Index row = 0; row < count; ++row) {
    Eigen::Index rest = row;
    for (Eigen::Index i = 0; i < entries; ++i, rest /= levels) controls(row, i) = largest[i] * values[rest % levels];
  }
  return controls;
}

/// The same bound for all entries.
Eigen::MatrixXd spread_controls(Eigen::Index entries, double largest, int levels) {
  return spread_controls(Eigen::VectorXd::Constant(entries, largest), levels);
}

/// The same size for all angles and lengths, and for all their rates.
Eigen::VectorXd cells(Eigen::Index n, double configuration, double velocity) {
  Eigen::VectorXd sizes(2 * n);
  sizes << Eigen::VectorXd::Constant(n, configuration), Eigen::VectorXd::Constant(n, velocity);
  return sizes;
}

/// The answer of DMOC from the problem's guess.
Trajectory first_motion(const Problem& problem, const PrimitiveOptions& options) {
  constexpr int intervals = 64;
  const Case the_case{.problem = {std::shared_ptr<const Problem>(), &problem},  // not owned
                      .method = "dmoc",
                      .grid = Grid::uniform(intervals)};
  const std::unique_ptr<Transcription> program = the_case.transcribe();
  require_primitives(*program);
  const Solution solution = make_solver("interior_point", {.stop_requested = options.stop_requested})
                                ->solve(*program, sample(*program, guessed_motion(problem)));
  stop_if_requested();
  if (!is_solved(solution.status)) {
    throw Error(
        "{}: a lattice of states needs a first trajectory, but DMOC did not find one from the guess with N "
        "= {}: {}; improve the guess",
        problem.name(), intervals, solution.message);
  }
  return read_trajectory(*program, solution.primal, {});
}

/// Largest less smallest entry of every column; 1 where all are the same.
Eigen::VectorXd ranges_of(const Eigen::MatrixXd& columns) {
  const Eigen::VectorXd ranges = columns.colwise().maxCoeff() - columns.colwise().minCoeff();
  return (ranges.array() > 0.0).select(ranges, 1.0);
}

}  // namespace

StoredRoadmap roadmap_along_a_motion(const Problem& problem, const PrimitiveOptions& options) {
  constexpr double beyond = 1.25;
  constexpr double cells_of_a_range = 12.0;
  const Trajectory motion = first_motion(problem, options);
  const Eigen::VectorXd largest = motion.stage_u.cwiseAbs().colwise().maxCoeff();
  const int levels = largest.size() == 1 ? 7 : largest.size() == 2 ? 5 : 3;
  const Eigen::Index n = motion.q.cols();
  Eigen::VectorXd cell(2 * n);
  cell << ranges_of(motion.q) / cells_of_a_range, ranges_of(motion.v) / cells_of_a_range;
  return lattice_roadmap(problem,
                         {.time_steps = 8,
                          .intervals_per_step = 16,
                          .connection = 2,
                          .controls = spread_controls(beyond * largest, levels),
                          .cell = std::move(cell),
                          .most_states = 1500,
                          .most_connections = 200},
                         options);
}

StoredRoadmap chosen_lattice_roadmap(const Problem& problem, const PrimitiveOptions& options) {
  const std::map<std::string, LatticeOptions> lattices{
      // time steps, intervals in each, time steps of a connection, controls, cells, most states, most connections
      {"two_link_manipulator", {4, 16, 1, spread_controls(2, 30.0, 5), cells(2, 0.3, 1.0), 1500, 200}},
      {"cart_pole", {10, 13, 2, spread_controls(1, 12.0, 7), cells(2, 0.1, 0.4), 1500, 200}},
      {"acrobot", {24, 11, 4, spread_controls(1, 6.0, 5), cells(2, 0.2, 0.5), 3000, 300}}};
  return lattice_roadmap(problem, lattices.at(problem.name()), options);
}

}  // namespace dmocbench
