#pragma once

#include <string>

namespace dmocbench {

/// The version of dmocbench.
[[nodiscard]] std::string version();

/// The compiler of this build, with its version.
[[nodiscard]] std::string compiler();

}  // namespace dmocbench
