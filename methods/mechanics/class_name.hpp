#pragma once

#include <string>
#include <typeinfo>

namespace dmocbench {

/// The name of a class, without namespaces and arguments of templates.
[[nodiscard]] std::string class_name(const std::type_info& type);

}  // namespace dmocbench
