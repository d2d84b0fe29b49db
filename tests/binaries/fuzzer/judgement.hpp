#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/binaries/fuzzer/watched_process.hpp"

namespace dmocbench::tests {

/// What stands in a folder: relative paths, with the content of regular files and "/" for anything else.
using Content = std::map<std::string, std::string>;
[[nodiscard]] Content content_of(const std::filesystem::path& folder);

/// What is wrong with how a command line ended and what it left, a sentence each; nothing if all is well.
[[nodiscard]] std::vector<std::string> faults_of(const std::vector<std::string>& line, const Ended& ended,
                                                 const Content& before, const Content& after);

}  // namespace dmocbench::tests
