#pragma once

#include <span>
#include <string_view>

namespace dmocbench {

/// A program of the suite: an experiment or a tool. All of them are in one executable, `dmocbench`, which runs the one
/// that its first argument names, or its own name if it is called through a link (build/bench/convergence).
struct Program {
  std::string_view name;              ///< "convergence"
  std::string_view description;       ///< one line of `dmocbench --help`, without a full stop
  int (*run)(int argc, char** argv);  ///< runs it with its own name as argv[0] and returns the exit code
};

/// All programs by name: the core's and those that were added.
[[nodiscard]] std::span<const Program> programs();

/// Adds programs of extensions.
void add_programs(std::span<const Program> added);

/// Adds the programs and claims of all extensions to the core's; called once, at the begin of the executable. Without
/// extensions (`DMOCBENCH_EXTENSIONS=OFF`) their claims are added as "not judged".
void register_extensions();

}  // namespace dmocbench
