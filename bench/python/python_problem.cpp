#include "bench/python/python_problem.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bench/python/bindings.hpp"
#include "bench/python/calls.hpp"
#include "bench/python/formula_text.hpp"
#include "methods/error.hpp"
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

/// As long as it exists, this thread traces a formula.
class Tracing {
 public:
  Tracing() { ++traced_formulas(); }
  ~Tracing() { --traced_formulas(); }
  Tracing(const Tracing&) = delete;
  Tracing& operator=(const Tracing&) = delete;
  Tracing(Tracing&&) = delete;
  Tracing& operator=(Tracing&&) = delete;
};

py::list list_of(const ExpressionVector& entries) {
  py::list list;
  for (const Expression& entry : entries) list.append(py::cast(entry));
  return list;
}

std::string type_of(py::handle object) { return Py_TYPE(object.ptr())->tp_name; }

/// The end of a sentence about an object that is not a formula.
std::string what_was_returned(py::handle object) {
  return object.is_none() ? "returns None; is a \"return\" missing?"
                          : fmt::format("returns {}, expected formulas or numbers", type_of(object));
}

std::vector<Parameter> parameters_of(const py::object& original) {
  std::vector<Parameter> parameters;
  for (const py::handle item : original.attr("_declared_parameters")()) {
    const auto [name, value, unit, meaning, lower, upper, whole, is_unknown] =
        item.cast<std::tuple<std::string, double, std::string, std::string, double, double, bool, bool>>();
    parameters.push_back({name, value, unit, meaning, lower, upper, whole, is_unknown});
  }
  return parameters;
}

Bounds bounds_of(const py::handle numbers, const char* name) {
  const auto [lower, upper] = numbers[name].cast<std::pair<Eigen::VectorXd, Eigen::VectorXd>>();
  return {.lower = lower, .upper = upper};
}

/// A single pair of bounds is meant for every one of `size` entries.
Bounds for_each(const Bounds& bounds, Eigen::Index size) {
  return bounds.lower.size() == 1 ? Bounds::all(size, bounds.lower[0], bounds.upper[0]) : bounds;
}

}  // namespace

py::object ParameterReader::read(const std::string& name) const {
  if (problem_ == nullptr)
    throw Error("parameter " + name + ": the solve that this copy of the problem was for is over");
  const std::vector<Parameter>& parameters = problem_->parameters();
  const bool is_whole = parameters[parameter_number(*problem_, name)].whole;
  if (is_whole) return py::int_(static_cast<long long>(problem_->parameter(name)));
  if (traced_formulas() > 0) {
    const Expression value = problem_->varying(name);
    name_inputs(ExpressionVector::Constant(1, value), "", {name});
    return number_or_formula(value);
  }
  return py::float_(problem_->parameter(name));
}

PythonProblem::PythonProblem(const py::object& original)
    : Problem(parameters_of(original)), reader_(py::cast(ParameterReader())) {
  object_ = original.attr("_bound")(reader_);
  reader_.cast<ParameterReader&>().problem_ = this;
  name_ = object_.attr("_problem_name")().cast<std::string>();
  configuration_names_ = object_.attr("_coordinate_names")().cast<std::vector<std::string>>();
  control_names_ = object_.attr("_control_names")().cast<std::vector<std::string>>();
  first_order_names_ = object_.attr("_first_order_names")().cast<std::vector<std::string>>();
  members_ = object_.attr("_stated_members")().cast<std::vector<std::string>>();
  has_constant_numbers_ = object_.attr("_has_constant_numbers")().cast<bool>();
  const auto values = object_.attr("_values").cast<std::map<std::string, double>>();
  for (const auto& [name, value] : values) set_parameter(name, value);
}

// NOLINTNEXTLINE(bugprone-exception-escape): the constructor has made the reader that is cast
PythonProblem::~PythonProblem() {
  if (Py_IsInitialized() == 0) {  // the objects ended with Python
    object_.release();
    reader_.release();
    return;
  }
  const py::gil_scoped_acquire gil;
  reader_.cast<ParameterReader&>().problem_ = nullptr;
  object_ = {};
  reader_ = {};
}

std::unique_ptr<Problem> PythonProblem::clone() const {
  const py::gil_scoped_acquire gil;
  auto copy = std::make_unique<PythonProblem>(object_);
  for (const Parameter& parameter : parameters()) copy->set_parameter(parameter.name, parameter.value);
  return copy;
}

template <class Work>
auto PythonProblem::asked_of_python(const char* member, const Work& work) const {
  const py::gil_scoped_acquire gil;
  try {
    return work();
  } catch (py::error_already_set& error) {
    const bool is_ours = error.matches(py::module_::import("dmocbench._core").attr("Error"));
    const bool is_stop = error.matches(PyExc_KeyboardInterrupt);
    const bool is_memory = error.matches(PyExc_MemoryError);
    const std::string sentence =
        is_ours ? py::str(error.value()).cast<std::string>()
                : fmt::format("{}: {}", type_of(error.value()), py::str(error.value()).cast<std::string>());
    if (!is_ours) Call::keep(error);
    if (is_stop) throw Stopped("interrupted");
    if (is_memory) throw std::bad_alloc();
    throw Error(sentence.starts_with(name_) ? sentence : fmt::format("{}: {}: {}", name_, member, sentence));
  }
}

