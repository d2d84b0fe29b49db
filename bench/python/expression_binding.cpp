#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "bench/python/bindings.hpp"
#include "bench/python/formula_text.hpp"
#include "methods/error.hpp"
#include "methods/expression/smooth.hpp"
#include "methods/expression/spline.hpp"

namespace dmocbench::python {

namespace py = pybind11;

std::optional<Expression> as_expression(py::handle object) {
  if (py::isinstance<Expression>(object)) return object.cast<Expression>();
  if (py::isinstance<py::array>(object)) {  // numpy makes arrays without dimensions of sums and products
    if (object.cast<py::array>().ndim() > 0) return std::nullopt;
    return as_expression(py::object(object.attr("item")()));
  }
  PyObject* const pointer = object.ptr();
  const bool is_number = PyFloat_Check(pointer) || PyLong_Check(pointer);
  if (!is_number && !py::hasattr(object, "__float__")) return std::nullopt;
  const double value = PyFloat_AsDouble(pointer);
  if (PyErr_Occurred() != nullptr) throw py::error_already_set();
  return Expression(value);
}

py::object number_or_formula(const Expression& formula) {
  if (const auto value = formula.constant_value()) return py::float_(*value);
  return py::cast(formula);
}

namespace {

py::object not_implemented() { return py::reinterpret_borrow<py::object>(Py_NotImplemented); }

/// An operator of two numbers; Python tries the other operand where it is neither a formula nor a number.
template <class Apply>
auto binary(Apply apply) {
  return [apply](const Expression& left, py::handle other) -> py::object {
    const auto right = as_expression(other);
    return right ? py::cast(Expression(apply(left, *right))) : not_implemented();
  };
}

/// A method that only refuses, because a formula has no value yet.
template <class... Operands>
auto refusing(const char* sentence) {
  return [sentence](const Expression&, const Operands&...) -> py::object { throw py::type_error(sentence); };
}

py::object power(const Expression& base, const py::object& exponent) {
  const auto value = as_expression(exponent);
  if (!value) return not_implemented();
  if (const auto constant = value->constant_value()) return py::cast(pow(base, *constant));
  throw py::type_error("an exponent cannot be a formula; write exp(y * log(x)) for x**y, where x > 0");
}

std::string text_of(const Expression& formula) {
  const auto value = formula.constant_value();
  return value ? fmt::format("Expression({})", *value) : text_of_formula(formula);
}

void bind_class(py::module_& module) {
  constexpr const char* no_branch =
      "a formula has no value while it is traced, so \"if\", \"and\", \"while\" and comparisons cannot be used; write "
      "dmocbench.smooth_if_else(x, a, b, eps), which is a where x > 0, or smooth_max, smooth_min";
  constexpr const char* no_number =
      "a formula has no value while it is traced, so float(), int() and functions of math such as math.cos cannot be "
      "used; write dmocbench.cos or numpy.cos";
  constexpr const char* no_abs = "abs has a kink, which solvers cannot handle; write dmocbench.smooth_abs(x, eps)";
  constexpr const char* no_steps = "rounding has jumps, which solvers cannot handle";
  py::class_<Expression> expression(
      module, "Expression",
      "A traced number. Arithmetic on traced numbers builds a formula, which dmocbench differentiates exactly.");
  expression.def(py::init<double>(), py::arg("value"))
      .def("__add__", binary([](const auto& a, const auto& b) { return a + b; }))
      .def("__radd__", binary([](const auto& a, const auto& b) { return b + a; }))
      .def("__sub__", binary([](const auto& a, const auto& b) { return a - b; }))
      .def("__rsub__", binary([](const auto& a, const auto& b) { return b - a; }))
      .def("__mul__", binary([](const auto& a, const auto& b) { return a * b; }))
      .def("__rmul__", binary([](const auto& a, const auto& b) { return b * a; }))
      .def("__truediv__", binary([](const auto& a, const auto& b) { return a / b; }))
      .def("__rtruediv__", binary([](const auto& a, const auto& b) { return b / a; }))
      .def("__pow__", power)
      .def("__rpow__", refusing<py::handle>("an exponent cannot be a formula; write exp(y * log(x)) for x**y"))
      .def("__neg__", [](const Expression& x) { return -x; })
      .def("__pos__", [](const Expression& x) { return x; })
      .def("__float__",
           [](const Expression& x) {
             if (const auto value = x.constant_value()) return *value;
             throw py::type_error(no_number);
           })
      .def(
          "conjugate", [](const Expression& x) { return x; }, "The number itself, because the number is real.")
      .def("__repr__", text_of);
  for (const char* name : {"__int__", "__index__"}) expression.def(name, refusing(no_number));
  for (const char* name : {"__floor__", "__ceil__", "__trunc__"}) expression.def(name, refusing(no_steps));
  expression.def("__abs__", refusing(no_abs)).def("__bool__", refusing(no_branch));
  for (const char* name : {"__eq__", "__ne__", "__lt__", "__le__", "__gt__", "__ge__"}) {
    expression.def(name, refusing<py::handle>(no_branch));
  }
  for (const char* name : {"__floordiv__", "__rfloordiv__", "__mod__", "__rmod__"}) {
    expression.def(name, refusing<py::handle>(no_steps));
  }
}

py::type_error neither_number_nor_formula(const char* function, py::handle argument) {
  // NOLINTNEXTLINE(modernize-return-braced-init-list): the constructor is explicit
  return py::type_error(fmt::format("{} takes a number, a formula or an array of them, not {}", function,
                                    Py_TYPE(argument.ptr())->tp_name));
}

/// The value of an object that is `traced` as a formula, where it is a number and not a formula of one.
std::optional<double> number_of(py::handle object, const Expression& traced) {
  return py::isinstance<Expression>(object) ? std::nullopt : traced.constant_value();
}

/// A function of each entry of an array, of numbers where they are all numbers.
py::object entry_by_entry(const py::object& array, const py::object& function) {
  const py::module_ numpy = py::module_::import("numpy");
  const py::object entries = numpy.attr("asarray")(array);
  const py::object values = numpy.attr("frompyfunc")(function, 1, 1)(entries);
  const bool has_formulas = entries.attr("dtype").attr("kind").cast<std::string>() == "O";
  return has_formulas ? values : py::object(values.attr("astype")("float64"));
}

/// A function of one number, for numbers, formulas and arrays; numpy finds it as the method `method` of formulas.
template <class OfFormula, class OfNumber>
void bind_function(py::module_& module, const char* name, const char* method, const char* doc, OfFormula of_formula,
                   OfNumber of_number) {
  const auto of_entry = [=](const py::object& x) -> py::object {
    const auto traced = as_expression(x);
    if (!traced) throw neither_number_nor_formula(name, x);
    const auto number = number_of(x, *traced);
    return number ? py::object(py::float_(of_number(*number))) : py::cast(Expression(of_formula(*traced)));
  };
  module.def(
      name,
      [=](const py::object& x) {
        const bool has_entries = py::isinstance<py::array>(x) || py::isinstance<py::sequence>(x);
        return has_entries && !as_expression(x) ? entry_by_entry(x, py::cpp_function(of_entry)) : of_entry(x);
      },
      py::arg("x"), doc);
  py::class_<Expression>(module.attr("Expression")).def(method, [=](const Expression& x) {
    return Expression(of_formula(x));
  });
}

/// The same of two numbers.
template <class OfFormulas, class OfNumbers>
void bind_function_of_two(py::module_& module, const char* name, const char* method, const char* doc, const char* first,
                          const char* second, OfFormulas of_formulas, OfNumbers of_numbers) {
  module.def(
      name,
      [=](const py::object& x, const py::object& y) -> py::object {
        const auto left = as_expression(x);
        const auto right = as_expression(y);
        if (!left) throw neither_number_nor_formula(name, x);
        if (!right) throw neither_number_nor_formula(name, y);
        const auto first_number = number_of(x, *left);
        const auto second_number = number_of(y, *right);
        if (first_number && second_number) return py::float_(of_numbers(*first_number, *second_number));
        return py::cast(Expression(of_formulas(*left, *right)));
      },
      py::arg(first), py::arg(second), doc);
  py::class_<Expression>(module.attr("Expression")).def(method, [=](const Expression& x, const py::object& y) {
    const auto right = as_expression(y);
    if (!right) throw neither_number_nor_formula(method, y);
    return Expression(of_formulas(x, *right));
  });
}

Expression required(py::handle object, const char* function) {
  if (const auto formula = as_expression(object)) return *formula;
  throw neither_number_nor_formula(function, object);
}

void bind_smooth(py::module_& module) {
  module.def(
      "smooth_abs", [](const py::object& x, double eps) { return smooth_abs(required(x, "smooth_abs"), eps); },
      py::arg("x"), py::arg("eps"),
      "sqrt(x**2 + eps**2), which exceeds |x| by at most eps (at x = 0); eps has the unit of x.");
  module.def(
      "smooth_sign", [](const py::object& x, double eps) { return smooth_sign(required(x, "smooth_sign"), eps); },
      py::arg("x"), py::arg("eps"),
      "x/sqrt(x**2 + eps**2), a step from -1 to 1; half of it lies between x = -0.6 eps and 0.6 eps.");
  module.def(
      "smooth_max",
      [](const py::object& x, const py::object& y, double eps) {
        return smooth_max(required(x, "smooth_max"), required(y, "smooth_max"), eps);
      },
      py::arg("x"), py::arg("y"), py::arg("eps"),
      "A smooth maximum, which exceeds the larger argument by at most eps/2 (if both are equal); eps has their unit.");
  module.def(
      "smooth_min",
      [](const py::object& x, const py::object& y, double eps) {
        return smooth_min(required(x, "smooth_min"), required(y, "smooth_min"), eps);
      },
      py::arg("x"), py::arg("y"), py::arg("eps"),
      "A smooth minimum, which is below the smaller argument by at most eps/2 (if both are equal); eps has their "
      "unit.");
  module.def(
      "smooth_if_else",
      [](const py::object& x, const py::object& a, const py::object& b, double eps) {
        constexpr const char* name = "smooth_if_else";
        return smooth_if_else(required(x, name), required(a, name), required(b, name), eps);
      },
      py::arg("x"), py::arg("a"), py::arg("b"), py::arg("eps"),
      "a where x is several eps above 0, b where x is several eps below 0; eps has the unit of x.");
  py::class_<Spline>(module, "Spline",
                     "The natural cubic spline through points, as a function of numbers and formulas.")
      .def(py::init<std::vector<double>, std::vector<double>>(), py::arg("x"), py::arg("y"))
      .def("__call__", [](const Spline& spline, const py::object& x) -> py::object {
        const Expression traced = required(x, "Spline");
        const auto number = number_of(x, traced);
        return number ? py::object(py::float_(spline(*number))) : py::cast(spline(traced));
      });
}

}  // namespace

void bind_expressions(py::module_& module) {
  bind_class(module);
  // NOLINTBEGIN(cppcoreguidelines-macro-usage): functions have no names for templates
#define DMOCBENCH_FUNCTION(name, method, doc)                                             \
  bind_function(                                                                          \
      module, #name, method, doc, [](const Expression& x) { return dmocbench::name(x); }, \
      [](double x) { return std::name(x); })
  DMOCBENCH_FUNCTION(sqrt, "sqrt", "The square root.");
  DMOCBENCH_FUNCTION(exp, "exp", "e**x.");
  DMOCBENCH_FUNCTION(log, "log", "The natural logarithm.");
  DMOCBENCH_FUNCTION(sin, "sin", "The sine of x radians.");
  DMOCBENCH_FUNCTION(cos, "cos", "The cosine of x radians.");
  DMOCBENCH_FUNCTION(tan, "tan", "The tangent of x radians.");
  DMOCBENCH_FUNCTION(asin, "arcsin", "The inverse sine, in radians.");
  DMOCBENCH_FUNCTION(acos, "arccos", "The inverse cosine, in radians.");
  DMOCBENCH_FUNCTION(atan, "arctan", "The inverse tangent, in radians.");
  DMOCBENCH_FUNCTION(sinh, "sinh", "The hyperbolic sine.");
  DMOCBENCH_FUNCTION(cosh, "cosh", "The hyperbolic cosine.");
  DMOCBENCH_FUNCTION(tanh, "tanh", "The hyperbolic tangent.");
  DMOCBENCH_FUNCTION(asinh, "arcsinh", "The inverse hyperbolic sine.");
  DMOCBENCH_FUNCTION(erf, "erf", "The error function.");
#undef DMOCBENCH_FUNCTION
  // NOLINTEND(cppcoreguidelines-macro-usage)
  bind_function_of_two(
      module, "atan2", "arctan2", "The angle of the point (x, y).", "y", "x",
      [](const Expression& y, const Expression& x) { return atan2(y, x); },
      [](double y, double x) { return std::atan2(y, x); });
  bind_function_of_two(
      module, "hypot", "hypot", "sqrt(x**2 + y**2), which is not differentiable at 0.", "x", "y",
      [](const Expression& x, const Expression& y) { return hypot(x, y); },
      [](double x, double y) { return std::hypot(x, y); });
  bind_smooth(module);
}

}  // namespace dmocbench::python
