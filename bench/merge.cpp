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
  line.option("--name", options.name, "name of the table: the experiment's, unless its --name gave another");
  line.option("--out", options.out,
              "results folder where the parts are (in NAME.parts), and where the table is written");
  line.option("--from", folders, "further results folder with parts, of another machine; may be repeated");
  line.option("--grid", options.grid, "the grid file of the parts, whose file names are not trusted");
  line.option("--start", options.start, "the start of the parts, if it was a file");
  line.option("--option", options.passed_on,
              "the options of the parts, if they are a foreign solver's; may be repeated");
  add_library_option(line, options.libraries);
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
      "Joins the parts that an experiment wrote with --part into its table NAME.csv and computes the rest: "
      "every file that the whole run would have written. If parts are missing, present twice or of another run, they "
      "are named, and no file is written. The exit code is as for the whole run: 1 if a solve failed.",
      argc, argv, merge);
}

}  // namespace dmocbench::merge_program
