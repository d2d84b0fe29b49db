// A results folder as one page of HTML that opens anywhere: claims, figures, tables, motions.
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/report/comparison_page.hpp"
#include "bench/report/page.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/problem_libraries.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"

namespace dmocbench::report_program {

/// Two folders side by side.
int write_comparison(const std::vector<std::string>& folders, const std::string& to) {
  if (folders.size() != 2)
    throw Error(fmt::format("--compare takes two results folders, not {}: --compare A B", folders.size()));
  const ComparedRun first{folders[0], read_results_folder(folders[0])};
  const ComparedRun second{folders[1], read_results_folder(folders[1])};
  const std::filesystem::path page = to.empty() ? "comparison.html" : to;
  const std::string html = comparison_page(first, second);
  write_file(page, html);
  print_line(fmt::format("report: {} and {} side by side, {:.1f} MB: {}", folders[0], folders[1],
                         static_cast<double>(html.size()) * 1e-6, page.string()));
  return 0;
}

int write_report(CommandLine& line) {
  std::filesystem::path from;
  std::vector<std::string> compared;
  std::string to;
  line.option("--from", from, "the results folder; default: results");
  line.option("--compare", compared, "two results folders, A B: compare them");
  line.option("--to", to, "the page; default: report.html in the results folder, or comparison.html");
  line.exit_code_1("");
  parse_with_libraries(line);
  if (!compared.empty() && !from.empty()) throw Error("--from and --compare exclude each other; leave one out");
  if (!compared.empty()) return write_comparison(compared, to);
  if (from.empty()) from = "results";
  const ResultsFolder results = read_results_folder(from);
  const std::filesystem::path page = to.empty() ? from / "report.html" : std::filesystem::path(to);
  std::error_code none;
  const std::filesystem::path way =
      std::filesystem::relative(from, std::filesystem::absolute(page).parent_path(), none);
  const std::string folder = way.empty() || way == "." ? "" : way.string() + "/";
  const std::string html = report_page(results, folder);
  write_file(page, html);
  print_line(fmt::format("report: {} tables, {} figures, {} claims, {:.1f} MB: {}", results.tables.size(),
                         results.figures.size(), results.claims.rows().size(), static_cast<double>(html.size()) * 1e-6,
                         page.string()));
  return 0;
}

int run(int argc, char** argv) {
  return run_program("report",
                     "Writes a results folder as one page of HTML that needs no other file and no network; or two of "
                     "them side by side.",
                     argc, argv, write_report);
}

}  // namespace dmocbench::report_program
