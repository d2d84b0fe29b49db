// Joins the parts of a run (--part) into the one table that the whole run would have written, and computes the results
// that follow from it.
#include <filesystem>
#include <string>
#include <vector>

#include "bench/run/command_line.hpp"
#include "bench/run/joining_run.hpp"
#include "bench/run/part_file.hpp"
#include "bench/run/problem_libraries.hpp"

namespace dmocbench::merge_program {

int merge(CommandLine& line) {
  JoiningOptions options;
  options.out = "results";
  std::vector<std::string> folders;
  line.option("--name", options.name, "name of the table: the name of the experiment, or the value of its --name");
  line.option("--out", options.out, "results folder that has the parts in NAME.parts, and gets the table");
  line.option("--from", folders,
              "another results folder with parts, for example copied from another machine; may be repeated");
  line.option("--grid", options.grid,
              "the grid file of the parts, if they used one: file names in parts are not trusted");
  line.option("--start", options.start, "the start file of the parts, if they used one");
  line.option("--option", options.passed_on, "the same --option that the parts were given; may be repeated");
  add_library_option(line, options.libraries);
  line.exit_code_1("as for the experiment");
  line.parse();
  require_name(options.name, options.out);
  options.folders.assign(folders.begin(), folders.end());
  if (folders.empty() || std::filesystem::exists(folder_of_parts(options.out / options.name))) {
    options.folders.insert(options.folders.begin(), options.out);
  }
  const std::vector<PartFile> parts = read_all_parts(options.folders, options.name);
  run_in_place(joining_run(parts.front(), options));
}

int run(int argc, char** argv) {
  return run_program(
      "merge",
      "Joins the parts that an experiment wrote with --part into its table NAME.csv, and writes every other file "
      "that one run of all cases would have written. If parts are missing, damaged, present twice or from different "
      "runs, merge names them and writes nothing. The exit code is the exit code of the experiment.",
      argc, argv, merge);
}

}  // namespace dmocbench::merge_program
