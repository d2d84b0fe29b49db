#include "methods/transcription/elements/galerkin_element.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/error.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/transcription/elements/dmoc_element.hpp"
#include "methods/transcription/elements/polynomial_rates.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

namespace {

Tableau tableau_of_space(std::string_view family, int stages, std::string_view what) {
  const std::vector<int> offered = tableau_stages(family);
  if (std::ranges::count(offered, stages) > 0) return make_tableau(family, stages);
  throw Error("galerkin: {} must be one of {}, not {}", what, fmt::join(offered, ", "), stages);
}

/// `space` if the quadrature has enough points for it; `what` names its size, such as "degree 3".
const Tableau& fit_for(const Tableau& quadrature, const Tableau& space, const std::string& what) {
  if (space.stages() <= quadrature.stages()) return space;
  throw Error("galerkin with {} needs at least {} quadrature points, got {}", what, space.stages(),
              quadrature.stages());
}

}  // namespace

GalerkinElement::GalerkinElement(int degree, int control_nodes, bool has_continuous_controls)
    : Element(galerkin_name(degree, control_nodes, has_continuous_controls),
              fmt::format(
                  "Galerkin variational integrator with q of degree {}, {} controls of degree {} and any quadrature",
                  degree, has_continuous_controls ? "continuous" : "discontinuous", control_nodes - 1),
              NodeState::configuration),
      rates_(tableau_of_space("gauss", degree, "the degree of configurations")),
      controls_(has_continuous_controls
                    ? tableau_of_space("lobatto_shared", control_nodes, "the number of shared control nodes")
                    : tableau_of_space("gauss", control_nodes, "the number of control nodes")) {}

Tableau GalerkinElement::rates(const Tableau& quadrature) const {
  return fit_for(quadrature, rates_, fmt::format("degree {}", rates_.stages()));
}

Tableau GalerkinElement::controls(const Tableau& quadrature) const {
  return fit_for(quadrature, controls_, fmt::format("{} control nodes", controls_.stages()));
}

IntervalTrace GalerkinElement::trace(const TracedProblem& problem, const Tableau& quadrature,
                                     const IntervalUnknowns& unknowns) const {
  const auto rates = stage_rates(unknowns.left_q, unknowns.right_q, unknowns.rates_q, rates_.b, unknowns.h);
  StagePath path;
  path.configurations = stage_values(unknowns.left_q, rates, integrals_to(quadrature.c, rates_), unknowns.h);
  for (const double tau : quadrature.c) {
    path.rates.push_back(polynomial_at(rates_.c, rates, tau));
    path.controls.push_back(polynomial_at(controls_.c, unknowns.controls, tau));
  }
  return lagrange_d_alembert(problem, quadrature, unknowns, path, rates_.b);
}

std::string galerkin_name(int degree, int control_nodes, bool has_continuous_controls) {
  return fmt::format("{}_{}_{}{}", galerkin_family, degree, control_nodes, has_continuous_controls ? "_shared" : "");
}

std::unique_ptr<Element> make_galerkin_element(std::string_view spaces) {
  constexpr std::string_view shared = "_shared";
  const bool is_continuous = spaces.ends_with(shared);
  const std::string_view numbers = spaces.substr(0, spaces.size() - (is_continuous ? shared.size() : 0));
  const std::size_t bar = numbers.find('_');
  const auto degree = parsed<int>(numbers.substr(0, bar));
  const auto nodes = bar == std::string_view::npos ? std::nullopt : parsed<int>(numbers.substr(bar + 1));
  if (!degree || !nodes) {
    throw Error(R"("{}_{}" does not name a degree and a number of control nodes, as "{}" does)", galerkin_family,
                spaces, galerkin_name(2, 1, is_continuous));
  }
  return std::make_unique<GalerkinElement>(*degree, *nodes, is_continuous);
}

}  // namespace dmocbench
