#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dmocbench {

/// A member of `Problem` as messages spell it: "initial_state", "bounds().first.v". Where users state problems in
/// another language, `spell_members` has given it the name that it has there. A text that begins with a member, such as
/// "bounds().q: {}", keeps its rest.
[[nodiscard]] std::string member_name(std::string_view member);

/// Sets the names of members in all messages of this process, as pairs of the name in C++ and the other one. The first
/// pair counts whose name in C++ begins the member. Not to be called while others read messages.
void spell_members(std::vector<std::pair<std::string, std::string>> names);

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
