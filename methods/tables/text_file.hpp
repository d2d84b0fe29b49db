#pragma once

#include <filesystem>
#include <string>

namespace dmocbench {

/// The content of a regular file; others might have no end. Throws `Error` that names it if it cannot be read.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

}  // namespace dmocbench
