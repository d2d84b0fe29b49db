#pragma once

#include <string>
#include <type_traits>

#include <tl/expected.hpp>

#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

/// What `measure()` returns, or the sentence of the `Error` by which it refuses. Throws `Stopped` on, because a stop
/// that was asked for is no finding.
template <class Measure>
[[nodiscard]] tl::expected<std::invoke_result_t<const Measure&>, std::string> measured_or_reason(
    const Measure& measure) {
  try {
    return measure();
  } catch (const Stopped&) {
    throw;
  } catch (const Error& error) {
    return tl::unexpected<std::string>(error.what());
  }
}

}  // namespace dmocbench
