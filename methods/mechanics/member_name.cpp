#include "methods/mechanics/member_name.hpp"

#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"

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

void rethrow_naming(const std::string& name, const char* function) {
  try {
    throw;
  } catch (const Stopped&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Error& error) {
    if (std::string_view(error.what()).starts_with(name)) throw;
    throw Error("{}: {}: {}", name, member_name(function), error.what());
  } catch (const std::exception& error) {
    throw Error("{}: {} threw an exception: {}", name, member_name(function), error.what());
  } catch (...) {
    throw Error("{}: {} threw an object that is not a std::exception; throw dmocbench::Error", name,
                member_name(function));
  }
}

}  // namespace dmocbench
