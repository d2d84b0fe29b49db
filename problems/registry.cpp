#include "problems/registry.hpp"

#include <algorithm>
#include <utility>

#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/class_name.hpp"
#include "methods/mechanics/problem_check.hpp"
#include "problems/acrobot.hpp"
#include "problems/beam.hpp"
#include "problems/bouncing_ball.hpp"
#include "problems/bouncing_hopper.hpp"
#include "problems/brachistochrone.hpp"
#include "problems/cannonball.hpp"
#include "problems/cart_pole.hpp"
#include "problems/cart_pole_cartesian.hpp"
#include "problems/chaplygin_sleigh.hpp"
#include "problems/chaplygin_sleigh_cartesian.hpp"
#include "problems/compass_gait.hpp"
#include "problems/container_crane.hpp"
#include "problems/control_rate.hpp"
#include "problems/double_integrator.hpp"
#include "problems/double_oscillator.hpp"
#include "problems/eccentric_transfer.hpp"
#include "problems/forced_oscillator.hpp"
#include "problems/formation.hpp"
#include "problems/goddard_rocket.hpp"
#include "problems/hang_glider.hpp"
#include "problems/hanging_chain.hpp"
#include "problems/hovercraft.hpp"
#include "problems/hypersensitive.hpp"
#include "problems/kepler_cartesian.hpp"
#include "problems/leg_hop.hpp"
#include "problems/link_chain.hpp"
#include "problems/link_chain_maximal.hpp"
#include "problems/orbital_transfer.hpp"
#include "problems/orbital_transfer_with_mass.hpp"
#include "problems/particle_steering.hpp"
#include "problems/planar_quadrotor.hpp"
#include "problems/planar_quadrotor_flip.hpp"
#include "problems/problem_registry.hpp"
#include "problems/refraction.hpp"
#include "problems/rigid_quadrotor.hpp"
#include "problems/robot_arm.hpp"
#include "problems/rolling_disk.hpp"
#include "problems/satellite_angles.hpp"
#include "problems/satellite_directors.hpp"
#include "problems/satellite_quaternion.hpp"
#include "problems/spherical_pendulum.hpp"
#include "problems/spherical_pendulum_cartesian.hpp"
#include "problems/spring_arm.hpp"
#include "problems/swing_and_release.hpp"
#include "problems/two_link_manipulator.hpp"
#include "problems/two_link_maximal.hpp"
#include "problems/two_link_with_motors.hpp"
#include "problems/two_stage_rocket.hpp"
#include "problems/waypoints.hpp"

namespace dmocbench {

namespace {

bool is_name(const std::string& text) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz";
  constexpr std::string_view all = "abcdefghijklmnopqrstuvwxyz0123456789_";
  return !text.empty() && letters.find(text.front()) != std::string_view::npos &&
         text.find_first_not_of(all) == std::string::npos && text != "all";
}

/// Throws `Error` if it is not a valid name.
std::string name_made_by(const Registry::Maker& maker) {
  std::string name = maker()->name();
  if (is_name(name)) return name;
  throw Error("a problem cannot be named \"" + name +
              R"(": names consist of small letters, digits and underscores, begin with a letter, and are not "all")");
}

std::string in_brackets(const std::string& origin) { return origin.empty() ? "" : " (" + origin + ")"; }

// One line per problem.
Registry problems_of_the_suite() {
  Registry registry;
  registry.add<OrbitalTransfer>();
  registry.add<TwoLinkManipulator>();
  registry.add<KeplerCartesian>();
  registry.add<LinkChain>();
  registry.add<DoubleIntegrator>();
  registry.add<ForcedOscillator>();
  registry.add<Brachistochrone>();
  registry.add<ParticleSteering>();
  registry.add<CartPole>();
  registry.add<Acrobot>();
  registry.add<PlanarQuadrotor>();
  registry.add<PlanarQuadrotorFlip>();
  registry.add<RigidQuadrotor>();
  registry.add<SphericalPendulum>();
  registry.add<Hovercraft>();
  registry.add<RobotArm>();
  registry.add<HangGlider>();
  registry.add<ContainerCrane>();
  registry.add<DoubleOscillator>();
  registry.add<Beam>();
  registry.add<EccentricTransfer>();
  registry.add<Hypersensitive>();
  registry.add<ControlRate>();
  registry.add<TwoLinkWithMotors>();
  registry.add<OrbitalTransferWithMass>();
  registry.add<GoddardRocket>();
  registry.add<HangingChain>();
  registry.add<Cannonball>();
  registry.add<SpringArm>();
  registry.add<SphericalPendulumCartesian>();
  registry.add<CartPoleCartesian>();
  registry.add<TwoLinkMaximal>();
  registry.add<LinkChainMaximal>();
  registry.add<SatelliteAngles>();
  registry.add<SatelliteQuaternion>();
  registry.add<SatelliteDirectors>();
  registry.add<Waypoints>();
  registry.add<Formation>();
  registry.add<BouncingBall>();
  registry.add<BouncingHopper>();
  registry.add<CompassGait>();
  registry.add<TwoStageRocket>();
  registry.add<Refraction>();
  registry.add<SwingAndRelease>();
  registry.add<ChaplyginSleigh>();
  registry.add<ChaplyginSleighCartesian>();
  registry.add<RollingDisk>();
  registry.add<LegHop>();
  return registry;
}

}  // namespace

