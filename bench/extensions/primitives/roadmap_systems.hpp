#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "methods/extensions/primitives/primitive_library.hpp"
#include "methods/extensions/primitives/solve_primitives.hpp"
#include "methods/extensions/primitives/stored_roadmap.hpp"
#include "methods/extensions/primitives/trim.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A library whose states are trims.
[[nodiscard]] PrimitiveLibrary library_of_trims(const Problem& problem, const std::vector<Trim>& trims, double step,
                                                int intervals_per_step);

/// Solves the requests and keeps, of those with the same two states, turn of the frame and duration, the `most`
/// cheapest.
void solve_cheapest(const Problem& problem, const std::vector<PrimitiveRequest>& requests, std::size_t most,
                    PrimitiveLibrary& library, const PrimitiveOptions& options);

/// Builds the roadmap of a problem. Throws `Error` if it cannot, `Stopped` where the options request a stop.
using BuildRoadmap = std::function<StoredRoadmap(const Problem& problem, const PrimitiveOptions& options)>;

/// A problem with its primitives.
struct RoadmapSystem {
  std::string problem;
  std::string nodes;  ///< the kind of nodes, in words
  BuildRoadmap build;
  int intervals = 64;  ///< of the full solve
  int stages = 2;      ///< of its Gauss tableau
  /// Its picture is the plane of q_1 and q_2, or of q_1 and its velocity where there is no other configuration; not
  /// the plane of the first two quantities of `ProblemCard::picture`.
  bool shows_configurations = false;
};

/// All problems whose primitives are chosen by hand. To add one, write its function below and a line into the list.
[[nodiscard]] const std::vector<RoadmapSystem>& roadmap_systems();
/// The one with that name; for any other problem `roadmap_along_a_motion`.
[[nodiscard]] const RoadmapSystem& roadmap_system(const std::string& problem);

/// Problems whose trims turn about an axis (`Problem::symmetry`) at any rate: circular orbits, the cones of a spherical
/// pendulum.
[[nodiscard]] StoredRoadmap rotating_roadmap(const Problem& problem, const PrimitiveOptions& options);
/// The hovercraft: rest and gliding, moved by translations and rotations of the plane.
[[nodiscard]] StoredRoadmap hovercraft_roadmap(const Problem& problem, const PrimitiveOptions& options);
/// The planar quadrotor: level flight in all directions, moved by translations.
[[nodiscard]] StoredRoadmap quadrotor_roadmap(const Problem& problem, const PrimitiveOptions& options);

/// Systems without a symmetry, on lattices of states: the two-link manipulator, the cart with a pole, the acrobot.
[[nodiscard]] StoredRoadmap chosen_lattice_roadmap(const Problem& problem, const PrimitiveOptions& options);

/// Any problem: a lattice of states, whose cells are a share of the ranges of the motion that DMOC finds from the
/// problem's guess, and whose controls go a little beyond that motion's. Throws `Error` if DMOC finds
/// none, or as `lattice_roadmap`.
[[nodiscard]] StoredRoadmap roadmap_along_a_motion(const Problem& problem, const PrimitiveOptions& options);

}  // namespace dmocbench
