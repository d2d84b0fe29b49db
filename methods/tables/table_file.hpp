#pragma once

#include <filesystem>
#include <string>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// The content of a regular file; others might have no end. Throws `Error` that names it if it cannot be read.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// The table in a text, which stands in a file of this name. Throws `Error` that names the file if it is not a table.
[[nodiscard]] Table table_in(const std::string& text, const std::filesystem::path& file);

/// The table in a file that `Table::csv` wrote. Throws `Error` that names the file if it cannot be read or is not a
/// table.
[[nodiscard]] Table read_table(const std::filesystem::path& file);

}  // namespace dmocbench