bool PythonProblem::states(const char* member) const { return std::ranges::find(members_, member) != members_.end(); }

void PythonProblem::name_entries(const State& x) const {
  name_inputs(x.q, "q", configuration_names_);
  name_inputs(x.v, "v", configuration_names_);
  name_inputs(x.y, "y", first_order_names_);
  name_inputs(ExpressionVector::Constant(1, x.t), "", {"t"});
}

py::object PythonProblem::point(const State& x) const {
  name_entries(x);
  return object_.attr("_point")(list_of(x.q), list_of(x.v), py::none(), number_or_formula(x.t), list_of(x.y));
}

py::object PythonProblem::point(const ControlledState& x) const {
  name_entries(x.state());
  name_inputs(x.u, "u", control_names_);
  return object_.attr("_point")(list_of(x.q), list_of(x.v), list_of(x.u), number_or_formula(x.t), list_of(x.y));
}

template <class Arguments>
ExpressionVector PythonProblem::formula(const char* member, const Arguments& arguments) const {
  return asked_of_python(member, [&]() -> ExpressionVector {
    const Tracing tracing;
    const py::object returned = object_.attr(member)(*arguments());
    if (const auto single = as_expression(returned)) return ExpressionVector::Constant(1, *single);
    const bool is_text = py::isinstance<py::str>(returned) || py::isinstance<py::dict>(returned);
    if (is_text || !(py::isinstance<py::sequence>(returned) || py::hasattr(returned, "__len__"))) {
      throw Error(what_was_returned(returned));
    }
    std::vector<Expression> entries;
    for (const py::handle entry : returned) {
      const auto traced = as_expression(entry);
      if (!traced) {
        throw Error(fmt::format("entry {} of what it returns is {}, expected a formula or a number", entries.size(),
                                entry.is_none() ? "None" : type_of(entry)));
      }
      entries.push_back(*traced);
    }
    return Eigen::Map<const ExpressionVector>(entries.data(), static_cast<Eigen::Index>(entries.size()));
  });
}

template <class Arguments>
Expression PythonProblem::single_formula(const char* member, const Arguments& arguments) const {
  const ExpressionVector entries = formula(member, arguments);
  if (entries.size() != 1) {
    throw Error(fmt::format("{}: {} returns {} entries, expected one formula", name_, member, entries.size()));
  }
  return entries[0];
}

template <class Arguments>
ExpressionVector PythonProblem::optional_formula(const char* member, const Arguments& arguments) const {
  return states(member) ? formula(member, arguments) : ExpressionVector();
}

Expression PythonProblem::lagrangian(const State& x) const {
  return single_formula("lagrangian", [&] { return py::make_tuple(point(x)); });
}

ExpressionVector PythonProblem::force(const ControlledState& x) const {
  if (!states("force")) return ExpressionVector::Constant(x.q.size(), Expression(0.0));
  return formula("force", [&] { return py::make_tuple(point(x)); });
}

Expression PythonProblem::running_cost(const ControlledState& x) const {
  if (!states("running_cost")) return {};
  return single_formula("running_cost", [&] { return py::make_tuple(point(x)); });
}

ExpressionVector PythonProblem::first_order_rates(const ControlledState& x) const {
  return optional_formula("first_order_rates", [&] { return py::make_tuple(point(x)); });
}

ExpressionVector PythonProblem::integrands(const ControlledState& x) const {
  return optional_formula("integrands", [&] { return py::make_tuple(point(x)); });
}

ExpressionVector PythonProblem::path_constraints(const ControlledState& x) const {
  return optional_formula("path_constraints", [&] { return py::make_tuple(point(x)); });
}

ExpressionVector PythonProblem::constraints(const ExpressionVector& q) const {
  return optional_formula("constraints", [&] { return py::make_tuple(object_.attr("_coordinates_at")(list_of(q))); });
}

ExpressionVector PythonProblem::boundary_conditions(const State& first, const State& last) const {
  return optional_formula("boundary_conditions", [&] { return py::make_tuple(point(first), point(last)); });
}

Expression PythonProblem::final_cost(const State& last) const {
  if (!states("final_cost")) return {};
  return single_formula("final_cost", [&] { return py::make_tuple(point(last)); });
}

std::optional<ExpressionVector> PythonProblem::symmetry(const ExpressionVector& q) const {
  if (!states("symmetry")) return std::nullopt;
  return formula("symmetry", [&] { return py::make_tuple(object_.attr("_coordinates_at")(list_of(q))); });
}

double PythonProblem::cost_scale() const {
  if (!states("cost_scale")) return Problem::cost_scale();
  return asked_of_python("cost_scale", [&] { return object_.attr("_number_of")("cost_scale").cast<double>(); });
}

