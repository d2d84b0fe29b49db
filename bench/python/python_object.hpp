#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "methods/mechanics/problem.hpp"

namespace dmocbench::python {

class PythonObject;

/// What an object of a Python class reads of the C++ problem that it represents.
class ProblemReader {
 public:
  /// The parameter `name`, a formula while one is traced, else a number. Throws `Error` as `Problem::parameter`, and
  /// where the problem is gone.
  [[nodiscard]] pybind11::object read(const std::string& name) const;
  /// `dmocbench::constraint_multipliers` at (q, v, u, y, t). Throws `Error` as that, and where the problem is gone.
  [[nodiscard]] pybind11::list constraint_multipliers(const pybind11::object& q, const pybind11::object& v,
                                                      const pybind11::object& u, const pybind11::object& y,
                                                      const pybind11::object& t) const;

 private:
  friend class PythonObject;
  [[nodiscard]] const Problem& problem(const std::string& asked) const;

  const Problem* problem_ = nullptr;  ///< null once it is gone
};

/// An object of the Python class `dmocbench.Problem` that implements members of a problem.
///
/// It keeps a copy of the object, so that later changes of the original do not reach solves that go on. Its functions
/// may be called by any thread, with or without the GIL. Python exceptions become an `Error` that names the function,
/// and is kept for the call (`Call`).
class PythonObject {
 public:
  /// Of an object, whose function `_bound` makes the copy, for a problem that has its parameters. Holds the GIL. Throws
  /// as Python does where something is missing.
  PythonObject(const pybind11::object& original, const Problem& problem);
  ~PythonObject();  // NOLINT(bugprone-exception-escape): see its definition
  PythonObject(const PythonObject&) = delete;
  PythonObject& operator=(const PythonObject&) = delete;

  /// The parameters that an object declares.
  [[nodiscard]] static std::vector<Parameter> parameters_of(const pybind11::object& original);

  /// The name of the problem.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// The copy; touched with the GIL only.
  [[nodiscard]] const pybind11::object& object() const noexcept { return object_; }
  /// Gives a problem of this object the values that the object has.
  void give_values(Problem& problem) const;
  /// A copy of a problem of this object, with its values.
  template <class Class>
  [[nodiscard]] std::unique_ptr<Class> copy_of(const Class& problem) const {
    const pybind11::gil_scoped_acquire gil;
    auto copy = std::make_unique<Class>(object_);
    for (const Parameter& parameter : problem.parameters()) copy->set_parameter(parameter.name, parameter.value);
    return copy;
  }
  /// True if the class has that member.
  [[nodiscard]] bool states(const char* member) const;
  /// A member as formula, as many entries as it has. `arguments()`: the arguments for Python.
  [[nodiscard]] ExpressionVector formula(const char* member, const std::function<pybind11::tuple()>& arguments) const;
  /// `work()` with the GIL; Python exceptions become an `Error` that names the member.
  template <class Work>
  [[nodiscard]] auto asked(const char* member, const Work& work) const {
    const pybind11::gil_scoped_acquire gil;
    try {
      return work();
    } catch (pybind11::error_already_set& error) {
      rethrow(member, error);
    }
  }

 private:
  [[noreturn]] void rethrow(const char* member, pybind11::error_already_set& error) const;

  // Objects of Python; touched with the GIL only.
  pybind11::object object_;
  pybind11::object reader_;

  std::string name_;
  std::vector<std::string> members_;
};

/// As long as it exists, objects read parameters as formulas in this thread, which traces one.
class Tracing {
 public:
  Tracing();
  ~Tracing();
  Tracing(const Tracing&) = delete;
  Tracing& operator=(const Tracing&) = delete;
};

/// The entries as a list of Python.
[[nodiscard]] pybind11::list list_of(const ExpressionVector& entries);
/// The formulas that Python returned: a sequence of formulas and numbers, or one alone. Throws `Error` that names what
/// it is instead.
[[nodiscard]] ExpressionVector formulas_in(const pybind11::object& returned);
/// The name of an object's type.
[[nodiscard]] std::string type_of(pybind11::handle object);

}  // namespace dmocbench::python
