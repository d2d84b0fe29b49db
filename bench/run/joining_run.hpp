#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/run/part_file.hpp"

namespace dmocbench {

/// Throws `Error` unless `name` is that of a table, or if none is given: the sentence lists what parts there are.
void require_name(const std::string& name, const std::filesystem::path& out);

/// What the command line of `merge` says of a joining run. Whoever wrote a part may have written anything into it, so
/// that what names files to be read or code to be loaded is taken from here alone.
struct JoiningOptions {
  std::filesystem::path out;                   ///< where the table is written
  std::string name;                            ///< of the table
  std::vector<std::filesystem::path> folders;  ///< where the parts are
  std::vector<std::string> libraries;          ///< of problems
  std::string grid;                            ///< file of node times; empty for none
  std::string start;                           ///< file of a motion; empty for none
  std::vector<std::string> passed_on;          ///< "option=value" for a solver
};

/// The words that start a program of the suite: the one of that name next to this one (merge or study), or this one
/// where it is all of them. Throws `Error` if it is not there.
[[nodiscard]] std::vector<std::string> start_of_program(const std::string& name);

/// The command line of the experiment that wrote a part, with its options, but to join the parts and write to `out`.
/// The program is the one beside this, or this one where it is all experiments. Throws `Error` if the part names no
/// experiment of this build, has an option that no part has, or needs what `merge` was not given.
[[nodiscard]] std::vector<std::string> joining_run(const PartFile& part, const JoiningOptions& options);

/// Becomes that program. Throws `Error` if it cannot be run.
[[noreturn]] void run_in_place(const std::vector<std::string>& command_line);

}  // namespace dmocbench
