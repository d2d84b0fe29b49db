#pragma once

#include <memory>
#include <optional>

#include <pybind11/pybind11.h>

#include "methods/expression/expression.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench::python {

/// A problem for functions of the module: of a Python class, built in, or from a library.
struct ProblemHandle {
  std::shared_ptr<const Problem> problem;
  pybind11::object original;  ///< the object of a Python class that it was made of; None of others
};

// The parts of the Python module `dmocbench._core`, each in a source of its own.

/// Traced numbers and the functions of them.
void bind_expressions(pybind11::module_& module);
/// Problems: of Python classes, built-in ones, and problems of libraries.
void bind_problems(pybind11::module_& module);
/// Arrays of a trajectory.
void bind_motion(pybind11::module_& module);
/// Conditions of switches between phases.
void bind_phases(pybind11::module_& module);
/// One solve and its answer.
void bind_solve(pybind11::module_& module);
/// Many solves of one program.
void bind_batch(pybind11::module_& module);
/// Experiments, as the program `dmocbench` runs them.
void bind_run(pybind11::module_& module);

/// A Python object as a formula: an Expression, or a number (float, int, a scalar of numpy). Empty for others,
/// including arrays. Throws as Python does where an int is too large for a float.
[[nodiscard]] std::optional<Expression> as_expression(pybind11::handle object);

/// A formula for Python: a float where it is a constant, so that functions of Python's own accept it.
[[nodiscard]] pybind11::object number_or_formula(const Expression& formula);

}  // namespace dmocbench::python
