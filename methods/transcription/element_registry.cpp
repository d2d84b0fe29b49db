#include <array>

#include <fmt/format.h>

#include "methods/choose.hpp"
#include "methods/runtime/parsed.hpp"
#include "methods/transcription/collocation_elements.hpp"
#include "methods/transcription/dmoc_element.hpp"
#include "methods/transcription/shooting_element.hpp"

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

constexpr std::string_view shooting_prefix = "multiple_shooting_";

/// The family of a name behind `shooting_prefix`: "INTEGRATOR_SUBSTEPS".
std::unique_ptr<Element> make_shooting(std::string_view rest) {
  const std::size_t bar = rest.rfind('_');
  const std::string_view integrator = rest.substr(0, bar);
  const auto substeps = bar == std::string_view::npos ? std::nullopt : parsed<int>(rest.substr(bar + 1));
  if (!substeps) {
    throw Error(fmt::format("\"{}{}\" names no number of substeps; {}, for example, does", shooting_prefix, rest,
                            multiple_shooting_name("rk4", 1)));
  }
  return std::make_unique<MultipleShootingElement>(explicit_integrator(integrator), *substeps);
}

}  // namespace

std::vector<std::string> element_names() { return names_of(registry, family_name); }

std::vector<std::string> all_element_names() {
  std::vector<std::string> names = element_names();
  for (const std::string& integrator : explicit_integrator_names()) {
    names.push_back(multiple_shooting_name(integrator, 1));
  }
  return names;
}

std::string multiple_shooting_name(std::string_view integrator, int substeps) {
  return fmt::format("{}{}_{}", shooting_prefix, integrator, substeps);
}

std::unique_ptr<Element> make_element(std::string_view name) {
  if (name.starts_with(shooting_prefix)) return make_shooting(name.substr(shooting_prefix.size()));
  return one_of(registry, family_name, name, "there is no method")();
}

}  // namespace dmocbench
