#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/run/part_file.hpp"

namespace dmocbench {

/// Throws `Error` unless `name` is a table's name. If it is empty, the sentence lists the existing parts.
void require_name(const std::string& name, const std::filesystem::path& out);

/// The options of a joining run on the command line of `merge`. The content of parts is not trusted, so the names of
/// files to read and of code to load come only from here.
struct JoiningOptions {
  std::filesystem::path out;                   ///< where the table is written
  std::string name;                            ///< of the table
  std::vector<std::filesystem::path> folders;  ///< where the parts are
  std::vector<std::string> libraries;          ///< of problems
  std::string grid;                            ///< file of node times, or empty
  std::string start;                           ///< file of a motion, or empty
  std::vector<std::string> passed_on;          ///< "option=value" for a solver
};

/// The words that start a program of the suite: the program named `name` next to this one (merge or study), or this one
/// if it contains all of them. Throws `Error` if it does not exist.
[[nodiscard]] std::vector<std::string> start_of_program(const std::string& name);

/// The command line of the experiment that wrote a part, with its options, changed to join the parts and write to
/// `out`. The program is the one next to this program, or this one if it contains all experiments. Throws `Error` if
/// the part names no experiment of this build, has an option that no part has, or needs an option that `merge` was not
/// given.
[[nodiscard]] std::vector<std::string> joining_run(const PartFile& part, const JoiningOptions& options);

/// Becomes that program. Throws `Error` if it cannot be run.
[[noreturn]] void run_in_place(const std::vector<std::string>& command_line);

}  // namespace dmocbench
