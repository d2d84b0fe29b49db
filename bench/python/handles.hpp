#pragma once

#include <memory>

#include <pybind11/pybind11.h>

#include "methods/mechanics/problem.hpp"

namespace dmocbench::python {

/// A problem for functions of the module: of a Python class, built in, or from a library.
struct ProblemHandle {
  std::shared_ptr<const Problem> problem;
  pybind11::object original;  ///< the object of a Python class that it was made of; None of others
};

}  // namespace dmocbench::python
