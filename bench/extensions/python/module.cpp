#include <pybind11/pybind11.h>

#include "bench/extensions/python/bindings.hpp"
#include "bench/extensions/register_extensions.hpp"
#include "methods/error.hpp"
#include "methods/runtime/environment.hpp"

namespace {

namespace py = pybind11;

void register_errors(py::module_& module) {
  py::register_exception<dmocbench::Error>(module, "Error").attr("__doc__") =
      "Misuse: one sentence says what is wrong and how to mend it.";
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "dmocbench in C++; the package dmocbench is what to import.";
  module.attr("__version__") = DMOCBENCH_VERSION;
  register_errors(module);
  dmocbench::check_environment();
  dmocbench::order_by_one_thread();
  dmocbench::register_extensions();
  dmocbench::python::bind_expressions(module);
  dmocbench::python::bind_problems(module);
  dmocbench::python::bind_solve(module);
  dmocbench::python::bind_batch(module);
  dmocbench::python::bind_run(module);
}
