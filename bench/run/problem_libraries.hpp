#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/run/command_line.hpp"

namespace dmocbench {

/// Registers the option --library of a program that takes problems by their names.
void add_library_option(CommandLine& line, std::vector<std::string>& libraries);

/// The libraries of problems that the environment variable DMOCBENCH_LIBRARIES names (colons between them).
[[nodiscard]] std::vector<std::string> libraries_of_environment();

/// Loads the libraries of the environment, then the given ones, each once, and adds their problems to the known ones.
/// Throws `Error` as `load_problem_library`.
void load_problem_libraries(const std::vector<std::string>& libraries);

/// Registers --library after all other options, parses, and loads the libraries; returns the program and its arguments.
std::vector<std::string> parse_with_libraries(CommandLine& line);

/// Records that a problem was compiled from a source file while the program ran: for `library_of` and metadata it is a
/// library of one problem with the checksum of its source.
void note_source_of_problem(const std::string& problem, const std::string& file, const std::string& source);

/// The file that a problem was loaded from, without its folder; empty for a problem of the suite.
[[nodiscard]] std::string library_of(const std::string& problem);

/// The libraries that were loaded, for metadata: an object for each with its "path", its checksum "crc32" (eight
/// hexadecimal digits) and its "problems"; null if there are no libraries.
[[nodiscard]] nlohmann::ordered_json describe_problem_libraries();

}  // namespace dmocbench
