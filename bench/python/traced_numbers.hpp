#pragma once

#include <optional>

#include <pybind11/pybind11.h>

#include "methods/expression/expression.hpp"

namespace dmocbench::python {

/// A Python object as a formula: an Expression, or a number (float, int, a scalar of numpy). Empty for others,
/// including arrays. Throws as Python does where an int is too large for a float.
[[nodiscard]] std::optional<Expression> as_expression(pybind11::handle object);

/// A formula for Python: a float where it is a constant, so that functions of Python's own accept it.
[[nodiscard]] pybind11::object number_or_formula(const Expression& formula);

}  // namespace dmocbench::python
