#include "bench/python/python_problem.hpp"

#include <algorithm>
#include <utility>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bench/python/bindings.hpp"
#include "bench/python/calls.hpp"
#include "bench/python/formula_text.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/first_order_problem.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/mechanics/point_of_inputs.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench::python {

namespace py = pybind11;

namespace {

Bounds bounds_of(const py::handle numbers, const char* name) {
  const auto [lower, upper] = numbers[name].cast<std::pair<Eigen::VectorXd, Eigen::VectorXd>>();
  return {.lower = lower, .upper = upper};
}

/// A single pair of bounds is meant for every one of `size` entries.
Bounds for_each(const Bounds& bounds, Eigen::Index size) {
  return bounds.lower.size() == 1 ? Bounds::all(size, bounds.lower[0], bounds.upper[0]) : bounds;
}

}  // namespace

PythonProblem::PythonProblem(const py::object& original)
    : Problem(PythonObject::parameters_of(original)), python_(original, *this) {
  const py::object& object = python_.object();
  configuration_names_ = object.attr("_coordinate_names")().cast<std::vector<std::string>>();
  control_names_ = object.attr("_control_names")().cast<std::vector<std::string>>();
  first_order_names_ = object.attr("_first_order_names")().cast<std::vector<std::string>>();
  has_constant_numbers_ = object.attr("_has_constant_numbers")().cast<bool>();
  python_.give_values(*this);
}

void PythonProblem::name_entries(const State& x) const {
  name_inputs(x.q, "q", configuration_names_);
  name_inputs(x.v, "v", configuration_names_);
  name_inputs(x.y, "y", first_order_names_);
  name_inputs(ExpressionVector::Constant(1, x.t), "", {"t"});
}

py::object PythonProblem::point(const State& x) const {
  name_entries(x);
  return python_.object().attr("_point")(list_of(x.q), list_of(x.v), py::none(), number_or_formula(x.t), list_of(x.y));
}

py::object PythonProblem::point(const ControlledState& x) const {
  name_entries(x.state());
  name_inputs(x.u, "u", control_names_);
  return python_.object().attr("_point")(list_of(x.q), list_of(x.v), list_of(x.u), number_or_formula(x.t),
                                         list_of(x.y));
}

py::object PythonProblem::point(const ExpressionVector& q) const {
  return python_.object().attr("_coordinates_at")(list_of(q));
}

template <class Point>
Expression PythonProblem::single_formula(const char* member, const Point& x) const {
  const ExpressionVector entries = formula(member, x);
  if (entries.size() != 1) {
    throw Error("{}: {} returns {}, expected one formula", name(), member, counted(entries.size(), "entry", "entries"));
  }
  return entries[0];
}

Expression PythonProblem::lagrangian(const State& x) const {
  if (has_no_configuration(*this)) return 0.5 * x.v[0] * x.v[0];
  return single_formula("lagrangian", x);
}

ExpressionVector PythonProblem::force(const ControlledState& x) const {
  if (!python_.states("force")) return ExpressionVector::Constant(x.q.size(), Expression(0.0));
  return formula("force", x);
}

Expression PythonProblem::running_cost(const ControlledState& x) const {
  return python_.states("running_cost") ? single_formula("running_cost", x) : Expression();
}

ExpressionVector PythonProblem::velocity_constraints(const ExpressionVector& q, const ExpressionVector& v) const {
  if (!python_.states("velocity_constraints")) return {};
  return python_.formula("velocity_constraints", [&] {
    return py::make_tuple(point(q), python_.object().attr("_coordinates_at")(list_of(v), "v"));
  });
}

Expression PythonProblem::final_cost(const State& last) const {
  return python_.states("final_cost") ? single_formula("final_cost", last) : Expression();
}

std::optional<ExpressionVector> PythonProblem::symmetry(const ExpressionVector& q) const {
  if (!python_.states("symmetry")) return std::nullopt;
  return formula("symmetry", q);
}

double PythonProblem::cost_scale() const {
  if (!python_.states("cost_scale")) return Problem::cost_scale();
  return python_.asked("cost_scale", [&] { return python_.object().attr("_number_of")("cost_scale").cast<double>(); });
}

MotionPoint PythonProblem::guess(double t) const {
  if (!python_.states("guess")) return Problem::guess(t);
  return python_.asked("guess", [&]() -> MotionPoint {
    using Vector = Eigen::VectorXd;
    const auto [q, v, u, y] = python_.object().attr("_guess_at")(t).cast<std::tuple<Vector, Vector, Vector, Vector>>();
    return {.q = q, .v = v, .u = u, .y = y};
  });
}

ProblemCard PythonProblem::card() const {
  return python_.asked("card", [&] {
    const py::dict stated = python_.object().attr("_card")();
    ProblemCard card;
    card.description = stated["description"].cast<std::string>();
    card.source = stated["source"].cast<std::string>();
    if (python_.states("guess")) card.guess = stated["guess"].cast<std::string>();
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
      return python_.asked("picture", [&] {
        const Tracing tracing;
        Picture picture;
        for (const py::handle quantity : python_.object().attr("_picture")(point(x))) {
          const auto [name, quantity_unit, value] = quantity.cast<std::tuple<std::string, std::string, py::object>>();
          const auto traced = as_expression(value);
          if (!traced) throw Error("the quantity {} is {}, not a formula", name, type_of(value));
          picture.push_back({name, quantity_unit, *traced});
        }
        return picture;
      });
    };
    return card;
  });
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
  return python_.asked("start, end, horizon or bounds", [&] {
    const py::dict stated = python_.object().attr("_numbers")();
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
    const ControlledState x = point_of_inputs(*this);
    if (stated.contains("path_bounds"))
      numbers.bounds.path = for_each(bounds_of(stated, "path_bounds"), path_constraints(x).size());
    if (stated.contains("integrals_bounds"))
      numbers.bounds.integrals = for_each(bounds_of(stated, "integrals_bounds"), integrands(x).size());
    return numbers;
  });
}

}  // namespace dmocbench::python
