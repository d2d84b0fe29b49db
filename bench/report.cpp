// A results folder as one page of HTML that opens anywhere: claims, figures, tables, motions.
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "bench/report/page.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/problem_libraries.hpp"
#include "bench/run/result_file.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench::report_program {

int write_report(CommandLine& line) {
  std::filesystem::path from = "results";
  std::string to;
  line.option("--from,--out", from, "the results folder");
  line.option("--to", to, "file to write; default: report.html in the results folder");
  line.exit_code_1("");
  parse_with_libraries(line);
  const ResultsFolder results = read_results_folder(from);
  const std::filesystem::path page = to.empty() ? from / "report.html" : std::filesystem::path(to);
  std::error_code none;
  const std::filesystem::path way =
      std::filesystem::relative(from, std::filesystem::absolute(page).parent_path(), none);
  const std::string folder = way.empty() || way == "." ? "" : way.string() + "/";
  const std::string html = report_page(results, folder);
  write_file(page, html);
  print_line(fmt::format("report: {}, {}, {}, {:.1f} MB: {}", counted(results.tables.size(), "table"),
                         counted(results.figures.size(), "figure"), counted(results.claims.size(), "claim"),
                         static_cast<double>(html.size()) * 1e-6, page.string()));
  return 0;
}

int run(int argc, char** argv) {
  return run_program(
      "report", "Writes the results of a folder as one HTML page that needs no other file and no network connection.",
      argc, argv, write_report);
}

}  // namespace dmocbench::report_program
