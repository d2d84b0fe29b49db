#include <array>
#include <cstddef>
#include <functional>

#include "methods/choose.hpp"
#include "methods/transcription/elements/collocation_elements.hpp"
#include "methods/transcription/elements/dmoc_element.hpp"
#include "methods/transcription/elements/shooting_element.hpp"

namespace dmocbench {

namespace {

template <class Type>
std::unique_ptr<Element> make() {
  return std::make_unique<Type>();
}

using Maker = std::unique_ptr<Element> (*)();

// One line per family that the paper compares.
constexpr std::array registry{
    Maker{make<DmocElement>},
    Maker{make<HamiltonianElement>},
    Maker{make<TangentElement>},
};

constexpr auto family_name = [](const Maker create) { return create()->name(); };

}  // namespace

std::vector<std::string> element_names() { return names_of(registry, family_name); }

std::vector<std::string> all_element_names() {
  std::vector<std::string> names = element_names();
  for (const std::string& integrator : shooting_integrator_names()) {
    for (const Shooting shooting : {Shooting::multiple, Shooting::single}) {
      names.push_back(shooting_name(shooting, integrator, 1));
    }
  }
  return names;
}

std::unique_ptr<Element> make_element(std::string_view name) {
  if (auto shooting = make_shooting_element(name)) return shooting;
  const std::size_t position = position_of(all_element_names(), std::identity(), name, "there is no method");
  return registry[position]();  // the names of shooting are behind those of the registry
}

}  // namespace dmocbench
