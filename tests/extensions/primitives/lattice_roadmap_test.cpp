#include "methods/extensions/primitives/lattice_roadmap.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "bench/extensions/primitives/planned_motion.hpp"
#include "methods/extensions/primitives/stored_roadmap.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/registry.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

LatticeOptions small_lattice() {
  LatticeOptions options;
  options.time_steps = 8;
  options.intervals_per_step = 8;
  options.connection = 2;
  options.controls = Eigen::VectorXd::LinSpaced(5, -12.0, 12.0);
  options.cell = Eigen::Vector4d(0.2, 0.2, 0.6, 0.6);
  options.most_states = 400;
  options.most_connections = 40;
  return options;
}

const Problem& cart_pole() {
  static const std::unique_ptr<Problem> problem = make_problem("cart_pole");
  return *problem;
}

/// Built once for all tests.
const StoredRoadmap& cart_pole_lattice() {
  static const StoredRoadmap stored = lattice_roadmap(cart_pole(), small_lattice());
  return stored;
}

TEST(CartPoleLattice, HasEdgesThatAreMotionsOfDmoc) {
  const PrimitiveLibrary& library = cart_pole_lattice().library;
  const WithoutBounds free(cart_pole());
  ASSERT_GT(library.primitives.size(), 20U);
  for (const Primitive& primitive : library.primitives) {
    const int intervals = primitive.duration * library.intervals_per_step;
    Transcription program(free, *make_element("dmoc"), gauss_tableau(1), Grid::uniform(intervals));
    const double duration = library.step * primitive.duration;
    program.set_horizon(duration);
    program.set_initial_state(library.states[primitive.first]);
    program.set_final_state(library.states[primitive.last]);
    const double h = duration / intervals;
    const Motion motion{[&](double t) {
                          const auto node = static_cast<Eigen::Index>(std::lround(t / h));
                          const auto interval = std::min<Eigen::Index>(static_cast<Eigen::Index>(t / h), intervals - 1);
                          return MotionPoint{primitive.q.row(node).transpose(), primitive.v.row(node).transpose(),
                                             primitive.u.row(interval).transpose()};
                        },
                        duration};
    Eigen::VectorXd residual(static_cast<Eigen::Index>(program.constraint_count()));
    program.constraints(sample(program, motion), residual);
    residual -= program.constraint_lower();
    EXPECT_LT(residual.lpNorm<Eigen::Infinity>(), 2e-9);
  }
}

TEST(CartPoleLattice, HasItsCheapestPathByExhaustiveSearchToo) {
  const Roadmap& roadmap = cart_pole_lattice().roadmap;
  const int duration = small_lattice().time_steps;
  double cheapest = std::numeric_limits<double>::infinity();
  const std::function<void(std::size_t, int, double)> walk = [&](std::size_t node, int t, double cost) {
    if (t == duration && node == cart_pole_lattice().goal) cheapest = std::min(cheapest, cost);
    const auto [first, last] = roadmap.leaving(node);
    for (std::size_t edge = first; edge < last; ++edge) {
      const int arrival = t + roadmap.duration(edge);
      if (arrival <= duration) walk(roadmap.edges()[edge].to, arrival, cost + roadmap.cost(edge));
    }
  };
  walk(cart_pole_lattice().start, 0, 0.0);
  const auto path = cheapest_path(roadmap, cart_pole_lattice().start, cart_pole_lattice().goal, duration);
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->cost, cheapest, 1e-9 * cheapest);
}

TEST(CartPoleLattice, BecomesNoDearerByTheFullSolve) {
  const auto path = cheapest_path(cart_pole_lattice().roadmap, cart_pole_lattice().start, cart_pole_lattice().goal,
                                  small_lattice().time_steps);
  ASSERT_TRUE(path);
  const Trajectory before = concatenate(cart_pole(), cart_pole_lattice().library, cart_pole_lattice().roadmap, *path);
  Transcription program(cart_pole(), *make_element("dmoc"), gauss_tableau(1), Grid::uniform(before.intervals()));
  const Solution solution = make_solver("interior_point", {})->solve(program, sample(program, smooth_motion(before)));
  ASSERT_EQ(solution.status, Status::solved);
  const Trajectory after = read_trajectory(program, solution.primal, {});
  EXPECT_LE(after.cost, before.cost);
  // One of the two minima that are known, 57.94 and 58.81, with the error of the grid.
  EXPECT_LT(after.cost, 60.0);
}

TEST(LatticeRoadmap, RefusesSizesThatDoNotFit) {
  const auto problem = make_problem("two_link_manipulator");
  tests::expect_error_naming({"two_link_manipulator", "2 entries"},
                             [&] { static_cast<void>(lattice_roadmap(*problem, small_lattice())); });
  LatticeOptions options = small_lattice();
  options.connection = 1;
  options.intervals_per_step = 3;
  tests::expect_error_naming({"3 intervals", "cart_pole"},
                             [&] { static_cast<void>(lattice_roadmap(cart_pole(), options)); });
  options = small_lattice();
  options.connection = 9;
  tests::expect_error_naming({"9", "8"}, [&] { static_cast<void>(lattice_roadmap(cart_pole(), options)); });
}

// Lattices of states whose sizes come from a first motion.

/// One configuration and several, with bounds and without.
TEST(RoadmapAlongAMotion, LeadsToTheCertifiedOptimumOfProblemsWithOneMinimum) {
  for (const std::string name : {"double_integrator", "forced_oscillator", "hypersensitive", "beam"}) {
    const std::shared_ptr<const Problem> problem = make_problem(name);
    const RoadmapSystem& system = roadmap_system(name);
    const PlannedMotion planned = plan_and_refine(
        problem, system, {.stored = system.build(*problem, {}), .seconds = 0.0, .is_read = false}, {.repeats = 1}, {});
    ASSERT_TRUE(planned.before) << name << ": " << planned.status;
    ASSERT_TRUE(planned.after) << name << ": " << planned.status;
    const double optimum = problem->card().reference->objective;
    EXPECT_GT(planned.before->cost, optimum) << name;
    EXPECT_NEAR(planned.after->cost / optimum, 1.0, 1e-2) << name;
  }
}

TEST(RoadmapAlongAMotion, NeedsFixedEndsAndHorizon) {
  const auto problem = make_problem("brachistochrone");
  tests::expect_error_naming({"brachistochrone", "horizon"},
                             [&] { static_cast<void>(roadmap_along_a_motion(*problem, {})); });
}

}  // namespace
}  // namespace dmocbench
