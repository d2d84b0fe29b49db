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

}  // namespace dmocbench
