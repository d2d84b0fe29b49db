#pragma once

#include <string>

namespace dmocbench {

/// To be called where an exception is handled: throws it again as an `Error` that names the problem and the function.
/// Missing memory, and the end of a `StopScope`, are rethrown unchanged.
[[noreturn]] void rethrow_naming(const std::string& name, const char* function);

/// Calls a function of a problem, which anybody may have written: its exceptions become an `Error` that names the
/// problem and the function.
template <class Named, class Call>
[[nodiscard]] auto call_formula(const Named& problem, const char* function, const Call& call) -> decltype(call()) {
  try {
    return call();
  } catch (...) {
    rethrow_naming(problem.name(), function);
  }
}

}  // namespace dmocbench
