// Two runs of a program of Google Benchmark: what became faster or slower beyond noise. (Why not compare.py of Google
// Benchmark: bench/speed/README.md.)
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/compare/comparison.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/result_file.hpp"

namespace dmocbench::compare_program {

/// FILE,FILE,...
std::vector<std::filesystem::path> files_of(const std::string& list) {
  std::vector<std::filesystem::path> files;
  std::istringstream stream(list);
  for (std::string file; std::getline(stream, file, ',');) files.emplace_back(file);
  return files;
}

int compare_files(CommandLine& line) {
  std::string before_files;
  std::string after_files;
  ComparisonOptions options;
  std::filesystem::path csv;
  bool fails_if_slower = false;
  line.option("before", before_files, "JSON file of a run (--benchmark_out), or several runs: FILE,FILE,...");
  line.option("after", after_files, "the same of what is compared with it");
  line.option("--counter", options.counter,
              "what is compared: cpu_time, real_time or a counter; more is slower, unless it ends with per_second");
  line.number("--threshold", options.threshold, 1.0, 1e6, "smallest ratio of medians that is worth a verdict");
  line.number("--significance", options.significance, 0.0, 1.0,
              "largest probability of chance that counts as a difference");
  line.option("--csv", csv, "write the table to this file");
  line.flag("--fail-if-slower", fails_if_slower, "exit with 1 if a benchmark became slower");
  line.parse();
  if (!csv.empty()) require_writable(csv);
  const BenchmarkSamples before = read_samples(files_of(before_files), options.counter);
  const BenchmarkSamples after = read_samples(files_of(after_files), options.counter);
  const auto comparisons = compare(before, after, options);
  if (!csv.empty()) write_file(csv, comparison_table(comparisons).csv());
  fmt::print("{}\n{}", options.counter, comparison_text(comparisons));
  const std::size_t in_one_only = before.size() + after.size() - 2 * comparisons.size();
  if (in_one_only > 0) fmt::print("{} benchmarks are in one of the files only\n", in_one_only);
  return fails_if_slower && std::ranges::count(comparisons, SpeedVerdict::slower, &SpeedComparison::verdict) > 0 ? 1
                                                                                                                 : 0;
}

int run(int argc, char** argv) {
  return run_program(
      "compare",
      "Compares two runs of a program of Google Benchmark with repetitions. A benchmark is faster or slower if the "
      "Mann-Whitney test finds the repetitions apart and the ratio of medians reaches the threshold; it takes 5 "
      "repetitions at least. Noise that lasts for a whole run, such as another program beside it, the test cannot "
      "know.",
      argc, argv, compare_files);
}

}  // namespace dmocbench::compare_program
