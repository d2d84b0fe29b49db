// Joins the parts of a run (--part) into the one table that the whole run would have written, and what is made of it.
#include <filesystem>
#include <string>
#include <vector>

#include "bench/run/command_line.hpp"
#include "bench/run/joining_run.hpp"
#include "bench/run/part_file.hpp"

namespace dmocbench::merge_program {

int merge(CommandLine& line) {
  std::string name;
  std::filesystem::path out = "results";
  std::vector<std::string> folders;
  line.option("--name", name, "name of the table: that of the experiment, unless its --name gave another");
  line.option("--out", out, "results folder where the parts are (in NAME.parts), and where the table is written");
  line.option("--from", folders,
              "results folder of another machine with parts, besides the one of --out; may be repeated");
  line.parse();
  require_name(name, out);
  std::vector<std::filesystem::path> places(folders.begin(), folders.end());
  if (folders.empty() || std::filesystem::exists(folder_of_parts(out / name))) places.insert(places.begin(), out);
  const std::vector<PartFile> parts = read_all_parts(places, name);
  run_in_place(joining_run(parts.front(), places, out, name));
}

int run(int argc, char** argv) {
  return run_program(
      "merge",
      "Joins the parts that an experiment wrote with --part into its table NAME.csv and computes what needs all rows: "
      "every file that the whole run would have written. Parts that are missing, there twice or of another run are "
      "named, and nothing is written. The exit code is that of the whole run: 1 if a solve failed.",
      argc, argv, merge);
}

}  // namespace dmocbench::merge_program
