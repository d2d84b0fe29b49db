#include "bench/extensions/primitives/roadmap_systems.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace dmocbench {

PrimitiveLibrary library_of_trims(const Problem& problem, const std::vector<Trim>& trims, double step,
                                  int intervals_per_step) {
  PrimitiveLibrary library = PrimitiveLibrary::of(problem, step, intervals_per_step);
  for (const Trim& trim : trims) library.states.push_back(trim.state);
  return library;
}

void solve_cheapest(const Problem& problem, const std::vector<PrimitiveRequest>& requests, std::size_t most,
                    PrimitiveLibrary& library, const PrimitiveOptions& options) {
  solve_primitives(problem, requests, library, options);
  std::vector<Primitive>& all = library.primitives;
  std::ranges::stable_sort(all, {}, &Primitive::cost);
  std::map<std::tuple<std::size_t, std::size_t, int, long long, long long>, std::size_t> kept;
  std::erase_if(all, [&](const Primitive& each) {
    const Eigen::MatrixXd& turn = each.displacement.linear;
    const auto key = std::tuple(each.first, each.last, each.duration, std::llround(4.0 * turn(0, 0)),
                                turn.rows() > 1 ? std::llround(4.0 * turn(1, 0)) : 0);
    return ++kept[key] > most;
  });
}

const std::vector<RoadmapSystem>& roadmap_systems() {
  static const std::vector<RoadmapSystem> systems{
      {"orbital_transfer", "circular orbits", rotating_roadmap},
      {"spherical_pendulum", "steady cones", rotating_roadmap},
      {"hovercraft", "rest and gliding", hovercraft_roadmap},
      {"planar_quadrotor", "level flight", quadrotor_roadmap},
      {"two_link_manipulator", "lattice of states", chosen_lattice_roadmap, 64, 2, true},
      {"cart_pole", "lattice of states", chosen_lattice_roadmap, 64, 2, true},
      {"acrobot", "lattice of states", chosen_lattice_roadmap, 256, 2, true},
  };
  return systems;
}

const RoadmapSystem& roadmap_system(const std::string& problem) {
  static const RoadmapSystem any{"", "lattice of states", roadmap_along_a_motion, 64, 2, true};
  const auto found = std::ranges::find(roadmap_systems(), problem, &RoadmapSystem::problem);
  return found != roadmap_systems().end() ? *found : any;
}

}  // namespace dmocbench