void Registry::add(Maker maker, const std::type_info& type) {
  std::string name;
  const auto refuse = [&](const char* reason) {
    refused_.push_back({name, "the problem of class " + class_name(type) + " cannot be used: " + reason});
  };
  try {
    name = name_made_by(maker);
    require_new(name, "");
    entries_.push_back({name, std::move(maker), "", class_name(type)});
  } catch (const std::exception& error) {
    if (faults_ == Faults::thrown) throw;
    refuse(error.what());
  } catch (...) {
    if (faults_ == Faults::thrown) throw;
    refuse("it threw an object that is not a std::exception");
  }
}

void Registry::put(Maker maker, const std::string& origin) {
  const std::string name = name_made_by(maker);
  std::erase_if(entries_, [&](const Entry& entry) { return entry.name == name && entry.origin == origin; });
  require_new(name, origin);
  entries_.push_back({name, std::move(maker), origin, name});
}

void Registry::add_all(const Registry& others, const std::string& origin) {
  for (const Refusal& other : others.refused_) refused_.push_back({other.name, other.reason + in_brackets(origin)});
  for (const Entry& other : others.entries_) {
    try {
      require_new(other.name, origin);
      entries_.push_back({other.name, other.make, origin, other.type});
    } catch (const Error& error) {
      refused_.push_back({other.name, "the problem of class " + other.type + " cannot be used: " + error.what()});
    }
  }
}

std::vector<std::string> Registry::names() const { return names_of(entries_, &Entry::name); }

std::unique_ptr<Problem> Registry::make(std::string_view name) const {
  std::unique_ptr<Problem> problem = make_unchecked(name);
  check_problem(*problem);
  return problem;
}

std::unique_ptr<Problem> Registry::make_unchecked(std::string_view name) const { return entry(name).make(); }

const std::string& Registry::origin(std::string_view name) const { return entry(name).origin; }

const Registry::Entry& Registry::entry(std::string_view name) const {
  return one_of(entries_, &Entry::name, name, "there is no problem");
}

void Registry::require_new(const std::string& name, const std::string& origin) const {
  const auto known = std::ranges::find(entries_, name, &Entry::name);
  if (known == entries_.end()) return;
  throw Error("there is already a problem " + name + in_brackets(known->origin) + "; give the new problem" +
              in_brackets(origin) + " another name");
}

Registry& known_problems() {
  static Registry registry = problems_of_the_suite();
  return registry;
}

std::vector<std::string> problem_names() { return known_problems().names(); }

std::vector<std::string> paper_problem_names() { return {"orbital_transfer", "two_link_manipulator"}; }

std::unique_ptr<Problem> make_problem(std::string_view name) { return known_problems().make(name); }

std::unique_ptr<Problem> make_unchecked_problem(std::string_view name) { return known_problems().make_unchecked(name); }

}  // namespace dmocbench
