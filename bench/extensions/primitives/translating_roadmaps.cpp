#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "bench/extensions/primitives/roadmap_systems.hpp"
#include "methods/extensions/primitives/stored_roadmap.hpp"
#include "methods/extensions/primitives/symmetry_group.hpp"
#include "methods/extensions/primitives/trim.hpp"

namespace dmocbench {

namespace {

// Both systems are q = (x, y, θ). Positions lie on a lattice of the plane whose cells divide the way to the goal;
// velocities are such that a trim advances by whole cells in a time step.

/// Cells, or cells per time step.
struct Cells {
  int x = 0;
  int y = 0;
};

Generator along_axis(Eigen::Index axis) {
  return [axis](const ExpressionVector& q) {
    ExpressionVector generator = ExpressionVector::Constant(q.size(), Expression(0.0));
    generator[axis] = Expression(1.0);
    return generator;
  };
}

Generator about_origin() {
  return [](const ExpressionVector& q) { return ExpressionVector{{-q[1], q[0], 1.0}}; };
}

/// The lattice, its time step and the trims on it.
class PlaneLattice {
 public:
  /// The goal is `goal` cells away from the start; both axes should have some.
  PlaneLattice(const Problem& problem, std::vector<Generator> generators, Cells goal, int steps)
      : group_(problem, std::move(generators)),
        solver_(problem, group_),
        start_(problem.initial_state().q),
        step_(problem.horizon() / steps) {
    const Eigen::VectorXd way = problem.final_state().q - start_;
    cell_x_ = way[0] / goal.x;
    cell_y_ = way[1] / goal.y;
  }

  [[nodiscard]] double step() const noexcept { return step_; }
  /// Moves by cells after having turned by quarters about the origin.
  [[nodiscard]] Displacement moved(Cells cells, int quarters = 0) const {
    Displacement moved = Displacement::translation(Eigen::Vector3d(cells.x * cell_x_, cells.y * cell_y_, 0.0));
    if (quarters == 0) return moved;
    return moved.after(group_.flow(Eigen::Vector3d(0.0, 0.0, quarters * std::numbers::pi / 2.0), 1.0));
  }
  /// Adds the trim with this many cells per time step, its controls found from a guess.
  void add_trim(Cells speed, const Eigen::VectorXd& u) {
    Eigen::VectorXd rates = Eigen::VectorXd::Zero(group_.dimension());
    rates[0] = speed.x * cell_x_ / step_;
    rates[1] = speed.y * cell_y_ / step_;
    const Eigen::Index first_control = start_.size() + rates.size();
    trims_.push_back(solver_.solve({.q = start_, .rates = rates, .u = u}, {first_control, first_control + 1}));
    speeds_.push_back(speed);
  }
  [[nodiscard]] const std::vector<Trim>& trims() const noexcept { return trims_; }
  [[nodiscard]] const std::vector<Cells>& speeds() const noexcept { return speeds_; }

