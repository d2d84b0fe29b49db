#include "bench/python/python_object.hpp"

#include <algorithm>
#include <new>
#include <tuple>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "bench/python/bindings.hpp"
#include "bench/python/calls.hpp"
#include "bench/python/formula_text.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/motion_constraints.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench::python {

namespace py = pybind11;

namespace {

/// How many formulas this thread traces, one within the other.
int& traced_formulas() {
  thread_local int count = 0;
  return count;
}

/// The end of a sentence about an object that is not a formula.
std::string what_was_returned(py::handle object) {
  return object.is_none() ? "returns None; add the missing \"return\""
                          : fmt::format("returns {}, expected formulas or numbers", type_of(object));
}

}  // namespace

Tracing::Tracing() { ++traced_formulas(); }
Tracing::~Tracing() { --traced_formulas(); }

py::list list_of(const ExpressionVector& entries) {
  py::list list;
  for (const Expression& entry : entries) list.append(py::cast(entry));
  return list;
}

std::string type_of(py::handle object) { return Py_TYPE(object.ptr())->tp_name; }

const Problem& ProblemReader::problem(const std::string& asked) const {
  if (problem_ == nullptr) throw Error(asked + ": this copy of the problem belongs to a solve that has ended");
  return *problem_;
}

py::list ProblemReader::constraint_multipliers(const py::object& q, const py::object& v, const py::object& u,
                                               const py::object& y, const py::object& t) const {
  const ControlledState x{formulas_in(q), formulas_in(v), formulas_in(u), formulas_in(t)[0], formulas_in(y)};
  return list_of(dmocbench::constraint_multipliers(problem("constraint_multipliers"), x));
}

py::object ProblemReader::read(const std::string& name) const {
  const std::vector<Parameter>& parameters = problem("parameter " + name).parameters();
  const bool is_whole = parameters[parameter_number(*problem_, name)].whole;
  if (is_whole) return py::int_(static_cast<long long>(problem_->parameter(name)));
  if (traced_formulas() > 0) {
    const Expression value = problem_->varying(name);
    name_inputs(ExpressionVector::Constant(1, value), "", {name});
    return number_or_formula(value);
  }
  return py::float_(problem_->parameter(name));
}

std::vector<Parameter> PythonObject::parameters_of(const py::object& original) {
  std::vector<Parameter> parameters;
  for (const py::handle item : original.attr("_declared_parameters")()) {
    const auto [name, value, unit, meaning, lower, upper, whole, is_unknown] =
        item.cast<std::tuple<std::string, double, std::string, std::string, double, double, bool, bool>>();
    parameters.push_back({name, value, unit, meaning, lower, upper, whole, is_unknown});
  }
  return parameters;
}

PythonObject::PythonObject(const py::object& original, const Problem& problem) : reader_(py::cast(ProblemReader())) {
  object_ = original.attr("_bound")(reader_);
  reader_.cast<ProblemReader&>().problem_ = &problem;
  name_ = object_.attr("_problem_name")().cast<std::string>();
  members_ = object_.attr("_stated_members")().cast<std::vector<std::string>>();
}

// NOLINTNEXTLINE(bugprone-exception-escape): the constructor has made the reader that is cast
PythonObject::~PythonObject() {
  if (Py_IsInitialized() == 0) {  // the objects ended with Python
    object_.release();
    reader_.release();
    return;
  }
  const py::gil_scoped_acquire gil;
  reader_.cast<ProblemReader&>().problem_ = nullptr;
  object_ = {};
  reader_ = {};
}

void PythonObject::rethrow(const char* member, py::error_already_set& error) const {
  const bool is_ours = error.matches(py::module_::import("dmocbench._core").attr("Error"));
  const bool is_stop = error.matches(PyExc_KeyboardInterrupt);
  const bool is_memory = error.matches(PyExc_MemoryError);
  const std::string sentence =
      is_ours ? py::str(error.value()).cast<std::string>()
              : fmt::format("{}: {}", type_of(error.value()), py::str(error.value()).cast<std::string>());
  if (!is_ours) Call::keep(error);
  if (is_stop) throw Stopped("interrupted");
  if (is_memory) throw std::bad_alloc();
  throw Error(sentence.starts_with(name_)
                  ? sentence
                  : fmt::format("{}: {}: {}", name_, member + (*member == '_' ? 1 : 0), sentence));
}

void PythonObject::give_values(Problem& problem) const {
  const auto values = object_.attr("_values").cast<std::map<std::string, double>>();
  for (const auto& [name, value] : values) problem.set_parameter(name, value);
}

bool PythonObject::states(const char* member) const { return std::ranges::find(members_, member) != members_.end(); }

ExpressionVector formulas_in(const py::object& returned) {
  if (const auto single = as_expression(returned)) return ExpressionVector::Constant(1, *single);
  const bool is_text = py::isinstance<py::str>(returned) || py::isinstance<py::dict>(returned);
  if (is_text || !(py::isinstance<py::sequence>(returned) || py::hasattr(returned, "__len__"))) {
    throw Error(what_was_returned(returned));
  }
  std::vector<Expression> entries;
  for (const py::handle entry : returned) {
    const auto traced = as_expression(entry);
    if (!traced) {
      throw Error("entry {} of the returned value is {}, expected a formula or a number", entries.size(),
                  entry.is_none() ? "None" : type_of(entry));
    }
    entries.push_back(*traced);
  }
  return Eigen::Map<const ExpressionVector>(entries.data(), static_cast<Eigen::Index>(entries.size()));
}

ExpressionVector PythonObject::formula(const char* member, const std::function<py::tuple()>& arguments) const {
  return asked(member, [&] {
    const Tracing tracing;
    return formulas_in(object_.attr(member)(*arguments()));
  });
}

}  // namespace dmocbench::python
