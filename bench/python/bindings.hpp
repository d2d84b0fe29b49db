#pragma once

#include <pybind11/pybind11.h>

namespace dmocbench::python {

// The parts of the Python module `dmocbench._core`, each in a source of its own.

/// Traced numbers and the functions of them.
void bind_expressions(pybind11::module_& module);
/// Problems: of Python classes, built-in ones, and problems of libraries.
void bind_problems(pybind11::module_& module);
/// One solve and its answer.
void bind_solve(pybind11::module_& module);
/// Many solves of one program.
void bind_batch(pybind11::module_& module);
/// Experiments, as the program `dmocbench` runs them.
void bind_run(pybind11::module_& module);

}  // namespace dmocbench::python
