#include <pybind11/pybind11.h>

#include "bench/programs.hpp"
#include "bench/python/bindings.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/first_order_problem.hpp"
#include "methods/runtime/environment.hpp"

namespace {

namespace py = pybind11;

void register_errors(py::module_& module) {
  py::register_exception<dmocbench::Error>(module, "Error").attr("__doc__") =
      "Raised on misuse, with one sentence that states the mistake and the remedy.";
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "The C++ part of dmocbench; import the package dmocbench instead.";
  module.attr("__version__") = DMOCBENCH_VERSION;
  module.attr("no_configuration") = dmocbench::no_configuration;
  module.attr("tag_of_python_code") = DMOCBENCH_TAG_OF_PYTHON_CODE;
  register_errors(module);
  dmocbench::check_environment();
  dmocbench::order_by_one_thread();
  dmocbench::register_extensions();
  dmocbench::python::bind_expressions(module);
  dmocbench::python::bind_problems(module);
  dmocbench::python::bind_motion(module);
  dmocbench::python::bind_phases(module);
  dmocbench::python::bind_solve(module);
  dmocbench::python::bind_batch(module);
  dmocbench::python::bind_run(module);
}
