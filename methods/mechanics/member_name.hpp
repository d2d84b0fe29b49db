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

}  // namespace dmocbench
