// The installed program, which contains all others.
#include "bench/dispatch.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/run/command_line.hpp"
#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/runtime/environment.hpp"

namespace dmocbench {

namespace {

constexpr const char* description =
    "DMOC compared with collocation. dmocbench EXPERIMENT OPTIONS... runs an experiment; dmocbench help EXPERIMENT "
    "lists its options and columns; dmocbench figures RESULTS draws the tables in a results folder.\n\n"
    "First steps: dmocbench list; dmocbench solve --problem cart_pole; dmocbench new my_problem; dmocbench study "
    "--problem cart_pole";

void print_programs(std::span<const Program> programs) {
  fmt::print("{}\n\n", description);
  for (const Program& program : programs) fmt::print("  {:<20} {}\n", program.name, program.description);
}

/// Whether a name may belong to a program next to this one.
bool is_plain(const std::string& name) {
  return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string::npos;
}

/// Runs dmocbench-NAME in place of this program. Throws `Error` if it does not exist.
void run_beside(const std::string& name, char** argv, std::span<const Program> programs) {
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  const std::filesystem::path other = self.parent_path() / ("dmocbench-" + name);
  if (is_plain(name)) ::execv(other.c_str(), argv);  // returns where it fails
  const std::string meant = likely_meant(name, names_of(programs, &Program::name));
  throw Error(fmt::format("there is no experiment \"{}\"{}; dmocbench --help lists them", name.substr(0, 40),
                          meant.empty() ? "" : " (did you mean " + meant + "?)"));
}

}  // namespace

int dispatch(std::span<const Program> programs, int argc, char** argv) {
  std::vector<char*> words(argv, argv + argc);
  std::string help = "--help";
  if (argc > 2 && words[1] == std::string_view("help")) words = {argv[0], argv[2], help.data()};
  const std::string name = argc > 1 ? words[1] : help;
  const auto found = std::ranges::find(programs, name, &Program::name);
  std::string call = std::string(argv[0]) + " " + name;  // as metadata repeat it
  if (found != programs.end()) {
    words[1] = call.data();
    return found->run(static_cast<int>(words.size()) - 1, words.data() + 1);
  }
  return run_program("dmocbench", description, argc, argv, [&](CommandLine& /*line*/) {
    if (name == "--version" || name == "-v") {
      check_environment();
      fmt::print("dmocbench {}\n", DMOCBENCH_VERSION);
    } else if (name == "--help" || name == "-h" || name == "help") {
      print_programs(programs);
    } else {
      words.push_back(nullptr);
      run_beside(name, words.data() + 1, programs);
    }
    return 0;
  });
}

}  // namespace dmocbench
