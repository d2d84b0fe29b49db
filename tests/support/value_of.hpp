#pragma once

#include <optional>

#include "methods/error.hpp"

namespace dmocbench::tests {

/// What an optional holds; where it holds nothing the test fails by an `Error`.
template <class Value>
[[nodiscard]] Value value_of(const std::optional<Value>& optional) {
  if (!optional) throw Error("a value that has to be there is not");
  return *optional;
}

}  // namespace dmocbench::tests
