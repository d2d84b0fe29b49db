#pragma once

#include <functional>
#include <string>

#include <benchmark/benchmark.h>

namespace dmocbench::speed {

/// A program of Google Benchmark. Its results are JSON (`--benchmark_out`), from which `bench/speed/page` makes pages
/// and tables.
struct BenchmarkProgram {
  std::string name;            ///< of the binary
  std::string description;     ///< a sentence
  std::string default_filter;  ///< of the benchmarks that run without flags; a "-" in front excludes
  std::function<void()> register_benchmarks;

  /// Reads the flags of Google Benchmark, runs the benchmarks and returns the exit code; every error is one line on
  /// standard error. The JSON states the machine, the build and the command line.
  ///
  /// The flags are this suite's (five repetitions, in random order so that a disturbance of a shared machine is
  /// spread over all benchmarks), then the user's, which take precedence.
  [[nodiscard]] int run(int argc, char** argv) const;
};

/// Adds a benchmark that measures its turns itself. Where it ends with an `Error`, that is its result, and the others
/// go on.
benchmark::internal::Benchmark* add_benchmark(const std::string& name, benchmark::TimeUnit unit,
                                              const std::function<void(benchmark::State&)>& run);

}  // namespace dmocbench::speed
