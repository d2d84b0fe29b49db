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

/// Runs the program that the first argument names with the arguments after it, and returns its exit code: `dmocbench
/// convergence --problem pendulum` runs the program `convergence`. If there is no such program, dmocbench-NAME in the
/// folder of this program is run in its place. `dmocbench help NAME` is `dmocbench NAME --help`. Without an argument,
/// and for --help, the programs are listed. An unknown name is reported in one line on standard error, with exit
/// code 2.
int dispatch(std::span<const Program> programs, int argc, char** argv);

}  // namespace dmocbench
