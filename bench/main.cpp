// The one executable: it runs the program that its first argument names, or the link by which it is called.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/programs.hpp"
#include "bench/run/build.hpp"
#include "bench/run/command_line.hpp"
#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/runtime/environment.hpp"

namespace dmocbench {

namespace {

constexpr const char* description =
    "Compares DMOC with collocation. dmocbench EXPERIMENT OPTIONS... runs an experiment; dmocbench help EXPERIMENT "
    "lists its options and columns; dmocbench figures RESULTS draws the tables in a results folder.\n\nFirst steps: "
    "dmocbench list; dmocbench solve --problem cart_pole; dmocbench new my_problem; dmocbench study --problem "
    "cart_pole";

void print_programs() {
  fmt::print("{}\n\n", description);
  for (const Program& program : programs()) fmt::print("  {:<20} {}\n", program.name, program.description);
}

/// Whether a name may belong to a program next to this one.
bool is_plain(const std::string& name) {
  return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string::npos;
}

/// Runs dmocbench-NAME in place of this program. Throws `Error` if it does not exist.
void run_installed(const std::string& name, char** argv) {
  const std::filesystem::path other = own_file().parent_path() / ("dmocbench-" + name);
  if (is_plain(name)) ::execv(other.c_str(), argv);  // returns where it fails
  const std::string meant = likely_meant(name, names_of(programs(), &Program::name));
  throw Error("there is no experiment \"{}\"{}; dmocbench --help lists all experiments", name.substr(0, 40),
              meant.empty() ? "" : " (did you mean " + meant + "?)");
}

/// The program of a name, or null.
const Program* program_named(std::string_view name) {
  const auto found = std::ranges::find(programs(), name, &Program::name);
  return found == programs().end() ? nullptr : &*found;
}

/// Runs the program that the first argument names with the arguments after it. `dmocbench help NAME` is `dmocbench NAME
/// --help`. Without an argument, and for --help, the programs are listed. In place of an unknown name, dmocbench-NAME
/// in the folder of this executable is run.
int run_named(int argc, char** argv) {
  std::vector<char*> words(argv, argv + argc);
  std::string help = "--help";
  if (argc > 2 && words[1] == std::string_view("help")) words = {argv[0], argv[2], help.data()};
  const std::string name = argc > 1 ? words[1] : help;
  std::string call = std::string(argv[0]) + " " + name;  // as metadata repeat it
  if (const Program* program = program_named(name)) {
    words[1] = call.data();
    return program->run(static_cast<int>(words.size()) - 1, words.data() + 1);
  }
  return run_program("dmocbench", description, argc, argv, [&](CommandLine& /*line*/) {
    if (name == "--version" || name == "-v") {
      check_environment();
      fmt::print("dmocbench {}\n", DMOCBENCH_VERSION);
    } else if (name == "--help" || name == "-h" || name == "help") {
      print_programs();
    } else {
      words.push_back(nullptr);
      run_installed(name, words.data() + 1);
    }
    return 0;
  });
}

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) {
  dmocbench::register_extensions();
  const std::string called = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "";
  if (const dmocbench::Program* program = dmocbench::program_named(called)) return program->run(argc, argv);
  return dmocbench::run_named(argc, argv);
}
