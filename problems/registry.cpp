#include "problems/registry.hpp"

#include <array>

#include "methods/choose.hpp"
#include "problems/acrobot.hpp"
#include "problems/beam.hpp"
#include "problems/brachistochrone.hpp"
#include "problems/cart_pole.hpp"
#include "problems/container_crane.hpp"
#include "problems/double_integrator.hpp"
#include "problems/double_oscillator.hpp"
#include "problems/eccentric_transfer.hpp"
#include "problems/forced_oscillator.hpp"
#include "problems/hang_glider.hpp"
#include "problems/hovercraft.hpp"
#include "problems/hypersensitive.hpp"
#include "problems/kepler_cartesian.hpp"
#include "problems/link_chain.hpp"
#include "problems/orbital_transfer.hpp"
#include "problems/particle_steering.hpp"
#include "problems/planar_quadrotor.hpp"
#include "problems/planar_quadrotor_flip.hpp"
#include "problems/robot_arm.hpp"
#include "problems/spherical_pendulum.hpp"
#include "problems/two_link_manipulator.hpp"

namespace dmocbench {

namespace {

template <class Type>
std::unique_ptr<Problem> make() {
  return std::make_unique<Type>();
}

using Maker = std::unique_ptr<Problem> (*)();

// One line per problem.
constexpr std::array registry{
    Maker{make<OrbitalTransfer>},
    Maker{make<TwoLinkManipulator>},
    Maker{make<KeplerCartesian>},
    Maker{make<LinkChain>},
    Maker{make<DoubleIntegrator>},
    Maker{make<ForcedOscillator>},
    Maker{make<Brachistochrone>},
    Maker{make<ParticleSteering>},
    Maker{make<CartPole>},
    Maker{make<Acrobot>},
    Maker{make<PlanarQuadrotor>},
    Maker{make<PlanarQuadrotorFlip>},
    Maker{make<SphericalPendulum>},
    Maker{make<Hovercraft>},
    Maker{make<RobotArm>},
    Maker{make<HangGlider>},
    Maker{make<ContainerCrane>},
    Maker{make<DoubleOscillator>},
    Maker{make<Beam>},
    Maker{make<EccentricTransfer>},
    Maker{make<Hypersensitive>},
};

constexpr auto problem_name = [](const Maker create) { return create()->name(); };

}  // namespace

std::vector<std::string> problem_names() { return names_of(registry, problem_name); }

std::vector<std::string> paper_problem_names() { return {"orbital_transfer", "two_link_manipulator"}; }

std::unique_ptr<Problem> make_problem(std::string_view name) {
  return one_of(registry, problem_name, name, "there is no problem")();
}

}  // namespace dmocbench