MotionPoint PythonProblem::guess(double t) const {
  if (!states("guess")) return Problem::guess(t);
  return asked_of_python("guess", [&]() -> MotionPoint {
    using Vector = Eigen::VectorXd;
    const auto [q, v, u, y] = object_.attr("_guess_at")(t).cast<std::tuple<Vector, Vector, Vector, Vector>>();
    return {.q = q, .v = v, .u = u, .y = y};
  });
}

ProblemCard PythonProblem::card() const {
  return asked_of_python("card", [&] {
    const py::dict stated = object_.attr("_card")();
    ProblemCard card;
    card.description = stated["description"].cast<std::string>();
    card.source = stated["source"].cast<std::string>();
    if (states("guess")) card.guess = stated["guess"].cast<std::string>();
    const auto [unit, factor] = stated["time_unit"].cast<std::pair<std::string, double>>();
    card.time_unit = {unit, factor};
    card.configuration_units = stated["configuration_units"].cast<std::vector<std::string>>();
    card.control_units = stated["control_units"].cast<std::vector<std::string>>();
    card.path_constraint_names = stated["path_constraint_names"].cast<std::vector<std::string>>();
    card.boundary_condition_names = stated["boundary_condition_names"].cast<std::vector<std::string>>();
    if (!stated["reference"].is_none()) {
      const auto [objective, digits, certificate] = stated["reference"].cast<std::tuple<double, int, std::string>>();
      card.reference = {.objective = objective, .digits = digits, .certificate = certificate};
    }
    card.picture = [this](const ControlledState& x) {
      return asked_of_python("picture", [&] {
        const Tracing tracing;
        Picture picture;
        for (const py::handle quantity : object_.attr("_picture")(point(x))) {
          const auto [name, quantity_unit, value] = quantity.cast<std::tuple<std::string, std::string, py::object>>();
          const auto traced = as_expression(value);
          if (!traced) throw Error(fmt::format("the quantity {} is {}, no formula", name, type_of(value)));
          picture.push_back({name, quantity_unit, *traced});
        }
        return picture;
      });
    };
    return card;
  });
}

ControlledState PythonProblem::some_point() const {
  InputCounter inputs;
  ControlledState x{inputs.take(configuration_size()), inputs.take(configuration_size()), inputs.take(control_size()),
                    inputs.take()};
  x.y = inputs.take(first_order_size());
  return x;
}

std::shared_ptr<const PythonProblem::Numbers> PythonProblem::numbers() const {
  const Eigen::VectorXd parameters = parameter_values(*this);
  {
    const std::lock_guard lock(last_numbers_use_);  // never held during calls of Python
    if (last_numbers_ && (has_constant_numbers_ || last_numbers_->parameters == parameters)) return last_numbers_;
  }
  auto numbers = std::make_shared<const Numbers>(read_numbers());
  const std::lock_guard lock(last_numbers_use_);
  last_numbers_ = numbers;
  return numbers;
}

PythonProblem::Numbers PythonProblem::read_numbers() const {
  return asked_of_python("start, end, horizon or bounds", [&] {
    const py::dict stated = object_.attr("_numbers")();
    const auto vector = [&](const char* name) { return stated[name].cast<Eigen::VectorXd>(); };
    Numbers numbers;
    numbers.parameters = parameter_values(*this);
    numbers.first = {.q = vector("first_q"), .v = vector("first_v"), .y = vector("first_y")};
    numbers.last = {.q = vector("last_q"), .v = vector("last_v"), .y = vector("last_y")};
    const auto [horizon, least, largest] = stated["horizon"].cast<std::tuple<double, double, double>>();
    numbers.horizon = horizon;
    numbers.bounds.horizon = {least, largest};
    numbers.bounds.first = {.q = bounds_of(stated, "first_q_bounds"),
                            .v = bounds_of(stated, "first_v_bounds"),
                            .y = bounds_of(stated, "first_y_bounds")};
    numbers.bounds.last = {.q = bounds_of(stated, "last_q_bounds"),
                           .v = bounds_of(stated, "last_v_bounds"),
                           .y = bounds_of(stated, "last_y_bounds")};
    numbers.bounds.q = bounds_of(stated, "q_bounds");
    numbers.bounds.v = bounds_of(stated, "v_bounds");
    numbers.bounds.u = bounds_of(stated, "u_bounds");
    numbers.bounds.y = bounds_of(stated, "y_bounds");
    for (const py::handle waypoint : stated["waypoints"]) {
      const auto [time, parts] = waypoint.cast<std::pair<double, py::dict>>();
      const auto part = [&parts = parts](const char* name) {
        return parts.contains(name) ? bounds_of(parts, name) : Bounds{};
      };
      numbers.bounds.interior.push_back({.relative_time = time, .q = part("q"), .v = part("v"), .y = part("y")});
    }
    const ControlledState x = some_point();
    if (stated.contains("path_bounds"))
      numbers.bounds.path = for_each(bounds_of(stated, "path_bounds"), path_constraints(x).size());
    if (stated.contains("integrals_bounds"))
      numbers.bounds.integrals = for_each(bounds_of(stated, "integrals_bounds"), integrands(x).size());
    return numbers;
  });
}

}  // namespace dmocbench::python
