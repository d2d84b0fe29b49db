#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dmocbench {

/// All repetitions of a benchmark.
struct Benchmark {
  /// The measured case: the words KEY=VALUE of the label (`benchmark::State::SetLabel`).
  std::map<std::string, std::string, std::less<>> labels;
  /// Times in nanoseconds, whatever the file's unit, and counters; NaN for a number that is not finite.
  std::map<std::string, std::vector<double>, std::less<>> numbers;

  /// Empty if there is no such label.
  [[nodiscard]] std::string label(std::string_view key) const;
  // The median of a number's repetitions; empty if the benchmark does not have it.
  [[nodiscard]] std::optional<double> median_of(std::string_view number) const;
  [[nodiscard]] std::optional<double> smallest_of(std::string_view number) const;
};

/// Benchmarks by name.
using Benchmarks = std::map<std::string, Benchmark>;

/// The repetitions in a JSON file of Google Benchmark (`--benchmark_out`); aggregates and benchmarks that failed
/// are left out. Throws `Error` that names `file` if the text is something else.
[[nodiscard]] Benchmarks parse_benchmarks(const std::string& text, const std::filesystem::path& file);

}  // namespace dmocbench
