#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/experiment/table.hpp"

namespace dmocbench::speed {

/// A program of benchmarks, for those who call it.
struct BenchmarkProgram {
  std::string name;
  std::string description;     ///< a sentence
  std::string csv;             ///< what `--csv` writes
  std::string default_filter;  ///< what a run without flags does, or leaves out behind a "-"
};

/// Reads the command line, `--csv` and the flags of Google Benchmark, and calls `run` with the file, which is empty if
/// none was asked for and can be written otherwise. Flags are those of this suite (five repetitions, in random order so
/// that a disturbance of a shared machine is spread over all benchmarks), then the program's own, then the user's,
/// which win. Returns the exit code; every error is one line on standard error.
[[nodiscard]] int start(std::span<char* const> arguments, const BenchmarkProgram& program,
                        const std::function<void(const std::filesystem::path& csv)>& run);

/// Writes tables, each whole or not at all: those of the suffixes "" and "_machine" go to FILE.csv and
/// FILE_machine.csv. Does nothing if `csv` is empty. Throws `Error` if a file cannot be written.
void write_tables(const std::filesystem::path& csv, const std::vector<std::pair<std::string, Table>>& tables);

}  // namespace dmocbench::speed
