#pragma once

#include <filesystem>
#include <string>

namespace dmocbench {

/// The version of dmocbench.
[[nodiscard]] std::string version();

/// The compiler of this build, with its version.
[[nodiscard]] std::string compiler();

/// The file that this code was loaded from: the program, or the Python module in a process that runs Python.
[[nodiscard]] std::filesystem::path own_file();

}  // namespace dmocbench
