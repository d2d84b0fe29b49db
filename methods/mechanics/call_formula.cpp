#include "methods/mechanics/call_formula.hpp"

#include <exception>
#include <new>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

void rethrow_naming(const std::string& name, const char* function) {
  try {
    throw;
  } catch (const Stopped&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const Error& error) {
    if (std::string_view(error.what()).starts_with(name)) throw;
    throw Error(fmt::format("{}: {}: {}", name, member_name(function), error.what()));
  } catch (const std::exception& error) {
    throw Error(fmt::format("{}: {} throws an exception: {}", name, member_name(function), error.what()));
  } catch (...) {
    throw Error(fmt::format("{}: {} throws an object that is not a std::exception; throw dmocbench::Error", name,
                            member_name(function)));
  }
}

}  // namespace dmocbench
