#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bench/python/bindings.hpp"
#include "bench/python/calls.hpp"
#include "bench/python/python_phases.hpp"
#include "bench/python/python_problem.hpp"
#include "bench/run/problem_libraries.hpp"
#include "methods/choose.hpp"
#include "methods/expression/schedule.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/point_of_inputs.hpp"
#include "methods/mechanics/problem_check.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "problems/problem_registry.hpp"
#include "problems/registry.hpp"

namespace dmocbench::python {

namespace py = pybind11;

namespace {

void set_values(Problem& problem, const std::map<std::string, double>& values) {
  for (const auto& [name, value] : values) problem.set_parameter(name, value);
}

ProblemHandle named(const std::string& name, const std::map<std::string, double>& values) {
  std::shared_ptr<Problem> problem = make_unchecked_problem(name);
  set_values(*problem, values);
  check_problem(*problem);
  return {std::move(problem), py::none()};
}

ProblemHandle of_python(const py::object& original) {
  std::shared_ptr<const Problem> problem;
  if (PythonPhases::is_one(original)) {
    problem = std::make_shared<PythonPhases>(original);
  } else {
    problem = std::make_shared<PythonProblem>(original);
  }
  without_gil([&](Call&) {
    check_problem(*problem);
    return true;
  });
  return {std::move(problem), original};
}

/// Operations of the formulas L, p, L_q, f, C, h and their derivatives, as they are traced of every problem.
std::size_t operation_count(const ProblemHandle& handle) {
  return without_gil([&](Call&) {
    const Problem& problem = *handle.problem;
    const ControlledState x = point_of_inputs(problem);
    const TracedProblem::Values values = TracedProblem(problem).at(x);
    std::vector<Expression> formulas{problem.lagrangian(x.state()), values.running_cost};
    for (const ExpressionVector* part : {&values.momentum, &values.generalised_force, &values.path_constraints}) {
      append(formulas, *part);
    }
    append(formulas, values.mass);
    append(formulas, values.momentum_by_configuration);
    return Schedule(formulas).operation_count();
  });
}

}  // namespace

void bind_problems(py::module_& module) {
  py::class_<ProblemReader>(module, "ProblemReader")
      .def("read", &ProblemReader::read)
      .def("constraint_multipliers", &ProblemReader::constraint_multipliers);
  py::class_<ProblemHandle>(module, "ProblemHandle", "The C++ handle of a problem.")
      .def(py::init(&of_python), py::arg("problem"))
      .def_static("named", &named, py::arg("name"), py::arg("values") = std::map<std::string, double>())
      .def_readonly("original", &ProblemHandle::original)
      .def_property_readonly("name", [](const ProblemHandle& handle) { return handle.problem->name(); })
      .def_property_readonly("settings", [](const ProblemHandle& handle) { return handle.problem->settings(); })
      .def_property_readonly("description",
                             [](const ProblemHandle& handle) { return handle.problem->card().description; })
      .def_property_readonly("coordinates",
                             [](const ProblemHandle& handle) { return handle.problem->configuration_names(); })
      .def_property_readonly("controls", [](const ProblemHandle& handle) { return handle.problem->control_names(); })
      .def_property_readonly("parameters",
                             [](const ProblemHandle& handle) {
                               std::map<std::string, double> values;
                               for (const Parameter& one : handle.problem->parameters()) values[one.name] = one.value;
                               return values;
                             })
      .def("operation_count", &operation_count, "Numbers of operations of the formulas and their derivatives.");
  module.def("problem_names", &problem_names, "Names of all problems that are built in or loaded.");
  module.def("spell_members", &spell_members, py::arg("names"),
             "Sets the names that messages use for members of Problem.");
  module.def(
      "load_problem_libraries",
      [](const std::vector<std::string>& files) {
        const std::size_t refused_before = known_problems().refused().size();
        load_problem_libraries(files);
        std::vector<std::string> refused = names_of(known_problems().refused(), &Registry::Refusal::reason);
        refused.erase(refused.begin(), refused.begin() + static_cast<std::ptrdiff_t>(refused_before));
        return refused;
      },
      py::arg("files"), "The reasons why some problems of the libraries cannot be used.");
  module.def(
      "check_parameter",
      [](const std::string& name, double value, double lower, double upper, bool whole) {
        Parameter{name, value, "", "", lower, upper, whole}.check(value);
      },
      py::arg("name"), py::arg("value"), py::arg("lower"), py::arg("upper"), py::arg("whole"));
}

}  // namespace dmocbench::python
