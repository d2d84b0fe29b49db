#include "bench/primitives/roadmap_systems.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "methods/error.hpp"

namespace dmocbench {

const std::vector<RoadmapSystem>& roadmap_systems() {
  static const std::vector<RoadmapSystem> systems{
      {"orbital_transfer", "circular orbits", rotating_roadmap},
      {"spherical_pendulum", "steady cones", rotating_roadmap},
      {"hovercraft", "rest and gliding", hovercraft_roadmap},
      {"planar_quadrotor", "level flight", quadrotor_roadmap},
      {"two_link_manipulator", "lattice of states", two_link_roadmap, 64, 2, true},
      {"cart_pole", "lattice of states", cart_pole_roadmap, 64, 2, true},
      {"acrobot", "lattice of states", acrobot_roadmap, 256, 2, true},
  };
  return systems;
}

const RoadmapSystem& roadmap_system(const std::string& problem) {
  const std::vector<RoadmapSystem>& systems = roadmap_systems();
  const auto place = std::ranges::find(systems, problem, &RoadmapSystem::problem);
  if (place != systems.end()) return *place;
  std::vector<std::string> names;
  for (const RoadmapSystem& each : systems) names.push_back(each.problem);
  throw Error(fmt::format("there is no roadmap of '{}'; choose from {}", problem, fmt::join(names, ", ")));
}

}  // namespace dmocbench