 private:
  SymmetryGroup group_;
  TrimSolver solver_;
  Eigen::VectorXd start_;
  double step_;
  double cell_x_ = 0.0;
  double cell_y_ = 0.0;
  std::vector<Trim> trims_;
  std::vector<Cells> speeds_;
};

/// A velocity turned by quarters.
Cells turned_by(int quarters, Cells speed) {
  for (int k = 0; k < (quarters + 4) % 4; ++k) speed = {-speed.y, speed.x};
  return speed;
}

/// The maneuvers that are tried between two trims.
struct ManeuverRange {
  int quarters = 0;            ///< by which the frame turns
  std::vector<int> durations;  ///< in time steps
  std::vector<int> offsets;    ///< in cells, along both axes, from where the mean velocity leads to
};

/// Every trim for a time step, and maneuvers between any two of them.
std::vector<PrimitiveRequest> plane_requests(const PlaneLattice& lattice, const std::vector<ManeuverRange>& ranges) {
  std::vector<PrimitiveRequest> requests;
  const std::size_t count = lattice.trims().size();
  const auto add = [&](std::size_t from, std::size_t to, const ManeuverRange& range) {
    const Cells leaving = lattice.speeds()[from];
    const Cells arriving = turned_by(range.quarters, lattice.speeds()[to]);
    for (const int duration : range.durations) {
      const Cells mean{duration * (leaving.x + arriving.x) / 2, duration * (leaving.y + arriving.y) / 2};
      for (const int x : range.offsets) {
        for (const int y : range.offsets) {
          requests.push_back({.first = from,
                              .last = to,
                              .displacement = lattice.moved({mean.x + x, mean.y + y}, range.quarters),
                              .duration = duration});
        }
      }
    }
  };
  for (std::size_t from = 0; from < count; ++from) {
    requests.push_back(
        {.first = from, .last = from, .displacement = lattice.moved(lattice.speeds()[from]), .duration = 1});
    for (std::size_t to = 0; to < count; ++to) {
      for (const ManeuverRange& range : ranges) add(from, to, range);
    }
  }
  return requests;
}

StoredRoadmap grown_on(const PlaneLattice& lattice, PrimitiveLibrary library, Cells goal, int quarters, int steps) {
  const Displacement to_goal = lattice.moved(goal, quarters);
  constexpr double margin = 0.3;  // of the way, about the rectangle between start and goal
  const Eigen::Vector2d corner = to_goal.shift.head(2);
  const Eigen::Vector2d low = corner.cwiseMin(0.0) - margin * corner.cwiseAbs();
  const Eigen::Vector2d high = corner.cwiseMax(0.0) + margin * corner.cwiseAbs();
  const auto may_visit = [=](const RoadmapNode& node) {
    const Eigen::Vector2d place = node.moved.shift.head(2);
    return (place.array() >= low.array()).all() && (place.array() <= high.array()).all();
  };
  return grow_roadmap(std::move(library), {.start = {.state = 0, .moved = Displacement::identity(3)},
                                           .goal = {.state = 0, .moved = to_goal},
                                           .duration = steps,
                                           .may_visit = may_visit});
}

}  // namespace

StoredRoadmap quadrotor_roadmap(const Problem& problem, const PrimitiveOptions& options) {
  constexpr int steps = 12;
  constexpr Cells goal{16, 8};
  PlaneLattice lattice(problem, {along_axis(0), along_axis(1)}, goal, steps);
  for (const int x : {0, 1, 2}) {
    for (const int y : {0, 1}) lattice.add_trim({x, y}, problem.guess(0.0).u);
  }
  PrimitiveLibrary library = library_of_trims(problem, lattice.trims(), lattice.step(), 3);
  const std::vector<ManeuverRange> ranges{{.durations = {3, 4, 5, 6}, .offsets = {-1, 0, 1}}};
  solve_cheapest(problem, plane_requests(lattice, ranges), 9, library, options);
  return grown_on(lattice, std::move(library), goal, 0, steps);
}

StoredRoadmap hovercraft_roadmap(const Problem& problem, const PrimitiveOptions& options) {
  constexpr int steps = 10;
  constexpr Cells goal{8, 8};
  PlaneLattice lattice(problem, {along_axis(0), along_axis(1), about_origin()}, goal, steps);
  for (const Cells speed : {Cells{0, 0}, Cells{1, 1}, Cells{0, 2}, Cells{1, 2}}) {
    lattice.add_trim(speed, Eigen::Vector2d::Zero());
  }
  PrimitiveLibrary library = library_of_trims(problem, lattice.trims(), lattice.step(), 3);
  // Without thrust the linearised hovercraft moves sideways only as far as it turns: starts need some.
  PrimitiveOptions with_thrust = options;
  with_thrust.start_control = Eigen::Vector2d(0.3, 0.0);
  // A force at the stern that turns the hovercraft also pushes it sideways. The mean velocity does not determine this
  // sideways displacement.
  const std::vector<ManeuverRange> ranges{{.quarters = 0, .durations = {3, 4, 5}, .offsets = {-1, 0, 1}},
                                          {.quarters = 1, .durations = {5, 6, 7}, .offsets = {-6, -4, -2, 0, 2, 4, 6}}};
  solve_primitives(problem, plane_requests(lattice, ranges), library, with_thrust);
  return grown_on(lattice, std::move(library), goal, 1, steps);
}

}  // namespace dmocbench
