// Writes a program and its start in AMPL's format, for solvers that read it.
#include <filesystem>

#include <fmt/format.h>

#include "bench/extensions/interchange/exchanged_case.hpp"
#include "bench/run/options.hpp"
#include "bench/run/problem_libraries.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/start_provider.hpp"
#include "methods/error.hpp"
#include "methods/extensions/interchange/ampl_model.hpp"
#include "methods/transcription/start.hpp"

namespace dmocbench::write_nl_program {

/// FILE.nl, then the names of constraints and unknowns.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& file) {
  return {file, std::filesystem::path(file).replace_extension(".row"),
          std::filesystem::path(file).replace_extension(".col")};
}

/// Throws `Error` unless all files can be written and none exists.
void check(const std::filesystem::path& nl) {
  if (nl.extension() != ".nl") throw Error("--to {}: the name must end in .nl", nl.string());
  for (const std::filesystem::path& file : files_of(nl)) {
    std::error_code none;
    if (std::filesystem::exists(std::filesystem::symlink_status(file, none))) {
      throw Error("--to: {} exists already; remove it or name another file", file.string());
    }
    require_writable(file);
  }
}

int write(CommandLine& line) {
  ExperimentOptions options{.intervals = "128", .start = "guess", .name = "write-nl"};
  std::string file;
  add_options(line, options);
  line.option("--to", file,
              "FILE.nl for the program of one case and its start; FILE.row and FILE.col get the names of constraints "
              "and unknowns");
  parse_with_libraries(line);
  const Case the_case = exchanged_case(expand_cases(options));
  check(file);
  const SolverOptions solver = solver_options(options);
  StartProvider starts({.start = options.start, .most_seconds = options.start_seconds, .reports_branch = false},
                       solver);
  starts.check({the_case});
  const auto program = the_case.transcribe();
  const AmplModel model = ampl_model(*program, sample(*program, starts.start_for(the_case).motion));
  const std::vector<std::filesystem::path> files = files_of(file);
  write_file(files[1], model.row);
  write_file(files[2], model.col);
  write_file(files[0], model.nl);
  fmt::print("write-nl: {}: {} variables, {} constraints: {}\n", the_case.label(), program->variable_count(),
             program->constraint_count(), file);
  return 0;
}

int run(int argc, char** argv) {
  return run_program("write-nl",
                     "Writes the program of one case as text in AMPL's format, which Ipopt, Knitro, SNOPT and others "
                     "read. read-sol, with the same options, reads the solution.",
                     argc, argv, write);
}

}  // namespace dmocbench::write_nl_program
