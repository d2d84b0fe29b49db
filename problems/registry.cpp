#include "problems/registry.hpp"

#include <array>

#include "methods/error.hpp"
#include "problems/acrobot.hpp"
#include "problems/brachistochrone.hpp"
#include "problems/cart_pole.hpp"
#include "problems/double_integrator.hpp"
#include "problems/orbital_transfer.hpp"
#include "problems/particle_steering.hpp"
#include "problems/planar_quadrotor.hpp"
#include "problems/planar_quadrotor_flip.hpp"
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
    Maker{make<OrbitalTransfer>}, Maker{make<TwoLinkManipulator>}, Maker{make<DoubleIntegrator>},
    Maker{make<Brachistochrone>}, Maker{make<ParticleSteering>},   Maker{make<CartPole>},
    Maker{make<Acrobot>},         Maker{make<PlanarQuadrotor>},    Maker{make<PlanarQuadrotorFlip>},
};

}  // namespace

std::vector<std::string> problem_names() {
  std::vector<std::string> names;
  for (const Maker create : registry) names.push_back(create()->name());
  return names;
}

std::vector<std::string> paper_problem_names() { return {"orbital_transfer", "two_link_manipulator"}; }

std::unique_ptr<Problem> make_problem(std::string_view name) {
  std::string known;
  for (const Maker create : registry) {
    auto problem = create();
    if (problem->name() == name) return problem;
    known += (known.empty() ? "" : ", ") + problem->name();
  }
  throw Error("there is no problem \"" + std::string(name) + "\"; choose one of " + known);
}

}  // namespace dmocbench
