#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace dmocbench {

/// The data needed to judge or repeat a table: compiler, flags, processor, memory, versions of the libraries, libraries
/// of problems, commit, command line, UTC time.
[[nodiscard]] nlohmann::ordered_json describe_run(const std::vector<std::string>& command_line);

/// Writes a description as a file; invalid UTF-8 in it is replaced.
void write_metadata(const std::filesystem::path& file, const nlohmann::ordered_json& description);

/// The JSON Schema of a run's metadata, NAME.json: the properties that every run has, including its tables' entries.
[[nodiscard]] std::string_view metadata_schema() noexcept;

}  // namespace dmocbench
