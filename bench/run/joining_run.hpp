#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/run/part_file.hpp"

namespace dmocbench {

/// Throws `Error` that lists what parts there are if no name is given or there is nothing of that name.
void require_name(const std::string& name, const std::filesystem::path& out);

/// The command line of the experiment that wrote a part, with its options, but to join the parts in `folders` and write
/// to `out`. The program is the one beside this, or this one where it is all experiments. Throws `Error` if there is
/// none.
[[nodiscard]] std::vector<std::string> joining_run(const PartFile& part,
                                                   const std::vector<std::filesystem::path>& folders,
                                                   const std::filesystem::path& out, const std::string& name);

/// Becomes that program. Throws `Error` if it cannot be run.
[[noreturn]] void run_in_place(const std::vector<std::string>& command_line);

}  // namespace dmocbench
