// One program that is all others: what is installed.
#include "bench/dispatch.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/run/command_line.hpp"
#include "methods/error.hpp"
#include "methods/runtime/environment.hpp"

namespace dmocbench {

namespace {

constexpr const char* description =
    "DMOC against collocation: dmocbench EXPERIMENT OPTIONS... runs an experiment, dmocbench EXPERIMENT --help tells "
    "of its options and columns, dmocbench figures RESULTS draws what is in a results folder.";

void print_programs(std::span<const Program> programs) {
  fmt::print("{}\n\n", description);
  for (const Program& program : programs) fmt::print("  {:<20} {}\n", program.name, program.description);
}

/// A name as it can be that of a program beside this one.
bool is_plain(const std::string& name) {
  return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string::npos;
}

/// Runs dmocbench-NAME in place of this program. Throws `Error` if there is none.
void run_beside(const std::string& name, char** argv) {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path other = self.parent_path() / ("dmocbench-" + name);
  if (is_plain(name)) ::execv(other.c_str(), argv);  // returns where it fails
  throw Error(fmt::format("there is no experiment \"{}\"; dmocbench --help lists them", name.substr(0, 40)));
}

}  // namespace

int dispatch(std::span<const Program> programs, int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "--help";
  const auto found = std::ranges::find(programs, name, &Program::name);
  if (found != programs.end()) {
    std::string call = std::string(argv[0]) + " " + name;  // as metadata repeat it
    argv[1] = call.data();
    return found->run(argc - 1, argv + 1);
  }
  const bool is_help = name == "--help" || name == "-h";
  return run_program("dmocbench", description, argc, argv, [&](CommandLine& /*line*/) {
    if (name == "--version") {
      check_environment();
      fmt::print("dmocbench {}\n", DMOCBENCH_VERSION);
      return 0;
    }
    if (is_help) {
      print_programs(programs);
    } else {
      run_beside(name, argv + 1);
    }
    return 0;
  });
}

}  // namespace dmocbench
