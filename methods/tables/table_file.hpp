#pragma once

#include <filesystem>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// The table in a file that `Table::csv` wrote. Throws `Error` that names the file if it cannot be read or is no table.
[[nodiscard]] Table read_table(const std::filesystem::path& file);

}  // namespace dmocbench
