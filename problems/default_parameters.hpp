#pragma once

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// True if every parameter of a problem has its default value, those in `except` apart: a certified optimum is that of
/// the data it was computed with.
template <class Type>
[[nodiscard]] bool has_default_parameters(const Type& problem, std::initializer_list<std::string_view> except = {}) {
  const Type untouched;
  return std::all_of(untouched.parameters().begin(), untouched.parameters().end(), [&](const Parameter& parameter) {
    const bool excepted = std::find(except.begin(), except.end(), parameter.name) != except.end();
    return excepted || problem.parameter(parameter.name) == parameter.value;
  });
}

}  // namespace dmocbench
