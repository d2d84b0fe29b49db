#include "methods/mechanics/class_name.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>

#include <cxxabi.h>

namespace dmocbench {

std::string class_name(const std::type_info& type) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> text(  // NOLINT(cppcoreguidelines-no-malloc): as the ABI has it
      abi::__cxa_demangle(type.name(), nullptr, nullptr, &status), &std::free);
  std::string name = status == 0 ? text.get() : "problem";
  name.resize(std::min(name.find('<'), name.size()));
  return name.substr(name.rfind(':') + 1);  // npos + 1 is 0
}

}  // namespace dmocbench
