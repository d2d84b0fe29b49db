#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace dmocbench {

/// What a reader needs to judge or repeat a table: compiler, flags, processor, memory, versions of the libraries,
/// commit, command line, UTC time.
[[nodiscard]] nlohmann::ordered_json describe_run(const std::vector<std::string>& command_line);

}  // namespace dmocbench
