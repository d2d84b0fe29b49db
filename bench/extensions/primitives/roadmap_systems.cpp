#include "bench/extensions/primitives/roadmap_systems.hpp"

#include <algorithm>

namespace dmocbench {

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
