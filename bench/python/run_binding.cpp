#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pthread.h>
#include <pybind11/stl.h>

#include "bench/programs.hpp"
#include "bench/python/bindings.hpp"
#include "bench/python/calls.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/problem_libraries.hpp"
#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "problems/problem_registry.hpp"

namespace dmocbench::python {

namespace py = pybind11;

namespace {

/// True of a thread that runs a program without the GIL.
thread_local bool runs_program = false;
thread_local PyGILState_STATE state_at_fork;

/// A program makes processes (--jobs), in which Python problems are called too: Python must be notified.
void let_python_know_of_forks() {
  ::pthread_atfork(
      [] {
        if (!runs_program) return;
        state_at_fork = PyGILState_Ensure();
        PyOS_BeforeFork();
      },
      [] {
        if (!runs_program) return;
        PyOS_AfterFork_Parent();
        PyGILState_Release(state_at_fork);
      },
      [] {
        if (!runs_program) return;
        PyOS_AfterFork_Child();
        PyGILState_Release(state_at_fork);
      });
}

/// Runs a program and returns its exit code; its sentence on misuse is an `Error` if `raises`, else it is printed.
int run(const std::string& name, const std::vector<std::string>& arguments, bool raises) {
  const Program& program = one_of(programs(), &Program::name, name, "there is no experiment");
  std::vector<std::string> words{"dmocbench " + name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::string complaint;
  const int code = without_gil([&](Call& call) {
    const ListeningScope listening;
    const ComplaintScope complaints(raises ? &complaint : nullptr);
    runs_program = true;
    const int result = program.run(static_cast<int>(words.size()), argv.data());
    runs_program = false;
    if (result == 2 || result == 130) call.raise_later();
    return result;
  });
  if (raises && code == 130) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  if (raises && code == 2) throw Error(complaint.empty() ? name + "; see standard error for the reason" : complaint);
  return code;
}

/// The problem becomes one that experiments know by its name, in the place of an earlier one from Python.
void register_problem(const ProblemHandle& handle, const std::string& file, const std::string& source) {
  const std::shared_ptr<const Problem> problem = handle.problem;
  known_problems().put([problem] { return problem->clone(); }, file);
  note_source_of_problem(problem->name(), file, source);
}

}  // namespace

void bind_run(py::module_& module) {
  let_python_know_of_forks();
  module.def("run", &run, py::arg("name"), py::arg("arguments"), py::arg("raises"));
  module.def("register_problem", &register_problem, py::arg("problem"), py::arg("file"), py::arg("source"));
  module.def("programs", [] {
    std::vector<std::pair<std::string, std::string>> all;
    for (const Program& program : programs()) all.emplace_back(program.name, program.description);
    return all;
  });
}

}  // namespace dmocbench::python
