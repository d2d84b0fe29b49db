#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/speed/benchmark_file.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench::speed {

/// Tables by the suffixes of their files: "_machine" goes to FILE_machine.csv.
using TablesBySuffix = std::vector<std::pair<std::string, Table>>;

/// A program of Google Benchmark. Its results are JSON (`--benchmark_out`), from which `bench/speed/page` makes pages;
/// or tables, if it has some.
struct BenchmarkProgram {
  std::string name;            ///< of the binary
  std::string description;     ///< a sentence
  std::string csv = {};        ///< the files of `--csv`, for `--help`
  std::string default_filter;  ///< of the benchmarks that run without flags; a "-" in front excludes
  std::function<void()> register_benchmarks;
  std::function<TablesBySuffix(const Benchmarks&)> tables = {};  ///< of a run, for `--csv`

  /// Reads the command line, `--csv FILE` and the flags of Google Benchmark, runs the benchmarks and writes the tables,
  /// each whole or not at all, and their metadata, FILE_tables.json (FILE.json is free for `--benchmark_out`). Returns
  /// the exit code; every error is one line on standard error.
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
