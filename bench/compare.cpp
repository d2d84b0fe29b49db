// Two runs of a program of Google Benchmark: what became faster or slower beyond noise. (Why not compare.py of Google
// Benchmark: bench/speed/README.md.)
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/compare/comparison.hpp"
#include "bench/experiment/command_line.hpp"
#include "bench/experiment/result_file.hpp"

namespace dmocbench {

namespace {

struct CompareOptions {
  std::string before;
  std::string after;
  ComparisonOptions comparison;
  std::filesystem::path csv;
  bool fails_if_slower = false;
};

void declare_options(CommandLine& line, CompareOptions& options) {
  line.option("before", options.before, "JSON file of a run (--benchmark_out), or several runs: FILE,FILE,...")
      .required();
  line.option("after", options.after, "the same of what is compared with it").required();
  line.option("--counter", options.comparison.counter,
              "what is compared: cpu_time, real_time or a counter; more is slower, unless it ends with per_second")
      .shows_default();
  constexpr double largest = 1e6;
  line.option("--threshold", options.comparison.threshold, "smallest ratio of medians that is worth a verdict")
      .range(1.0, largest)
      .shows_default();
  line.option("--significance", options.comparison.significance,
              "largest probability of chance that counts as a difference")
      .range(0.0, 1.0)
      .shows_default();
  line.option("--csv", options.csv, "write the table to this file");
  line.flag("--fail-if-slower", options.fails_if_slower, "exit with 1 if a benchmark became slower");
}

/// FILE,FILE,...
std::vector<std::filesystem::path> files_of(const std::string& list) {
  std::vector<std::filesystem::path> files;
  std::istringstream stream(list);
  for (std::string file; std::getline(stream, file, ',');) files.emplace_back(file);
  return files;
}

int compare_files(const CompareOptions& options) {
  const std::string& counter = options.comparison.counter;
  const BenchmarkSamples before = read_samples(files_of(options.before), counter);
  const BenchmarkSamples after = read_samples(files_of(options.after), counter);
  const auto comparisons = compare(before, after, options.comparison);
  if (!options.csv.empty()) {
    if (options.csv.has_parent_path()) prepare_folder(options.csv.parent_path());
    write_file(options.csv, comparison_table(comparisons).csv());
  }
  fmt::print("{}\n{}", counter, comparison_text(comparisons));
  const std::size_t in_one_only = before.size() + after.size() - 2 * comparisons.size();
  if (in_one_only > 0) fmt::print("{} benchmarks are in one of the files only\n", in_one_only);
  const bool slower = std::any_of(comparisons.begin(), comparisons.end(), [](const SpeedComparison& comparison) {
    return comparison.verdict == SpeedVerdict::slower;
  });
  return slower && options.fails_if_slower ? 1 : 0;
}

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) try {
  dmocbench::CommandLine line(
      "Compares two runs of a program of Google Benchmark with repetitions. A benchmark is faster or slower if the "
      "Mann-Whitney test finds the repetitions apart and the ratio of medians reaches the threshold; it takes 5 "
      "repetitions at least. Noise that lasts for a whole run, such as another program beside it, the test cannot "
      "know.",
      "compare");
  dmocbench::CompareOptions options;
  dmocbench::declare_options(line, options);
  return dmocbench::run_program(line, argc, argv, [&] { return dmocbench::compare_files(options); });
} catch (const std::exception& error) {  // what is set up before run_program can guard it
  std::fputs(error.what(), stderr);
  return 2;
}
