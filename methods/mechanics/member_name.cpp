#include "methods/mechanics/member_name.hpp"

namespace dmocbench {

namespace {

std::vector<std::pair<std::string, std::string>>& other_names() {
  static std::vector<std::pair<std::string, std::string>> names;
  return names;
}

}  // namespace

std::string member_name(std::string_view member) {
  for (const auto& [name, other] : other_names()) {
    if (member.starts_with(name)) return other + std::string(member.substr(name.size()));
  }
  return std::string(member);
}

void spell_members(std::vector<std::pair<std::string, std::string>> names) { other_names() = std::move(names); }

}  // namespace dmocbench
