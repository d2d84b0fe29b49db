#pragma once

#include <span>
#include <string_view>

namespace dmocbench {

/// One of the programs that a single one offers.
struct Program {
  std::string_view name;
  std::string_view description;  ///< one line
  int (*run)(int argc, char** argv);
};

/// Runs the program that the first argument names with the arguments behind it, and returns its exit code: `dmocbench
/// convergence --problem pendulum` does what the program `convergence` does. Where there is no such program, one of
/// the name dmocbench-NAME in the folder of this one is run in its place. `dmocbench help NAME` is `dmocbench NAME
/// --help`. Without an argument, and for --help, the programs are listed; a name that nobody has is one line on
/// standard error and exit code 2.
int dispatch(std::span<const Program> programs, int argc, char** argv);

}  // namespace dmocbench
