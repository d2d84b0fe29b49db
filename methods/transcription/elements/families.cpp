#include "methods/transcription/elements/families.hpp"

#include <algorithm>
#include <array>
#include <functional>

#include "methods/choose.hpp"
#include "methods/transcription/elements/collocation_elements.hpp"
#include "methods/transcription/elements/dmoc_element.hpp"
#include "methods/transcription/elements/galerkin_element.hpp"
#include "methods/transcription/elements/second_order_element.hpp"
#include "methods/transcription/elements/shooting_element.hpp"

namespace dmocbench {

namespace {

template <class Type>
std::unique_ptr<Element> make(std::string_view /*integration*/) {
  return std::make_unique<Type>();
}

template <Shooting shooting>
std::unique_ptr<Element> shoot(std::string_view integration) {
  return make_shooting_element(shooting, integration);
}

constexpr std::array families{
    Family{.name = "dmoc", .label = "DMOC", .style = 1, .make = make<DmocElement>, .is_of_paper = true},
    Family{.name = "hamiltonian",
           .label = "Hamiltonian collocation",
           .style = 2,
           .make = make<HamiltonianElement>,
           .is_of_paper = true},
    Family{.name = "tangent",
           .label = "Tangent-space collocation",
           .style = 3,
           .make = make<TangentElement>,
           .is_of_paper = true},
    Family{.name = shooting_family(Shooting::multiple),
           .label = "Multiple shooting",
           .style = 4,
           .make = shoot<Shooting::multiple>,
           .suffix = MethodSuffix::integration},
    Family{.name = shooting_family(Shooting::single),
           .label = "Single shooting",
           .style = 5,
           .make = shoot<Shooting::single>,
           .suffix = MethodSuffix::integration,
           .is_condensed = true},
    Family{.name = galerkin_family,
           .label = "Galerkin variational integrator",
           .style = 6,
           .make = make_galerkin_element,
           .suffix = MethodSuffix::spaces},
    Family{.name = "second_order", .label = "Second-order collocation", .style = 7, .make = make<SecondOrderElement>},
};

/// Whether the method is the family, or begins with its name and "_" if it has a suffix.
bool has_method(const Family& family, std::string_view method) {
  if (!method.starts_with(family.name)) return false;
  const std::string_view rest = method.substr(family.name.size());
  return family.suffix == MethodSuffix::none ? rest.empty() : rest.starts_with('_');
}

}  // namespace

std::span<const Family> registered_families() { return families; }

const Family& family_of(std::string_view method) {
  for (const Family& family : families) {
    if (has_method(family, method)) return family;
  }
  return families[position_of(all_methods(), std::identity(), method, "there is no method")];  // throws
}

std::unique_ptr<Element> make_element(std::string_view name) {
  const Family& family = family_of(name);
  return family.make(name.substr(std::min(name.size(), family.name.size() + 1)));
}

std::vector<std::string> paper_families() {
  std::vector<std::string> names;
  for (const Family& family : families) {
    if (family.is_of_paper) names.emplace_back(family.name);
  }
  return names;
}

std::vector<std::string> all_families() { return names_of(families, &Family::name); }

std::vector<std::string> all_methods() {
  std::vector<std::string> names;
  for (const Family& family : families) {
    switch (family.suffix) {
      case MethodSuffix::none:
        names.emplace_back(family.name);
        break;
      case MethodSuffix::integration:
        for (const std::string& integrator : explicit_integrator_names()) {
          names.push_back(shooting_name(family.name, integrator, 1));
        }
        break;
      case MethodSuffix::spaces:
        names.push_back(galerkin_name(1, 1, false));
        break;
    }
  }
  return names;
}

}  // namespace dmocbench
