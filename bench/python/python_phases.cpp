#include "bench/python/python_phases.hpp"

#include <optional>
#include <tuple>

#include <pybind11/stl.h>

#include "bench/python/bindings.hpp"

namespace dmocbench::python {

namespace py = pybind11;

namespace {

std::vector<PhasedProblem::Phase> phases_of(const py::object& original) {
  original.attr("_check")();
  std::vector<PhasedProblem::Phase> phases;
  for (const py::handle entry : original.attr("_phase_list")()) {
    const auto [name, handle, follows] =
        entry.cast<std::tuple<std::string, ProblemHandle, std::optional<std::size_t>>>();
    phases.push_back({.name = name, .problem = handle.problem, .follows = follows});
  }
  return phases;
}

/// The sides of a switch as Python has them.
PhaseEnd end_of(const py::object& point) {
  PhaseEnd end;
  end.q = formulas_in(point.attr("q"));
  end.v = formulas_in(point.attr("v"));
  end.y = formulas_in(point.attr("y"));
  end.p = formulas_in(point.attr("p"));
  end.t = formulas_in(point.attr("t"))[0];
  return end;
}

VectorFormula formula_of(const py::object& function) {
  return [function](const ExpressionVector& x) { return formulas_in(function(list_of(x))); };
}

}  // namespace

PythonPhases::PythonPhases(const py::object& original)
    : PhasedProblem(phases_of(original), PythonObject::parameters_of(original)), python_(original, *this) {
  python_.give_values(*this);
}

bool PythonPhases::is_one(const py::object& original) { return py::hasattr(original, "_phase_list"); }

py::object PythonPhases::point(std::size_t phase, const PhaseEnd& end) const {
  const Problem& problem = *phases()[phase].problem;
  return python_.object().attr("_end_at")(problem.configuration_names(), problem.first_order_names(), list_of(end.q),
                                          list_of(end.v), number_or_formula(end.t), list_of(end.y), list_of(end.p));
}

ExpressionVector PythonPhases::link(std::size_t i, const PhaseEnd& before, const PhaseEnd& after) const {
  const std::size_t from = preceding(i + 1);
  return python_.formula("_link", [&] {
    return py::make_tuple(phases()[from].name, phases()[i + 1].name, point(from, before), point(i + 1, after));
  });
}

ExpressionVector PythonPhases::conditions(const std::vector<PhaseEnd>& first, const std::vector<PhaseEnd>& last) const {
  if (!python_.states("conditions")) return {};
  return python_.formula("_conditions", [&] {
    py::list names;
    py::list starts;
    py::list ends;
    for (std::size_t i = 0; i < first.size(); ++i) {
      names.append(phases()[i].name);
      starts.append(point(i, first[i]));
      ends.append(point(i, last[i]));
    }
    return py::make_tuple(names, starts, ends);
  });
}

double PythonPhases::cost_scale() const {
  if (!python_.states("cost_scale")) return PhasedProblem::cost_scale();
  return python_.asked("cost_scale", [&] { return python_.object().attr("_number_of")("cost_scale").cast<double>(); });
}

ProblemCard PythonPhases::card() const {
  ProblemCard card = PhasedProblem::card();
  return python_.asked("card", [&] {
    const py::dict stated = python_.object().attr("_words")();
    if (const auto words = stated["description"].cast<std::string>(); !words.empty()) card.description = words;
    card.source = stated["source"].cast<std::string>();
    if (!stated["reference"].is_none()) {
      const auto [objective, digits, certificate] = stated["reference"].cast<std::tuple<double, int, std::string>>();
      card.reference = {.objective = objective, .digits = digits, .certificate = certificate};
    }
    return card;
  });
}

void bind_phases(py::module_& module) {
  const auto link = [&](const char* name, ExpressionVector (*conditions)(const PhaseEnd&, const PhaseEnd&)) {
    module.def(name, [conditions](const py::object& before, const py::object& after) {
      return list_of(conditions(end_of(before), end_of(after)));
    });
  };
  link("continuous", continuous);
  link("momentum_kept", momentum_kept);
  module.def("dropped", [](const py::object& before, const py::object& after, const py::object& amount) {
    return list_of(dropped(end_of(before), end_of(after), formulas_in(amount)));
  });
  module.def("impact", [](const py::object& before, const py::object& after, const py::object& guard,
                          const py::object& restitution, const py::object& impulse) {
    return list_of(
        impact(formula_of(guard), formulas_in(restitution)[0], formulas_in(impulse), end_of(before), end_of(after)));
  });
  module.def("new_foothold", [](const py::object& before, const py::object& after, const py::object& lagrangian,
                                const py::object& on_old_foot, const py::object& on_new_foot) {
    const auto of_body = [&](const State& x) {
      return formulas_in(lagrangian(list_of(x.q), list_of(x.v), number_or_formula(x.t), list_of(x.y)))[0];
    };
    return list_of(
        new_foothold({of_body, formula_of(on_old_foot), formula_of(on_new_foot)}, end_of(before), end_of(after)));
  });
}

}  // namespace dmocbench::python
