#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dmocbench {

/// All repetitions of every benchmark, by its name.
using BenchmarkSamples = std::map<std::string, std::vector<double>>;

/// A counter's values in a JSON file of Google Benchmark (`--benchmark_out`). `cpu_time` and `real_time` are in
/// nanoseconds whatever the file's unit; aggregates, benchmarks that failed and those without the counter are left out.
///
/// Throws `Error` that names the file if it cannot be read, is not such a file, holds no repetition, has no benchmark
/// with this counter (the sentence lists what there is), or a value is not above zero.
[[nodiscard]] BenchmarkSamples read_samples(const std::filesystem::path& file, std::string_view counter);

/// The same of several runs of one program, each of which counts as one repetition, its median: what lasts for a whole
/// run, such as the place of arrays in memory, is noise too. A single file gives all its repetitions. Throws `Error` if
/// there is no file.
[[nodiscard]] BenchmarkSamples read_samples(const std::vector<std::filesystem::path>& files, std::string_view counter);

/// The middle one, or the mean of the two in the middle.
[[nodiscard]] double median_of(std::vector<double> values);

}  // namespace dmocbench
